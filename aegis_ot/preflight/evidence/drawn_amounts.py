"""Numbers in the cells of a drawn plate, where the text says what they are the amounts of.

::

          1     2     3
    A   500    U1    U5
    B   250    U2    U6

    numbers = BSA in ug/mL; U = unknown
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from ..layouts import Deck, Drawing, refs_of, well_names
from ..rules import Common
from ..text import any_of, level_in, unit_in, with_u
from .clues import Clue, Strength

_FEWEST = 3
"""Fewer numbers in a drawing may number something."""


def drawn_amounts(
    deck: Deck, key: str, drawing: Drawing, texts: tuple[str, Sequence[str]], common: Common
) -> Iterator[Clue]:
    """The wells with numbers and their levels, by the words that say of what.

    Args:
        deck: What stands where.
        key: The labware that is drawn.
        drawing: Its wells.
        texts: What heads the drawing, and the lines of the text in which it stands.
        common: Words for numbers.
    """
    if len(drawing.numbers) < _FEWEST:
        return
    heading, lines = texts
    said = heading if unit_in(heading) else _said_of_numbers(lines, common)
    unit = unit_in(said)
    if not unit:
        return
    found = [
        (ref, level)
        for number, wells in drawing.numbers.items()
        if (level := level_in(f"{number} {unit}", common)) is not None
        for ref in refs_of(deck, (key,), wells)
    ]
    wells, levels = tuple(ref for ref, _ in found), tuple(level for _, level in found)
    yield Clue(Strength.NAME, said, wells, None, "", subject=False, levels=levels)


def _said_of_numbers(lines: Sequence[str], common: Common) -> str:
    """What one line says that the numbers are: "numbers = BSA in ug/mL (0 = blank)"."""
    words = any_of(common.figures)
    means = any_of(("in", *common.means))
    told = re.compile(
        rf"(?:^|[\s(;,])(?:{words})\s*(?:=|:|(?=\()|\b(?:{means})\b)\s*\(?([^(;=:\n]{{2,60}})",
        re.IGNORECASE,
    )
    spec = well_names(common).spec  # "in columns 1-2" speaks of a part
    whole = (line for line in map(with_u, lines) if not spec.search(line))
    found = {match[1].strip(" ).") for line in whole if (match := told.search(line))}
    found = {said for said in found if unit_in(f" {said} ")}
    return found.pop() if len(found) == 1 else ""
