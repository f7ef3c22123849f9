"""Lists of doses whose lines say from which tube, how much, and into which row or column::

Doses (tube = row of the cell plate, columns 3-6)
  tube A1   30 uM    row B
  tube A2   10 uM    row C
  tube B1   vehicle  columns 2 and 7, rows B to G (vehicle controls)
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator, Sequence

from .table_words import Place, TableWords
from .tables import FILLER, GAP, LONGEST_LINE, Entry
from .well_names import WellNames

_FEWEST = 2
_FEWEST_CELLS = 3


def tubes_to_rows(lines: Sequence[str], words: TableWords) -> Iterator[list[Entry]]:
    """The entries of each such list: for each line what the tube holds, and what its wells get.

    The latter stand under the name of their plate, where the line above the list says it.
    """
    at = 0
    while at < len(lines):
        rows: list[tuple[Place, str, Place]] = []
        while at + len(rows) < len(lines) and (row := _row(lines[at + len(rows)], words)):
            rows.append(row)
        if len(rows) >= _FEWEST:
            yield list(_entries(rows, at, lines[at - 1] if at else "", words))
        at += max(1, len(rows))


def _row(written: str, words: TableWords) -> tuple[Place, str, Place] | None:
    """From where, what and to where, if a line says it: a tube, and rows or columns."""
    cells = GAP.split(written.strip()) if len(written) <= LONGEST_LINE else []
    if len(cells) < _FEWEST_CELLS:
        return None
    tube, wells = words.place(cells[0].rstrip(" :=")), words.place(cells[-1])
    said = " ".join(cells[1:-1])
    if tube is None or wells is None or words.has_wells(said):
        return None
    drawn, given = words.names.spec.fullmatch(tube.wells), words.names.spec.match(wells.wells)
    apart = drawn and drawn["first"] and given and not given["first"] and not wells.lead
    return (tube, said, wells) if apart and tube.lead and not tube.rest else None


def _entries(
    rows: Sequence[tuple[Place, str, Place]], at: int, above: str, words: TableWords
) -> Iterator[Entry]:
    for place, (tube, said, _) in enumerate(rows, at):
        yield Entry(place, "", f"{tube.lead} {tube.wells} = {said}")
    heading = words.labware_after(_row_of(words.names), above)
    columns = _columns_in(above, words.names)
    for place, (_, said, wells) in enumerate(rows, at):
        where, match = wells.wells, words.names.spec.fullmatch(wells.wells)
        if columns and match and match["row"]:
            where = words.names.crossed(match["row"], "", columns)
        yield Entry(
            place,
            f"{heading}:" if heading else FILLER,
            f"{where} = {said} {wells.rest}".strip(),
        )


def _columns_in(above: str, names: WellNames) -> str:
    """The columns that are meant for all rows, if the line above a list names no other wells."""
    found = list(names.spec.finditer(above))
    return found[0]["columns"] or found[0]["column"] or "" if len(found) == 1 else ""


@functools.lru_cache(maxsize=8)
def _row_of(names: WellNames) -> re.Pattern[str]:
    """What stands before a plate of which rows or columns are meant: "row of the"."""
    kinds = f"(?:{names.any_row}|{names.any_column})"
    return re.compile(rf"\b{kinds}\s+(?:{names.of})\s+(?:\w{{2,3}}\s+)?")
