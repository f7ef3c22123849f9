"""What whole labware are called after: one kind of thing, or several."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...vocabulary import WellRef
from ..evidence import Clue, Strength
from ..rules import Common
from ..text import Lexicon, first_words, tokens
from .choosing import A_FEW, Candidate
from .phrases import names_any, names_several, parts_joined, roles_named
from .roles import Roles


def of_several(
    clues: Sequence[Clue], lexicon: Lexicon, common: Common, roles: Roles
) -> dict[str, set[str]]:
    """Labware that its label says to hold several kinds of things, with the roles of these."""
    return {
        ref.labware: set(roles_named(lexicon, clue, common))
        for clue in clues
        if clue.whole and clue.lone and names_several(lexicon, clue, common, roles)
        for ref in clue.wells[:1]
    }


def called_after(
    clues: Sequence[Clue], lexicon: Lexicon, common: Common
) -> dict[str, frozenset[str]]:
    """For each labware, the roles that its name and its label name."""
    found: dict[str, frozenset[str]] = {}
    for clue in clues:
        if clue.whole:
            named = frozenset(roles_named(lexicon, clue, common))
            for key in {ref.labware for ref in clue.wells}:
                found[key] = found.get(key, frozenset()) | named
    return found


def shared(clue: Clue, holding: Mapping[str, set[str]]) -> list[set[str]]:
    """What the labware of a clue hold that are known to hold several kinds of things."""
    return [holding[key] for key in {ref.labware for ref in clue.wells} & holding.keys()]


def named_apart(
    clues: Sequence[Clue], lexicon: Lexicon, common: Common
) -> dict[str, frozenset[WellRef]]:
    """For each label of several things, the wells whose own name is one that says no role.

    `stain` in "treatments and stain" is no treatment.
    """
    own: dict[WellRef, set[str]] = {}
    for clue in clues:
        if not clue.whole and not clue.step and clue.strength >= Strength.NAME:
            for ref in clue.wells if len(clue.places) <= A_FEW else ():
                own.setdefault(ref, set()).update(tokens(clue.text))
    found: dict[str, frozenset[WellRef]] = {}
    for clue in clues:
        others = _roleless_words(clue.text, lexicon, common) if clue.whole else frozenset()
        if others:
            found[clue.text] = frozenset(
                ref for ref in clue.wells if not others.isdisjoint(own.get(ref, ()))
            )
    return found


def _roleless_words(text: str, lexicon: Lexicon, common: Common) -> frozenset[str]:
    """The words of those parts of a label that name no role, where others do."""
    parts = parts_joined(text, common, lambda piece: not set(piece).isdisjoint(",;/+&"))
    silent = [part for part in parts if not names_any(lexicon, part)]
    if len(silent) == len(parts):
        return frozenset()
    return frozenset(tokens(" ".join(silent))) - first_words(common.noise)


def held_before(roles: Roles, candidates: Mapping[WellRef, Sequence[Candidate]]) -> set[str]:
    """Labware that its label, its name or a liquid says to have held something before the run."""
    return {
        ref.labware
        for ref, found in candidates.items()
        if any(
            roles.family.roles[role].implies_contents
            and (clue.whole or clue.strength is Strength.LIQUID)
            for _, role, clue, _ in found
        )
    }
