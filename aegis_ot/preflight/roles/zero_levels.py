"""Wells of dose 0: ``[("B2", 0), ("B3", 0.1)]`` names controls, "0 = DMSO only" says which kind."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache

from ...instrumentation import is_spot
from ...vocabulary import WellRef
from ..rules import Common, RoleSpec
from ..text import Rank, SourceFacts, any_of, written_lines
from ..trace import Trace
from .clues import Clue, Strength, shortened
from .levels import names_amounts
from .roles import Roles


def meant_by_zero(clues: Iterable[Clue], facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """For wells that a map gives the level 0, what a comment says that it stands for.

    Not for those to which another map gives a dose as well, of another drug.
    """
    said, of_amounts = _said_of_zero(facts, common)
    if not said:
        return
    clues = list(clues)
    maps: dict[WellRef, set[str]] = {}
    for clue in clues:
        if clue.levels and clue.said.startswith("plate map"):
            for ref in clue.wells[: len(clue.levels)]:
                maps.setdefault(ref, set()).add(clue.said)
    for clue in clues:
        at_zero = tuple(
            ref
            for ref, level in zip(clue.wells, clue.levels, strict=False)
            if level == 0 and len(maps.get(ref, ())) < 2
        )
        amounts = of_amounts or names_amounts(clue.text, common)
        if at_zero and amounts and not clue.whole and clue.strength is Strength.NAME:
            yield replace(
                clue,
                text=said,
                wells=at_zero,
                levels=(0.0,) * len(at_zero),
                said=f"{clue.said}, where 0 stands for '{shortened(said)}'",
                subject=False,
            )


def _said_of_zero(facts: SourceFacts, common: Common) -> tuple[str, bool]:
    """The one thing that "0 = DMSO only" or "0 means ethanol alone" tells, or ``""``; and whether
    its line speaks of amounts: "well, dose (uM); 0 = DMSO only".

    Nothing beside two maps of columns and rows: where one drug is 0, the other may not be.
    """
    zero = _zero(common.means)
    maps = [facts.constants.get(name) for name, note in facts.notes.items() if zero.search(note)]
    if sum(isinstance(m, Mapping) and not any(map(is_spot, m)) for m in maps) > 1:
        return "", False
    found = {
        (match["said"].strip(), names_amounts(line, common))
        for line in written_lines(facts)
        for match in zero.finditer(line)
    }
    return found.pop() if len(found) == 1 else ("", False)


@lru_cache(maxsize=4)
def _zero(means: tuple[str, ...]) -> re.Pattern[str]:
    words = any_of(means)
    return re.compile(
        # Not "day 0: ...", which is another thing's 0.
        r"(?:^|[,;(|.–—]\s*|--?\s+|\bdose\s+)0(?:\.0)?(?: ?[munpµμ]M)?"
        rf"(?: ?(?:=>?|->|→) ?|\s(?:{words})\s)"
        r"(?P<said>[^\W\d_][^,;.:|()=\n]{1,59})",
        re.IGNORECASE,
    )


_FEWEST_DOSES = 2


def derive_undosed(roles: Roles, name: str, spec: RoleSpec, trace: Trace, common: Common) -> None:
    """Wells whose dose is 0, among others of this role, are of the role ``spec.undosed``.

    Not where the doses may be those of one drug of several: where a drug goes into wells of dose 0
    and of several others, or into those of dose 0 alone, or where wells get two. Nor where the
    numbers count something, from 0 on.
    """
    (undosed,) = spec.undosed
    kind = roles.closure(name)
    by_level: dict[float, set[WellRef]] = {}
    said = False
    for ref, assigned in roles.by_well.items():
        level = roles.level(ref)
        if assigned.role in kind and level is not None and not isinstance(level, Rank):
            by_level.setdefault(level, set()).add(ref)
            said = said or names_amounts(assigned.text, common)
    zero = by_level.pop(0, set())
    counted = by_level.keys() == set(range(1, len(by_level) + 1))
    if not zero or len(by_level) < _FEWEST_DOSES or counted or min(by_level) < 0:
        return
    served = trace.served(prefilled=True)
    if not said and _levels_in_common(roles, served, by_level) < _FEWEST_DOSES:
        return  # hours, say
    dosed = frozenset(spec.receives)
    drugs = {ref: wells for ref, wells in served.items() if roles.has(ref, dosed)}
    if _are_of_several(roles, drugs, zero, by_level):
        return
    for ref, wells in drugs.items():
        if wells <= zero and (roles.by_plate_only(ref) or roles.level(ref) == 0):
            del roles.by_well[ref]  # what takes their place stands in the rack of the doses
    for ref in zero:
        roles.by_well[ref] = replace(roles.by_well[ref].copied("dose 0"), role=undosed, whole=False)


def _are_of_several(
    roles: Roles,
    drugs: Mapping[WellRef, set[WellRef]],
    zero: set[WellRef],
    by_level: Mapping[float, set[WellRef]],
) -> bool:
    """Whether more than the one drug of these doses goes into the wells."""
    given = Counter(well for wells in drugs.values() for well in wells - zero)
    if any(count > 1 for count in given.values()):
        return True
    for ref, wells in drugs.items():
        levels = sum(not wells.isdisjoint(of_level) for of_level in by_level.values())
        known = roles.level(ref) in (*by_level, 0) or roles.by_plate_only(ref)
        if not wells.isdisjoint(zero) and (levels > 1 or (levels == 0 and not known)):
            return True
    return False


def _levels_in_common(
    roles: Roles,
    served: Mapping[WellRef, set[WellRef]],
    by_level: Mapping[float, set[WellRef]],
) -> int:
    """How many levels are those of a source as well as of the wells that it goes into."""
    return sum(
        any(
            roles.level(ref) == level and not of_level.isdisjoint(wells)
            for ref, wells in served.items()
        )
        for level, of_level in by_level.items()
    )
