"""Well names as people write them: ``A1-B3``, ``column 12``, ``rows A to D``."""

from __future__ import annotations

import re

from ...instrumentation import LabwareInfo
from ..trace import row_column

_WELL = r"[A-P](?:0?[1-9]|1\d|2[0-4])"
COLUMN, COLUMNS = "col|column|spalte|colonne|columna", "cols|columns|spalten|colonnes|columnas"
ROW, ROWS = "row|zeile|reihe|ligne|fila", "rows|zeilen|reihen|lignes|filas"
"""What people call them; for patterns."""

TO = r"\s*(?:-|–|to|bis)\s*"
_AND = r"\s*(?:,|/|&|\+|and|und|et|y)\s*"
_NUMBERS = rf"(?:1\d|2[0-4]|[1-9])(?!\d)(?:{TO}\d+)?"
_LETTERS = rf"[A-P](?![A-Za-z0-9])(?:{TO}[A-P](?![A-Za-z0-9]))?"

WELL_SPEC = re.compile(
    rf"\b(?:(?P<first>{_WELL})(?:\s*(?:-|–|—|to|through|\.\.+|:)\s*(?P<last>{_WELL}))?"
    rf"|(?i:{COLUMNS})\.?\s*(?P<columns>{_NUMBERS}(?:{_AND}{_NUMBERS})*)"
    rf"|(?i:{COLUMN})\.?\s*(?P<column>{_NUMBERS})"
    rf"|(?i:{ROWS})\s+(?P<rows>{_LETTERS}(?:{_AND}{_LETTERS})*)"
    rf"|(?i:{ROW})\s+(?P<row>{_LETTERS}))\b"
)
"""A well, a range of them, or columns and rows; only a plural lists several: "columns 1 and 2"."""

_RANGE = re.compile(rf"(\w+)(?:{TO}(\w+))?")


def spec_wells(spec: str, info: LabwareInfo) -> list[str]:
    """Well names of ``"A1"``, ``"A1-B3"``, ``"A1, A2"``, ``"column 12"``, ``"row A"``, ``"*"``."""
    if spec.strip() in ("", "*"):
        return list(info.wells)
    names: list[str] = []
    for match in WELL_SPEC.finditer(spec):
        names.extend(name for name in wells_meant(match, info) if name not in names)
    return names


def wells_meant(match: re.Match[str], info: LabwareInfo) -> list[str]:
    """The wells of this labware that a match of :data:`WELL_SPEC` stands for."""
    parts = match.groupdict()
    names = list(info.wells)
    if parts["first"]:
        first = _plain(parts["first"])
        if not parts["last"]:
            return [first] if first in info.wells else []
        (r1, c1), (r2, c2) = row_column(first), row_column(_plain(parts["last"]))
        rows, columns = sorted((r1, r2)), sorted((c1, c2))
        return [
            name
            for name in names
            if rows[0] <= row_column(name)[0] <= rows[1]
            and columns[0] <= row_column(name)[1] <= columns[1]
        ]
    listed = parts["columns"] or parts["column"]
    axis = 1 if listed else 0
    wanted: set[int] = set()
    for text in re.split(_AND, listed or parts["rows"] or parts["row"]):
        low, high = _RANGE.findall(text)[0]
        wanted.update(range(_number(low), _number(high or low) + 1))
    return [name for name in names if row_column(name)[axis] in wanted]


def _number(text: str) -> int:
    """Place of a column ``"12"`` or of a row ``"H"``, counted from 0."""
    return int(text) - 1 if text.isdigit() else row_column(text + "1")[0]


def _plain(name: str) -> str:
    return name[0] + str(int(name[1:]))
