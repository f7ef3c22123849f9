"""Plate maps and tables drawn in a docstring or a comment, with columns that stand in line."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from typing import NamedTuple

from ...instrumentation import is_spot
from ..layouts import Deck, LabwareNouns, drawn_grid, refs_of, well_names
from ..rules import Common
from ..text import SourceFacts, comment_blocks, level_in
from .clues import Clue, Strength, shortened
from .drawn_amounts import drawn_amounts
from .levels import as_one_of_amounts, far_apart, names_amounts, number_in

_FEWEST = 3
"""So many wells side by side are a table."""

_REMARK = re.compile(r"(?<=\S)\s{2,}\(([^()]*)\)\s*$")
"""What stands right of a table's row, apart from it: "(ug/mL; 0 = buffer)"."""

_HEADING_LINES = 2
"""A drawing's heading stands so near above it."""


def maps_in_prose(deck: Deck, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """What drawings say of wells: a grid under its column numbers, or a table with a row of wells.

    They are as exact as a plate map in code, and so as strong.
    """
    nouns = LabwareNouns(deck, common)
    for line, text in (*facts.docstrings, *comment_blocks(facts, indented=True)):
        lines = text.splitlines()
        for at in range(len(lines)):
            yield from _grid(deck, nouns, common, lines, at, line + at)
        for table in _tables(lines):
            yield from _of_table(deck, nouns, common, table, line)


def _grid(
    deck: Deck, nouns: LabwareNouns, common: Common, lines: Sequence[str], at: int, line: int
) -> Iterator[Clue]:
    drawing = drawn_grid(lines, at, well_names(common))
    wells_of = drawing.wells_of
    heading = _above(lines, at)
    plates = {info.key for info in deck.plates() if not info.is_tip_rack}
    named = (nouns.named(heading) & plates) or nouns.kind_in(heading)
    drawn = (*wells_of.values(), *drawing.numbers.values())
    key = _labware(deck, named, [well for wells in drawn for well in wells]) if drawn else ""
    where = f"the map '{shortened(heading)}' at line {line}"
    for clue in drawn_amounts(deck, key, drawing, (heading, lines), common):
        yield replace(clue, line=line, said=f"number in {where}, '{clue.text}'")
    for code, wells in wells_of.items():
        found = tuple(refs_of(deck, (key,), wells))
        yield Clue(
            Strength.NAME,
            code,
            found,
            line,
            f"`{code}` in {where}",
        )


class _Table(NamedTuple):
    """A line ``pos A1 A2 A3``, and above or below it lines as long: ``ug/ml 0 25 50``.

    Attributes:
        heading: What stands above it.
        at: Place of the line of wells in its text.
        spots: The names of the wells.
        rows: For each other line its title, its cells, and whether they stand in line with the
            wells.
    """

    heading: str
    at: int
    spots: list[str]
    rows: list[tuple[str, list[str], bool]]


def _tables(lines: Sequence[str]) -> Iterator[_Table]:
    """Each line of wells with the lines as long that are about it.

    Where several stand in one block, each line belongs to the wells above it; if the block
    begins with another line, to those below.
    """
    remarks = [_REMARK.search(written) for written in lines]
    spans = [
        list(re.finditer(r"[^\s|]+", written[: remark.start()] if remark else written))
        for written, remark in zip(lines, remarks, strict=True)
    ]
    first = 0
    for count, block in groupby(map(len, spans)):
        end = first + len(list(block))
        spots_at = {at: _spots([cell.group() for cell in spans[at]]) for at in range(first, end)}
        placed = [at for at in range(first, end) if len(spots_at[at]) >= _FEWEST]
        after = placed[1:] if first in placed else [at + 1 for at in placed[:-1]]
        for start, at, stop in zip((first, *after), placed, (*after, end), strict=False):
            wells = spans[at][count - len(spots_at[at]) :]
            rows = []
            for row in (row for row in range(start, stop) if row != at):
                cells, remark = spans[row], remarks[row]
                told = cells[count - len(wells) :]
                title = " ".join(cell.group() for cell in cells[: count - len(wells)])
                title = f"{title} {remark[1]}" if remark else title
                aligned = all(
                    well.start() < cell.end() and cell.start() < well.end()
                    for well, cell in zip(wells, told, strict=True)
                )
                rows.append((title, [cell.group() for cell in told], aligned))
            yield _Table(_above(lines, first), at, spots_at[at], rows)
        first = end


def _spots(cells: Sequence[str]) -> list[str]:
    """The wells of a line that holds no others, and nothing after them."""
    spots = [cell for cell in cells if is_spot(cell)]
    return spots if list(cells[len(cells) - len(spots) :]) == spots else []


def _of_table(
    deck: Deck, nouns: LabwareNouns, common: Common, table: _Table, first_line: int
) -> Iterator[Clue]:
    heading, spots = table.heading, table.spots
    titles = " ".join(title for title, _, _ in table.rows)
    named = nouns.named(heading) or nouns.kind_in(f"{heading} {titles}")
    wells = tuple(refs_of(deck, (_labware(deck, named, spots),), spots))
    if len(wells) != len(spots):
        return
    line = first_line + table.at
    evidence = f"the table at line {line}"
    for title, said, aligned in table.rows:
        levels = tuple(number for number in map(number_in, said) if number is not None)
        unit = level_in(f"1 {title}", common, False) is not None
        if len(levels) == len(wells) and (unit or names_amounts(title, common)):
            yield Clue(Strength.NAME, heading, wells, line, evidence, subject=False, levels=levels)
            if far_apart(levels):
                yield as_one_of_amounts(wells, line, evidence, levels)
        elif aligned and not any(levels):
            for ref, cell in zip(wells, said, strict=True):
                yield Clue(Strength.NAME, cell, (ref,), line, f"'{cell}' in {evidence}")


def _above(lines: Sequence[str], at: int) -> str:
    """The heading of what is drawn from a line on."""
    return " ".join(lines[max(0, at - _HEADING_LINES) : at])


def _labware(deck: Deck, named: frozenset[str], spots: Sequence[str]) -> str:
    return next(iter(named)) if named else deck.most_likely(spots)
