"""Wells of dose 0: ``[("B2", 0), ("B3", 0.1)]`` names controls, "0 = DMSO only" says which kind."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache

from ...instrumentation import is_spot
from ...vocabulary import WellRef
from ..rules import Common
from ..text import SourceFacts, any_of, written_lines
from .clues import Clue, Strength, shortened
from .levels import names_amounts


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
