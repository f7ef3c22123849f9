"""Well names as people write them: ``A1``, ``A1-B3``, ``column 12``, ``rows A-D``."""

from __future__ import annotations

import re
from collections.abc import Collection

from ..trace import row_column

WELL = r"[A-P](?:1\d|2[0-4]|0?[1-9])(?!\d)"
_TO = r"\s*(?:-|–|—|:|\.\.+|\bto\b)\s*"
_AND = r"\s*(?:,\s*and\b|,|/|&|\+|\band\b)\s*"
_NUMBERS = rf"\d{{1,2}}(?:{_TO}\d{{1,2}})?"
_LETTERS = rf"[A-P](?:{_TO}[A-P])?"
_PLACE = re.compile(
    rf"(?P<first>{WELL})(?:{_TO}(?P<last>{WELL}))?"
    rf"|(?i:columns?|cols?\.?)\s*(?P<columns>{_NUMBERS}(?:{_AND}{_NUMBERS})*)"
    rf"|(?i:rows?)\s+(?P<rows>{_LETTERS}(?:{_AND}{_LETTERS})*)"
)
_ONE = rf"(?:{WELL}(?:{_TO}{WELL})?|(?i:columns?|cols?\.?)\s*{_NUMBERS}|(?i:rows?)\s+{_LETTERS})"
PLACES = rf"{_ONE}(?:{_AND}(?:{_ONE}|{_NUMBERS}(?![\w.])|{_LETTERS}(?!\w)))*"
"""A pattern for a list of places and nothing else."""

_SPAN = re.compile(rf"(\d+|[A-P])(?:{_TO}(\d+|[A-P]))?")


def wells_in(text: str, wells: Collection[str]) -> list[str]:
    """Names of those of a labware's wells that a list of places stands for: ``"A1, B2-B4"``,
    ``"columns 1-3"``, ``"row H"``; ``"*"`` or nothing is all.
    """
    if text.strip() in ("", "*"):
        return list(wells)
    found = (name for match in _PLACE.finditer(text) for name in _meant(match, wells))
    return list(dict.fromkeys(found))


def not_wells_in(text: str, wells: Collection[str]) -> str:
    """What of a list of places is no well of this labware: ``"Z99"``; empty if all is."""
    if text.strip() in ("", "*"):
        return ""
    rest = _PLACE.sub("", text)
    if re.sub(_AND, "", rest).strip():
        return text.strip()
    for match in _PLACE.finditer(text):
        ends = [plain_name(name) for name in (match["first"], match["last"]) if name]
        if not _meant(match, wells) or any(name not in wells for name in ends):
            return match[0].strip()
    return ""


def _meant(match: re.Match[str], wells: Collection[str]) -> list[str]:
    """Wells column by column; a labware's definition may list them from H1 to A1."""
    rows: Collection[int] | None = None
    columns: Collection[int] | None = None
    if match["first"]:
        ends = (row_column(match["first"]), row_column(match["last"] or match["first"]))
        rows, columns = (range(min(axis), max(axis) + 1) for axis in zip(*ends, strict=True))
    elif match["columns"]:
        columns = _counted(match["columns"])
    else:
        rows = _counted(match["rows"])
    found = [
        name
        for name in wells
        if (rows is None or row_column(name)[0] in rows)
        and (columns is None or row_column(name)[1] in columns)
    ]
    return sorted(found, key=lambda name: row_column(name)[::-1])


def _counted(listed: str) -> set[int]:
    """Places of a list of columns or rows, counted from 0."""
    found: set[int] = set()
    for span in _SPAN.finditer(listed):
        low, high = (
            int(end) - 1 if end.isdecimal() else row_column(end + "1")[0]
            for end in (span[1], span[2] or span[1])
        )
        found.update(range(low, high + 1))
    return found


def plain_name(name: str) -> str:
    """``"A1"`` for ``"A01"``."""
    return name[0] + str(int(name[1:]))
