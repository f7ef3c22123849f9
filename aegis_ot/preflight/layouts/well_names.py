"""Well names as people write them: ``A1-B3``, ``column 12``, ``rows A to D``."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterable

from ...instrumentation import LabwareInfo
from ..rules import Common
from ..text import any_of
from ..trace import row_column

SLOT = r"(?:[A-D][1-4]|1[01]|[1-9])"
"""A slot of a Flex, or of an OT-2."""

_WELL = r"[A-P](?:0?[1-9]|1\d|2[0-4])"


class WellNames:
    """Finds well names in a text, with the words that ``layout`` lists in ``common.json``.

    Its parts of patterns are for those who read more of a layout than names.

    Attributes:
        column, columns, row, rows: What people call one or several, in any case.
        any_column, any_row: Either of the two.
        to, conjunction: What stands between the ends of a range, and between members of a list.
        between: What may stand between two wells of one list.
        places: Wells and ranges of them, one behind the other.
        and_at_end: What joins a clause to the next one.
        further: What ends a list of wells: "A2, A3 and A4".
        of: What joins rows to columns: "columns 1-6 of row H".
        strips: What people call strips of tubes, of which each is a column.
        odd, even: What people call every other column: "odd columns".
        slot, position: What people call the places of the deck; "slot C2" is none of a plate, a
            "position" may be one of a rack.
        first_word_of: For ``column`` and ``row`` the word that is put where one is left out.
        plural_columns, plural_rows: The same for several columns, or rows.
        spec: A well, a range of them, or columns and rows; only a plural lists several:
            "columns 1 and 2".
    """

    def __init__(self, layout: dict[str, tuple[str, ...]]) -> None:
        self.column, self.columns, self.row, self.rows = (
            f"(?i:{any_of(layout.get(kind, ()))})" for kind in ("column", "columns", "row", "rows")
        )
        self.any_column = f"(?:{self.columns}|{self.column})"
        self.any_row = f"(?:{self.rows}|{self.row})"
        self.to = rf"\s*(?:-|–|—|…|\.\.+|\b(?:{any_of(layout.get('to', ()))})\b)\s*"
        self.conjunction = rf"\s*(?:,|/|&|\+|\b(?:{any_of(layout.get('and', ()))})\b)\s*"
        self.of = any_of(layout.get("of", ()))
        self.strips = f"(?i:(?:{any_of(layout.get('strip', ()))})s?)"
        self.odd, self.even = (f"(?i:{any_of(layout.get(kind, ()))})" for kind in ("odd", "even"))
        slots = layout.get("slot", ())
        self.position = rf"(?i:\b(?:{any_of(layout.get('position', ()))})\b\.?)"
        self.slot = rf"(?i:\b(?:{any_of(slots)}))"
        in_plate = "".join(rf"(?<!\b(?i:{re.escape(word)}) )" for word in slots)
        self.first_word_of = {kind: (*layout.get(kind, ()), kind)[0] for kind in ("column", "row")}
        self.plural_columns = (*layout.get("columns", ()), "columns")[0]
        self.plural_rows = (*layout.get("rows", ()), "rows")[0]
        numbers = rf"(?:1\d|2[0-4]|[1-9])(?!\d)(?:{self.to}\d{{1,2}}(?!\d))?"
        letters = rf"[A-P](?![A-Za-z0-9])(?:{self.to}[A-P](?![A-Za-z0-9]))?"
        self.spec = re.compile(
            rf"\b(?:{in_plate}(?P<first>{_WELL})(?:(?:{self.to}|\s*:\s*)(?P<last>{_WELL}))?"
            rf"|{self.columns}\.?\s*(?P<columns>{numbers}(?:{self.conjunction}{numbers})*)"
            rf"|{self.column}\.?\s*(?P<column>{numbers}(?:[/&+]{numbers})*)"
            rf"|{self.rows}\s+(?P<rows>{letters}(?:{self.conjunction}{letters})*)"
            rf"|{self.row}\s+(?P<row>{letters}(?:[/&+]{letters})*))\b"
        )
        self.between = re.compile(rf"[\s,/&+]*(?:\b(?:{any_of(layout.get('and', ()))})\b[\s,]*)?")
        and_ = rf"\b(?:{any_of(layout.get('and', ()))})\b"
        self.and_at_end = re.compile(rf"\s+{and_}\s*$")
        self.further = re.compile(rf"\s*{_WELL}(?:\s*,\s*{_WELL})*\s*,?\s+{and_}\s+{_WELL}\b")
        spots = rf"{_WELL}(?:{self.to}{_WELL})?"
        self.places = re.compile(rf"{spots}(?:{self.conjunction}{spots})*(?!\w)")
        self._conjunction = re.compile(self.conjunction)
        self._range = re.compile(rf"(\d+|[A-P])(?:{self.to}(\d+|[A-P]))?")

    def wells(self, spec: str, info: LabwareInfo) -> list[str]:
        """Names of ``"A1"``, ``"A1-B3"``, ``"A1, A2"``, ``"column 12"``, ``"row A"``, ``"*"``."""
        if spec.strip() in ("", "*"):
            return list(info.wells)
        names: list[str] = []
        for match in self.spec.finditer(spec):
            names.extend(name for name in self.meant(match, info) if name not in names)
        return names

    def meant_by(self, matches: Iterable[re.Match[str]], info: LabwareInfo) -> list[str]:
        """The wells that several matches stand for: where rows and columns meet, if both are named,
        "column 2: vehicle (rows C-F)".
        """
        wells: list[str] = []
        lines: dict[str, list[str]] = {}
        for match in matches:
            axis = "column" if match["column"] or match["columns"] else "row"
            named = wells if match["first"] else lines.setdefault(axis, [])
            named += self.meant(match, info)
        one, *other = lines.values() or [[]]
        return wells + [name for name in one if not other or name in other[0]]

    def meant(self, match: re.Match[str], info: LabwareInfo) -> list[str]:
        """The wells of this labware that a match of :attr:`spec` stands for."""
        parts = match.groupdict()
        if parts["first"]:
            first = plain_name(parts["first"])
            if not parts["last"]:
                return [first] if first in info.wells else []
            (r1, c1), (r2, c2) = row_column(first), row_column(plain_name(parts["last"]))
            rows, columns = sorted((r1, r2)), sorted((c1, c2))
            return _in_order(
                name
                for name in info.wells
                if rows[0] <= row_column(name)[0] <= rows[1]
                and columns[0] <= row_column(name)[1] <= columns[1]
            )
        listed = parts["columns"] or parts["column"]
        axis = 1 if listed else 0
        wanted = set(self._counted(listed or parts["rows"] or parts["row"]))
        return _in_order(name for name in info.wells if row_column(name)[axis] in wanted)

    def numbers(self, listed: str) -> list[str]:
        """The columns or rows of a list, as they are written: "1-3, 5" are 1, 2, 3 and 5."""
        letters = listed[:1].isalpha()
        return [chr(ord("A") + at) if letters else str(at + 1) for at in self._counted(listed)]

    def crossed(self, first: str, last: str, columns: str) -> str:
        """The wells of rows, ``first`` to ``last`` if that is given, in columns: "A1-C2, A5-C5"."""
        spans: list[list[int]] = []
        for at in self._counted(columns):
            if spans and spans[-1][1] == at - 1:
                spans[-1][1] = at
            else:
                spans.append([at, at])
        wells = [(f"{first}{low + 1}", f"{last or first}{high + 1}") for low, high in spans]
        return ", ".join(one if one == other else f"{one}-{other}" for one, other in wells)

    def _counted(self, listed: str) -> list[int]:
        """Places of a list of columns or rows, counted from 0, in its order."""
        found: list[int] = []
        for text in self._conjunction.split(listed):
            low, high = self._range.findall(text)[0]
            found += range(_number(low), _number(high or low) + 1)
        return found


def _in_order(names: Iterable[str]) -> list[str]:
    """Wells column by column; a labware's definition may list them from H1 to A1."""
    return sorted(names, key=lambda name: row_column(name)[::-1])


def well_names(common: Common) -> WellNames:
    """Well names in the words of the rule files, made once for equal lists."""
    layout = {**common.layout, "strip": common.labware.get("strip", ())}
    return _made(tuple((kind, tuple(words)) for kind, words in layout.items()))


@functools.lru_cache(maxsize=8)
def _made(layout: tuple[tuple[str, tuple[str, ...]], ...]) -> WellNames:
    return WellNames(dict(layout))


def _number(text: str) -> int:
    """Place of a column ``"12"`` or of a row ``"H"``, counted from 0."""
    return int(text) - 1 if text.isdecimal() else row_column(text + "1")[0]


_SPAN = re.compile(rf"({_WELL})\s*[:-]\s*({_WELL})")


def wells_between(text: str) -> tuple[str, ...]:
    """The names of wells that a constant is, or spans along one row or column: ``"A1:H1"``.

    None of a wider span, which may go on row by row or column by column, nor of another text.
    """
    ends = _SPAN.fullmatch(text)
    if ends is None:
        return (plain_name(text),) if re.fullmatch(_WELL, text) else ()
    (r1, c1), (r2, c2) = (row_column(plain_name(end)) for end in ends.groups())
    if r1 == r2 and c1 < c2:
        return tuple(f"{chr(ord('A') + r1)}{column + 1}" for column in range(c1, c2 + 1))
    if c1 == c2 and r1 < r2:
        return tuple(f"{chr(ord('A') + row)}{c1 + 1}" for row in range(r1, r2 + 1))
    return ()


def plain_name(name: str) -> str:
    """``"A1"`` for ``"A01"``."""
    return name[0] + str(int(name[1:]))
