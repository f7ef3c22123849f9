"""Plate maps and tables drawn in a docstring or a comment, with columns that stand in line."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from ...instrumentation import is_spot
from ...vocabulary import WellRef
from ..rules import Common
from ..text import SourceFacts, level_in
from .clues import Clue, Strength, shortened
from .deck import Deck
from .labware_nouns import LabwareNouns
from .levels import far_apart, number_in
from .remarks import blocks_of

_FEWEST = 3
"""So many wells side by side are a table."""

_HEADING_LINES = 2
"""A drawing's heading stands so near above it."""


def maps_in_prose(deck: Deck, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """What drawings say of wells: a grid under its column numbers, or a table with a row of wells.

    They are as exact as a plate map in code, and so as strong.
    """
    nouns = LabwareNouns(deck, common)
    for line, text in (*facts.docstrings, *blocks_of(facts)):
        lines = text.splitlines()
        cells = [_cells(written) for written in lines]
        for at in range(len(lines)):
            heading = " ".join(lines[max(0, at - _HEADING_LINES) : at])
            yield from _grid(deck, nouns, heading, lines[at:], line + at)
            yield from _table(deck, nouns, common, lines, cells, at, line + at)


def _grid(
    deck: Deck, nouns: LabwareNouns, heading: str, lines: Sequence[str], line: int
) -> Iterator[Clue]:
    """A line ``1 2 3``, and under it lines ``A x y z``, ``B ...``."""
    numbers = _cells(lines[0])
    if len(numbers) < 2 or [str(n + 1) for n in range(len(numbers))] != list(numbers):
        return
    wells_of: dict[str, list[str]] = {}
    for row, written in enumerate(lines[1:]):
        letter, *codes = _cells(written, len(numbers) + 1) or [""]
        if letter.rstrip(":") != chr(ord("A") + row) or len(codes) != len(numbers):
            break
        for number, code in zip(numbers, codes, strict=True):
            if re.search(r"[^\W\d_]", code):
                wells_of.setdefault(code, []).append(f"{chr(ord('A') + row)}{number}")
    named = nouns.named(heading) or nouns.kind_in(heading)
    key = _labware(deck, named, [well for wells in wells_of.values() for well in wells])
    for code, wells in wells_of.items():
        found = _refs(deck, key, wells)
        yield Clue(
            Strength.NAME,
            code,
            found,
            line,
            f"`{code}` in the map '{shortened(heading)}' at line {line}",
        )


def _cells(written: str, count: int = 0) -> list[str]:
    """The cells of a line; those of several words stand apart by two spaces or by bars."""
    words = written.replace("|", " ").split()
    if len(words) == count or not count:
        return words
    return [cell.strip() for cell in re.split(r"\s{2,}|\|", written.strip(" |"))]


def _table(
    deck: Deck,
    nouns: LabwareNouns,
    common: Common,
    lines: Sequence[str],
    cells: Sequence[Sequence[str]],
    at: int,
    line: int,
) -> Iterator[Clue]:
    """A line ``pos A1 A2 A3``, and above or below it lines as long: ``ug/ml 0 25 50``."""
    spots = [cell for cell in cells[at] if is_spot(cell)]
    if len(spots) < _FEWEST or list(cells[at][-len(spots) :]) != spots:
        return
    first = last = at
    while first > 0 and len(cells[first - 1]) == len(cells[at]):
        first -= 1
    while last + 1 < len(cells) and len(cells[last + 1]) == len(cells[at]):
        last += 1
    heading = " ".join(lines[max(0, first - _HEADING_LINES) : first])
    titles = [" ".join(row[: -len(spots)]) for row in cells[first : last + 1]]
    named = nouns.named(heading) or nouns.kind_in(" ".join((heading, *titles)))
    key = _labware(deck, named, spots)
    wells = _refs(deck, key, spots)
    for row in range(first, last + 1):
        if row == at or len(wells) != len(spots):
            continue
        title, said = titles[row - first], cells[row][-len(spots) :]
        numbers = [number_in(cell) for cell in said]
        levels = tuple(number for number in numbers if number is not None)
        evidence = f"the table at line {line}"
        if len(levels) == len(wells) and level_in(f"1 {title}", common, False) is not None:
            yield Clue(Strength.NAME, heading, wells, line, evidence, subject=False, levels=levels)
            if far_apart(levels):
                said_so = f"one of several amounts in {evidence}"
                yield Clue(Strength.LOOSE_NAME, "standard", wells, line, said_so, levels=levels)
        elif not any(levels):
            for ref, cell in zip(wells, said, strict=True):
                yield Clue(Strength.NAME, cell, (ref,), line, f"'{cell}' in {evidence}")


def _labware(deck: Deck, named: frozenset[str], spots: Sequence[str]) -> str:
    return next(iter(named)) if named else deck.most_likely(spots)


def _refs(deck: Deck, key: str, spots: Sequence[str]) -> tuple[WellRef, ...]:
    info = deck.trace.labware.get(key)
    return tuple(deck.ref(key, spot) for spot in spots if info is not None and spot in info.wells)
