"""What whole labware are called after: one kind of thing, or several."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..rules import Common
from ..text import Lexicon
from .clues import Clue
from .phrases import names_several, roles_named
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
