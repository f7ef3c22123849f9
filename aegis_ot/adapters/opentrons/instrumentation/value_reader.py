"""What a value of the protocol holds: wells, labware, names of wells, and rows of a plate map."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from types import BuiltinFunctionType, FunctionType, ModuleType, SimpleNamespace
from typing import Any, NamedTuple, TypeAlias

from ....vocabulary import WellRef
from .objects import attributes, is_enum, is_member, members, value_of, word_of
from .own_code import is_helper_module
from .wells import WellResolver

DEEPEST = 3
"""Containers nested deeper than this are not a plate map any more."""
LONGEST = 1536
"""Nor longer ones: no plate has more wells, and rows of data are not worth the time."""

BARE = frozenset(
    {
        bool,
        bytes,
        complex,
        float,
        int,
        str,
        type(None),
        BuiltinFunctionType,
        FunctionType,
        ModuleType,
    }
)
"""Types that hold nothing else."""

_LONGEST_TEXT = 200
_MADE_IN_PYTHON = 1 << 9
"""``Py_TPFLAGS_HEAPTYPE``: in a protocol all classes say that they are of ``builtins``."""
_SPOT = re.compile(r"[A-P](?:0?[1-9]|1\d|2[0-4])")

Cell: TypeAlias = "WellRef | str | float"


@dataclass(frozen=True)
class PlateMapRow:
    """One row of a plate map: a well and what is said beside it.

    Attributes:
        cells: Pairs of a column's name and what stands there: a well, the name of a well, other
            words, a number. The column is ``""`` where it has no name; both cells of an entry
            ``{"A1": "NTC"}`` are of that kind.
    """

    cells: tuple[tuple[str, Cell], ...]

    @property
    def wells(self) -> tuple[WellRef, ...]:
        """The wells in it."""
        return tuple(cell for _, cell in self.cells if isinstance(cell, WellRef))

    @property
    def spots(self) -> tuple[str, ...]:
        """The names of wells in it (``"A1"``), of whatever labware."""
        return tuple(cell for _, cell in self.cells if isinstance(cell, str) and is_spot(cell))

    @property
    def said(self) -> tuple[tuple[str, str | float], ...]:
        """All else: words and numbers, each with its column."""
        return tuple(
            (column, cell)
            for column, cell in self.cells
            if not isinstance(cell, WellRef) and not is_spot(cell)
        )


def is_spot(value: Any) -> bool:
    """Whether this is the name of a well, as ``"A1"`` or ``"H12"``."""
    return issubclass(type(value), str) and _SPOT.fullmatch(value) is not None


class Held(NamedTuple):
    """What one value holds; see :class:`~.names.NameBinding`."""

    wells: tuple[WellRef, ...] = ()
    labware: tuple[str, ...] = ()
    spots: tuple[str, ...] = ()
    rows: tuple[PlateMapRow, ...] = ()
    values: tuple[str | float, ...] = ()
    numbers: tuple[tuple[str, float], ...] = ()


class ValueReader:
    """Reads values without trusting them: only Python's own containers are opened, past whatever
    a subclass of the protocol makes of them.

    Attributes:
        own_modules: Whether classes with this ``__module__`` are the protocol's own.
        lasting: Types of what lives as long as the run, so that it may be held on to.
    """

    def __init__(self, wells: WellResolver) -> None:
        from opentrons.protocol_api import Labware, Well
        from opentrons.types import Location

        # Asked for by type: a protocol's own objects may answer any attribute, or raise at it.
        self.well_type: type = Well
        self._location_type: Any = Location
        self.labware_type: type = Labware
        self._wells = wells
        self.own_modules: dict[str, bool] = {}
        # Lists of nothing else are read in one go: wells() of a plate is asked for in each helper.
        self.lasting = frozenset({Well, Labware, str})
        self._all_wells = {Well}
        self._all_labware = {Labware}

    def read(self, value: Any, depth: int = 0) -> Held:
        """All that a value holds, in the given depth of what holds it."""
        if type(value) is self.well_type:
            return Held(wells=self.wells(value, depth))
        listed = items(value)
        kinds = set(map(type, listed))
        if kinds == self._all_wells and type(value) is list:
            return Held(wells=self.wells(value, depth))
        if kinds == self._all_labware and type(value) is list:
            return Held(labware=self.labware(value, depth))
        return Held(
            self.wells(value, depth),
            self.labware(value, depth),
            self.spots(value, depth),
            self.rows(value),
            self.values(value),
            self.numbers(value),
        )

    def wells(self, value: Any, depth: int = 0) -> tuple[WellRef, ...]:
        """The wells that a value is or lists, or is a place in (``well.top(-2)``), in order; tips
        are no wells.
        """
        if self.is_place(value):
            value = value.labware.as_well()
        if issubclass(type(value), self.well_type):
            core = value._core
            info = self._wells.info_of(core)
            return () if info.is_tip_rack else (self._wells.ref(info.key, str(core.get_name())),)
        found = items(value) if depth < DEEPEST else ()
        return tuple(
            ref for item in found if type(item) not in BARE for ref in self.wells(item, depth + 1)
        )

    def is_place(self, value: Any) -> bool:
        """Whether a value is a place in a well, and not of a type of the protocol's own making."""
        return type(value) is self._location_type and bool(value.labware.is_well)

    def labware(self, value: Any, depth: int = 0) -> tuple[str, ...]:
        """Keys of the labware that a value is or lists, in order."""
        if issubclass(type(value), self.labware_type):
            return (self._wells.register(value._core).key,)
        found = items(value) if depth < DEEPEST else ()
        if not found or set(map(type, found)) == self._all_wells:
            return ()
        return tuple(
            key for item in found if type(item) not in BARE for key in self.labware(item, depth + 1)
        )

    def spots(self, value: Any, depth: int = 0) -> tuple[str, ...]:
        """The names of wells that a value is or lists, if it lists nothing else."""
        if is_spot(value):
            return (value,)
        found: list[str] = []
        for item in items(value) if depth < DEEPEST else ():
            part = self.spots(item, depth + 1)
            if not part:
                return ()
            found += part
        return tuple(found)

    def values(self, value: Any) -> tuple[str | float, ...]:
        """Words and numbers in a plain list of at least two."""
        found: list[str | float] = []
        for item in items(value):
            plain = word_of(item) if is_member(item) else item
            if not _is_plain(plain):
                return ()
            found.append(plain)
        return tuple(found) if len(found) > 1 else ()

    def numbers(self, value: Any) -> tuple[tuple[str, float], ...]:
        """Keys and numbers of a dict of at least two that holds nothing else."""
        found: list[tuple[str, float]] = []
        for key, item in entries(value):
            if not _is_plain(key) or not _is_number(item):
                return ()
            found.append((str(key), item))
        return tuple(found) if len(found) > 1 else ()

    def rows(self, value: Any) -> tuple[PlateMapRow, ...]:
        """A plate map: ``{"A1": "NTC"}``, or rows (of a CSV file, say) that each name a well.

        A map from well to well tells of transfers and not of roles, unless its columns do.
        """
        named = entries(value) or self.fields(value)
        by_well = all(is_spot(key) or issubclass(type(key), self.well_type) for key, _ in named)
        if named and (by_well or self._are_rows(value)):
            found = [(*self._cells(key), *self._cells(item)) for key, item in named]
        elif named:
            found = [self._cells(value)]
        else:
            found = list(self._table(items(value)))
        return tuple(
            row
            for row in map(PlateMapRow, found)
            if (row.wells or row.spots) and (row.said or any(column for column, _ in row.cells))
        )

    def _table(self, lines: tuple[Any, ...]) -> Iterator[tuple[tuple[str, Cell], ...]]:
        columns: tuple[str, ...] = ()
        for at, line in enumerate(lines):
            if type(line) in BARE or type(line) is self.well_type:
                continue
            listed = items(line)
            if not listed and not entries(line) and not self.fields(line):
                continue
            if at == 0 and len(listed) > 1 and all(_is_word(item) for item in listed):
                columns = listed  # the header of a CSV file
            elif columns and len(listed) == len(columns):
                yield self._cells(dict(zip(columns, listed, strict=True)))
            elif set(map(type, listed)) != self._all_wells:  # else nothing is said in it
                yield self._cells(line)

    def _are_rows(self, value: Any) -> bool:
        """Whether a dict holds rows by name or number: ``{"s1": {"well": ..., "conc": ...}}``."""
        listed = [item for _, item in entries(value)]
        return len(listed) > 1 and all(entries(item) or self.fields(item) for item in listed)

    def _cells(self, value: Any, column: str = "") -> tuple[tuple[str, Cell], ...]:
        """What stands in one row; an object in it (``source.name``) is opened, one level deep."""
        named = entries(value) or self.fields(value)
        pairs = named or [("", item) for item in items(value)] or [("", value)]
        cells: list[tuple[str, Cell]] = []
        for name, item in pairs:
            beside = word_of(name) if is_member(name) else name if isinstance(name, str) else ""
            if column:
                beside = f"{column}.{beside}"
            if is_member(item):
                cells.append((beside, word_of(item)))
                item = value_of(item)
                if not is_spot(item):
                    continue
            if _is_plain(item):
                cells.append((beside, item))
            elif type(item) is self.well_type:
                cells += [(beside, ref) for ref in self.wells(item)]
            elif not column and item is not value and self.fields(item):
                cells += self._cells(item, beside or "item")
            else:
                cells += [(beside, ref) for ref in self.wells(item, DEEPEST - 1)]
                cells += [(beside, spot) for spot in self.spots(item, DEEPEST - 1)]
        return tuple(cells)

    def fields(self, value: Any) -> list[tuple[str, Any]]:
        """The attributes of a named tuple, or of an object or class of the protocol's making.

        Members of an Enum are words (:func:`word_of`) and have none; the Enum itself has them.
        """
        kind = type(value)
        if is_member(value):
            return []
        if is_enum(value):
            return members(value)
        if issubclass(kind, tuple):
            names = getattr(kind, "_fields", ())
            return list(zip(names, tuple.__iter__(value), strict=False))
        made = value if issubclass(kind, type) else kind
        if kind is not SimpleNamespace and not (
            made.__flags__ & _MADE_IN_PYTHON and self._is_own(made.__module__)
        ):
            return []
        return attributes(value)

    def _is_own(self, module: str) -> bool:
        own = self.own_modules.get(module)
        if own is None:
            own = self.own_modules[module] = is_helper_module(sys.modules.get(module))
        return own

    @staticmethod
    def notes(well: Any) -> list[tuple[str, str | float]]:
        """What the protocol wrote on a well itself: ``well.content = "NTC"``."""
        found = list(vars(well).items())
        return [(name, item) for name, item in found if name[:1] != "_" and _is_plain(item)]


def items(value: Any) -> tuple[Any, ...]:
    """What a list, tuple or set holds."""
    if type(value) in BARE:
        return ()
    for kind in (list, tuple, set, frozenset):
        if issubclass(type(value), kind):
            return tuple(kind.__iter__(value)) if kind.__len__(value) <= LONGEST else ()
    numpy = sys.modules.get("numpy")  # where the protocol has it
    if numpy is not None and type(value) is numpy.ndarray:
        return tuple(value.tolist()) if value.ndim == 1 and value.size <= LONGEST else ()
    return ()


def entries(value: Any) -> list[tuple[Any, Any]]:
    """Keys and values of a dict."""
    if issubclass(type(value), dict) and dict.__len__(value) <= LONGEST:
        return list(dict.items(value))
    return []


def _is_word(value: Any) -> bool:
    return issubclass(type(value), str) and value != "" and not is_spot(value)


def _is_plain(value: Any) -> bool:
    """Words or a number; not a flag."""
    if issubclass(type(value), str):  # isinstance would ask an object for its __class__
        return 0 < len(value) <= _LONGEST_TEXT
    return _is_number(value)


def _is_number(value: Any) -> bool:
    kind = type(value)
    return issubclass(kind, (int, float)) and not issubclass(kind, bool)
