"""Well names as people write them: ``A1-B3``, ``column 12``, ``rows A to D``."""

from __future__ import annotations

import re

from ...instrumentation import LabwareInfo
from ..trace import row_column

_WELL = r"[A-P](?:0?[1-9]|1\d|2[0-4])"

WELL_SPEC = re.compile(
    rf"\b(?:(?P<first>{_WELL})(?:\s*(?:-|–|—|to|through|\.\.+|:)\s*(?P<last>{_WELL}))?"
    r"|col(?:umn)?s?\.?\s*(?P<column>1\d|2[0-4]|[1-9])(?:\s*(?:-|–|to)\s*(?P<column2>\d+))?"
    r"|rows?\s+(?P<row>[A-P])(?:\s*(?:-|–|to)\s*(?P<row2>[A-P]))?)\b"
)


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
    if parts["column"]:
        low = int(parts["column"])
        high = int(parts["column2"] or low)
        return [name for name in names if low <= row_column(name)[1] + 1 <= high]
    low_row = row_column(parts["row"] + "1")[0]
    high_row = row_column((parts["row2"] or parts["row"]) + "1")[0]
    return [name for name in names if low_row <= row_column(name)[0] <= high_row]


def _plain(name: str) -> str:
    return name[0] + str(int(name[1:]))
