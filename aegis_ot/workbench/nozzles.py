"""Which nozzles of a head are at work, and the wells under their tips."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

_ROWS = "ABCDEFGH"
_PITCH_MM = 9.0


@dataclass(frozen=True)
class Layout:
    """Nozzles at work.

    Attributes:
        nozzles: Column by column, ``A1`` first.
        primary: The one that goes to the well that a command names.
    """

    nozzles: tuple[str, ...]
    primary: str = "A1"


def whole_head(channels: int) -> Layout:
    """All nozzles of a pipette with 1, 8 or 96."""
    columns = range(1, 13) if channels == 96 else (1,)
    rows = _ROWS if channels > 1 else "A"
    return Layout(tuple(f"{row}{column}" for column in columns for row in rows))


def layout_of(params: Mapping[str, Any], channels: int) -> Layout:
    """What ``configureNozzleLayout`` leaves at work."""
    whole = whole_head(channels)
    style, primary = str(params.get("style", "ALL")), str(params.get("primaryNozzle", ""))
    if primary not in whole.nozzles:
        return whole
    row, column = _place(primary)
    rows, columns = range(len(_ROWS)), range(1, 13)
    if style == "QUADRANT":  # part of a column, or a rectangle
        corners = [str(params.get(name, "")) for name in ("backLeftNozzle", "frontRightNozzle")]
        if not set(corners) <= set(whole.nozzles):
            return whole
        (top, left), (bottom, right) = map(_place, corners)
        rows, columns = range(top, bottom + 1), range(left, right + 1)
    if style in ("SINGLE", "ROW"):
        rows = range(row, row + 1)
    if style in ("SINGLE", "COLUMN"):
        columns = range(column, column + 1)
    at_work = {(r, c) for r in rows for c in columns}
    return Layout(tuple(one for one in whole.nozzles if _place(one) in at_work), primary)


def under(columns: Sequence[Sequence[str]], name: str, layout: Layout) -> tuple[str, ...]:
    """Names of the wells under the tips, ``name`` under the primary nozzle; tips are 9 mm apart.

    Args:
        columns: Well names of the labware, column by column.
        name: The well that a command names.
        layout: Nozzles at work.

    Returns:
        One for each nozzle; ``name`` for all, as for one well that they share, where the labware
        has no well under each.
    """
    shared = (name,) * len(layout.nozzles)
    place = next(
        ((c, column.index(name)) for c, column in enumerate(columns) if name in column), None
    )
    if place is None or len(shared) == 1:
        return shared
    # In a trough all tips of a column, or of a row, are in one well.
    row_step = {1: 0, 8: 1, 16: 2}.get(len(columns[place[0]]))
    column_step = {1: 0, 12: 1, 24: 2}.get(len(columns))
    if row_step is None or column_step is None:
        return shared
    primary_row, primary_column = _place(layout.primary)
    found = []
    for nozzle in layout.nozzles:
        row, column = _place(nozzle)
        c = place[0] + (column - primary_column) * column_step
        r = place[1] + (row - primary_row) * row_step
        if not (0 <= c < len(columns) and 0 <= r < len(columns[c])):
            return shared
        found.append(columns[c][r])
    return tuple(found)


def offsets_of(layout: Layout) -> tuple[tuple[float, float], ...]:
    """Where the nozzles are from the primary one, x and y, mm."""
    row, column = _place(layout.primary)
    places = map(_place, layout.nozzles)
    return tuple((_PITCH_MM * (c - column), _PITCH_MM * (row - r)) for r, c in places)


def _place(nozzle: str) -> tuple[int, int]:
    """Row from 0, column from 1."""
    return _ROWS.index(nozzle[0]), int(nozzle[1:])
