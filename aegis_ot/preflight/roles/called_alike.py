"""Sources that are called by the same word as the wells they go into, whatever that word means.

Where a plate has vehicle controls, and "APAP" goes from a tube into the wells called APAP, it is
what the controls are the controls of.
"""

from __future__ import annotations

from collections.abc import Iterable

from ...vocabulary import WellRef
from ..evidence import Clue, Strength
from ..rules import Common, RoleSpec
from ..text import tokens, words_of
from ..trace import Trace
from .roles import Roles

_SHORTEST = 3
_LONG = 4
"""A word of so many letters may stand within another: ``KIF11`` in ``siKIF11``."""


def derive_called_alike(
    roles: Roles, name: str, spec: RoleSpec, trace: Trace, common: Common
) -> None:
    """Give a role to unnamed sources that share a word with most wells they go into."""
    beside = frozenset(spec.called_alike_beside)
    plates = {ref.labware for ref in roles.by_well if roles.has(ref, beside)}
    if not plates:
        return
    clues = [clue for clue in roles.untold if not clue.whole and not clue.step]
    outright = (Strength.NAME, Strength.LIQUID)
    of_source = _words((c for c in clues if c.strength in outright), common)
    of_well = _words((c for c in clues if c.strength is not Strength.LOOSE_NAME), common)
    for ref, wells in trace.served(prefilled=True).items():
        if roles.of(ref) or ref not in of_source or plates.isdisjoint(w.labware for w in wells):
            continue
        alike = {w for w in wells if _alike(of_source[ref], of_well.get(w, frozenset()))}
        # What the controls are called by as well, "MTT to columns 1-6", is for all.
        if 2 * len(alike) > len(wells) and not any(roles.has(well, beside) for well in alike):
            roles.derived.setdefault(ref, set()).update(roles.closure(name))


def _words(clues: Iterable[Clue], common: Common) -> dict[WellRef, frozenset[str]]:
    """The telling words of what is said of each well."""
    kinds = (*common.labware.values(), *common.layout.values())
    listed = (common.noise, common.positions, *kinds)
    dull = words_of(tuple(word for words in listed for word in words))
    dull |= {f"{word}s" for word in dull}
    found: dict[WellRef, frozenset[str]] = {}
    for clue in clues:
        words = frozenset(
            word
            for word in tokens(clue.text)
            if len(word) >= _SHORTEST and word[0].isalpha() and word not in dull
        )
        for ref in clue.wells:
            found[ref] = found.get(ref, frozenset()) | words
    return found


def _alike(one: frozenset[str], other: frozenset[str]) -> bool:
    return not one.isdisjoint(other) or any(
        len(min(a, b, key=len)) >= _LONG and (a in b or b in a) for a in one for b in other
    )
