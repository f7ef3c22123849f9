"""Tables drawn in a docstring or a comment: their cells, however many lines each of them takes.

With bars, ``| slot | labware | content |``, or with titles above columns that stand in line::

    MATERIAL           POSITION            AMOUNT
    vehicle            rack slot 3, A1     1.4 mL
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from .well_names import WellNames

_DASHES = "-=_"
_DRAWN = frozenset(f"{_DASHES} |+:\t")
_BARRED = re.compile(r"\s*[|+]")
GAP = re.compile(r"\s{2,}")
_NEAR = 3
"""Spaces by which a cell may begin beside its title."""

_NUMBERED = re.compile(r"^[^(]*\d")
"""No title: "slot 1"."""

_LONGEST_TITLE = 5
_FEWEST = 2
"""Rows of a table, and its columns."""

LONGEST_LINE = 400
"""Characters; a longer line is none of a table."""

FILLER = "-"
"""No blank line, which ends what a heading speaks of."""


class Row(NamedTuple):
    """One line of a table: its place in the text, and its cells."""

    at: int
    cells: list[str]


def join_cells(cells: list[str], further: Sequence[str]) -> None:
    """Append to each cell of a line what the next one says below it."""
    cells[:] = [f"{cell} {more}".strip() for cell, more in zip(cells, further, strict=True)]


class Entry(NamedTuple):
    """A line in which a table is told, its place in the text, and what it stands under."""

    at: int
    heading: str
    said: str


class Table(NamedTuple):
    """A table in a text.

    Attributes:
        first: Place of its first line.
        end: Place of the line after its last one.
        titles: What stands above each column; ``""`` above one without.
        rows: Its lines, without those of dashes.
        barred: Whether bars stand between its columns.
    """

    first: int
    end: int
    titles: list[str]
    rows: list[Row]
    barred: bool


def tables_in(lines: Sequence[str], names: WellNames) -> Iterator[Table]:
    """The tables of a text with titles, which name no wells, one after the other."""
    at = 0
    while at < len(lines):
        end = _end_of_bars(lines, at)
        table = _barred(lines, at, end) if end > at else _in_line(lines, at)
        if (
            table is not None
            and len(table.rows) >= _FEWEST
            and not any(map(names.spec.search, table.titles))
        ):
            yield table
            at = table.end
        else:
            at = max(at + 1, end)


def _end_of_bars(lines: Sequence[str], at: int) -> int:
    """The line after the last one that begins with a bar, of those from a line on."""
    end = at
    while end < len(lines) and _BARRED.match(lines[end]) and len(lines[end]) <= LONGEST_LINE:
        end += 1
    return end


def _is_rule(written: str) -> bool:
    """Whether a line is drawn with dashes."""
    return not set(written) - _DRAWN and sum(map(written.count, _DASHES)) > 1


def _barred(lines: Sequence[str], at: int, end: int) -> Table | None:
    """The table with bars on these lines, if its titles stand above a rule."""
    drawn = range(at, end)
    ruled = [place for place in drawn if _is_rule(lines[place])]
    rows = [Row(place, _between_bars(lines[place])) for place in drawn if place not in ruled]
    below = next((rule for rule in ruled if rows and rule > rows[0].at), None)
    if below is None or len({len(row.cells) for row in rows}) != 1:
        return None
    heads = [row.cells for row in rows if row.at < below]
    titles = [" ".join(filter(None, cells)) for cells in zip(*heads, strict=True)]
    if len(titles) < _FEWEST:
        return None
    return Table(at, end, titles, [row for row in rows if row.at > below], True)


def _between_bars(written: str) -> list[str]:
    return [cell.strip() for cell in written.strip().strip("|").split("|")]


def _in_line(lines: Sequence[str], at: int) -> Table | None:
    """The table below the titles that stand in a line, if its cells begin where these do.

    What stands left of all titles is a column without one, and so is what stands right of them.
    """
    starts, titles = _titles(lines[at])
    goes_on = at > 0 and len(GAP.split(lines[at - 1].strip())) > 1
    if len(titles) < _FEWEST or goes_on:
        return None
    rows: list[Row] = []
    end = at + 1
    for place, written in enumerate(lines[at + 1 :], at + 1):
        if _is_rule(written):
            end = place + 1
            continue
        cells = _below(starts, written) if len(written) <= LONGEST_LINE else None
        if cells is None or not written.strip():
            break
        rows.append(Row(place, cells))
        end = place + 1
    titles = ["", *titles, ""]
    used = [column for column in range(len(titles)) if titles[column] or _is_filled(rows, column)]
    rows = [Row(row.at, [row.cells[column] for column in used]) for row in rows]
    return Table(at, end, [titles[column] for column in used], rows, False)


def _is_filled(rows: Sequence[Row], column: int) -> bool:
    return any(row.cells[column] for row in rows)


def _titles(written: str) -> tuple[list[int], list[str]]:
    """Where the titles of a line begin, and these; none where a line is too long for them."""
    if not written.strip() or len(written) > LONGEST_LINE:
        return [], []
    gaps = [gap.end() for gap in GAP.finditer(written) if gap.start() > 0]
    starts = [len(written) - len(written.lstrip()), *(g for g in gaps if g < len(written.rstrip()))]
    titles = GAP.split(written.strip())
    if any(len(title.split()) > _LONGEST_TITLE or _NUMBERED.search(title) for title in titles):
        return [], []
    return starts, titles


def _below(starts: Sequence[int], written: str) -> list[str] | None:
    """The cell left of all titles, those below each and the one right of them, or ``None`` where
    one stands between titles.
    """
    cells = [""] * (len(starts) + 2)
    left = len(written) - len(written.lstrip())
    gaps = [gap.end() for gap in GAP.finditer(written) if gap.start() > 0]
    bounds = [left, *(gap for gap in gaps if gap < len(written.rstrip()))]
    for start, stop in zip(bounds, (*bounds[1:], len(written)), strict=True):
        said = written[start:stop].strip()
        column = min(range(len(starts)), key=lambda at: abs(starts[at] - start))
        if abs(starts[column] - start) <= _NEAR:
            cells[column + 1] = f"{cells[column + 1]} {said}".strip()
        elif start < starts[0]:
            cells[0] = f"{cells[0]}  {said}".strip()
        elif start > starts[-1] and cells[-2]:
            cells[-1] = f"{cells[-1]}  {said}".strip()
        else:
            return None
    return cells
