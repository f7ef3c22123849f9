"""Plate maps drawn as a grid: one code for each well, row by row, in a text or nested lists."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ...instrumentation import LabwareInfo, is_spot
from ..layouts import (
    Deck,
    WellNames,
    called_alike,
    drawn_grid,
    labware_of_map,
    refs_of,
    used_with,
    well_names,
)
from ..rules import Common
from ..text import SourceFacts
from ..trace import row_column
from .clues import Clue, Strength

_SMALLEST = 6
"""The wells of the smallest plate that anyone draws."""

Grid = Sequence[Sequence[str]]


def drawn_maps(deck: Deck, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """What each code of a grid stands beside."""
    for name, value in facts.constants.items():
        yield from _part_drawn(deck, facts, name, value, common)
        grid = _grid(value)
        if not grid or len(grid) * len(grid[0]) < _SMALLEST:
            continue
        plates = _plates_drawn(deck, facts, name, grid, common)
        line = facts.assigned.get(name)
        for code in dict.fromkeys(cell for row in grid for cell in row):
            if re.search(r"[^\W\d]", code):
                wells = tuple(
                    deck.ref(info.key, well)
                    for info in plates
                    for well in info.wells
                    if grid[row_column(well)[0]][row_column(well)[1]] == code
                )
                yield Clue(
                    Strength.NAME, code, wells, line, f"`{code}` in the map `{name}` at line {line}"
                )


def _part_drawn(
    deck: Deck, facts: SourceFacts, name: str, value: Any, common: Common
) -> Iterator[Clue]:
    """Part of a plate as a spreadsheet exports it: ``,4,5,6`` and under it ``B,drug,drug,DMSO``;
    or drawn with spaces.
    """
    if not isinstance(value, str):
        return
    wells_of = _exported(value) or _drawn(value, well_names(common))
    spots = [well for wells in wells_of.values() for well in wells]
    labware = labware_of_map(deck, facts, name, spots, common) if all(map(is_spot, spots)) else ()
    line = facts.assigned.get(name)
    for code, wells in wells_of.items():
        if re.search(r"[^\W\d]", code):
            found = tuple(refs_of(deck, labware, wells))
            said = f"`{code}` in the map `{name}` at line {line}"
            yield Clue(Strength.NAME, code, found, line, said)


def _drawn(value: str, names: WellNames) -> Mapping[str, Sequence[str]]:
    """The wells of each code of the one drawing in a text."""
    lines = value.splitlines()
    drawings = [
        found for at in range(len(lines)) if (found := drawn_grid(lines, at, names).wells_of)
    ]
    return drawings[0] if len(drawings) == 1 else {}


def _exported(value: str) -> Mapping[str, Sequence[str]]:
    """The wells of each code of a table with separators."""
    lines = value.strip().splitlines() or [""]
    head, *rows = [re.split(r"[,;|\t]", line.strip()) for line in lines]
    numbers = [cell.strip() for cell in head[1:]]
    even = len(rows) > 1 and all(len(row) == len(head) for row in rows)
    letters = [row[0].strip() for row in rows]
    if (
        not numbers
        or not even
        or not all(map(str.isdecimal, numbers))
        or head[0].strip().isdecimal()
    ):
        return {}
    wells_of: dict[str, list[str]] = {}
    for letter, row in zip(letters, rows, strict=True):
        for number, cell in zip(numbers, row[1:], strict=True):
            wells_of.setdefault(cell.strip(), []).append(f"{letter}{int(number)}")
    return wells_of


def _plates_drawn(
    deck: Deck, facts: SourceFacts, name: str, grid: Grid, common: Common
) -> list[LabwareInfo]:
    """The plates of a grid's shape that the run uses it on, or else those that the run fills, if it
    fills all of their kind and of no other kind.
    """
    plates = [info for info in deck.plates() if _shape(info) == (len(grid), len(grid[0]))]
    meant = used_with(deck, facts, name) or (called_alike(deck, name, common),)
    found = [info for info in plates if info.key in meant]
    if found:
        return found
    kinds = {info.load_name for info in plates if info.key in deck.filled}
    alike = [info for info in plates if info.load_name in kinds]
    return alike if len(kinds) == 1 and all(info.key in deck.filled for info in alike) else []


def _shape(info: LabwareInfo) -> tuple[int, int]:
    places = [row_column(well) for well in info.wells]
    return max(row for row, _ in places) + 1, max(column for _, column in places) + 1


def _grid(value: Any) -> Grid:
    """The rows of a grid, without a line of column numbers and without the letters of rows."""
    if isinstance(value, str):
        rows = [line.split() for line in re.sub(r"[,;|\t]", " ", value).strip().splitlines()]
        if rows and all(len(row) == 1 for row in rows):
            rows = [list(row[0]) for row in rows]
    elif isinstance(value, (list, tuple)) and all(isinstance(r, (list, tuple, str)) for r in value):
        rows = [r.split() if isinstance(r, str) and " " in r else list(r) for r in value]
    else:
        return ()
    rows = [row for row in rows if row and all(isinstance(cell, str) for cell in row)]
    if len(rows) > 1 and all(cell.isdecimal() for cell in rows[0]):
        rows = rows[1:]
    letters = [row[0].rstrip(":") for row in rows]
    if letters == [chr(ord("A") + at) for at in range(len(rows))] and len(rows) > 1:
        rows = [row[1:] for row in rows]
    even = len(rows) > 1 and len(rows[0]) > 1 and all(len(row) == len(rows[0]) for row in rows)
    return rows if even else ()
