"""Which names of the protocol held which wells: the names that the scientist gave.

The tap walks the stack at each operation and event anyway, to find the protocol's line. The
functions of the protocol that it meets there are looked at once they have returned, with the
last values of their local names; the protocol's globals at the end of the run. Names that hold a
well are looked at each time: a loop binds its name anew (``for standard, well in zip(...)``). A
function that did nothing to the robot, not even load something, is not seen: its names count
where another name holds what it gave back.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from types import CodeType, FrameType
from typing import Any

from ....vocabulary import WellRef
from .callsite import ProtocolStack
from .objects import is_member, word_of
from .own_code import helper_modules
from .value_reader import BARE, DEEPEST, PlateMapRow, ValueReader, entries, is_spot, items
from .wells import WellResolver

_SHARES_LOCALS = sys.version_info < (3, 13)
"""Whether all who ask for a function's local names get the same dict, brought up to date."""
_ASKS_FOR_LOCALS = frozenset({"locals", "vars", "f_locals"})


@dataclass(frozen=True)
class NameBinding:
    """One name that held wells, or that tells of some.

    Attributes:
        name: As written in the protocol; ``layout["ntc"]`` for an entry of a dict, ``self.ntc``
            for an attribute of an object of the protocol's own making.
        wells: The wells it held, in order; empty for a name that held whole labware.
        function: The function whose local it was, ``"<module>"`` for a global; with the module's
            name in front, ``"layout.wells_of"``, in a helper module.
        line: First line of that function; 0 in a helper module, whose lines are not the
            protocol's.
        labware: Keys of the labware it held, in order.
        spots: Names of wells (``"A12"``) that it held as text, in order, of whatever labware.
        rows: Rows of a plate map that it held: words and numbers beside wells.
        values: Words and numbers that it held as a plain list, one beside another.
        numbers: Keys and numbers that it held as a plain dict: ``{"std1": 2000.0}``.
    """

    name: str
    wells: tuple[WellRef, ...]
    function: str
    line: int
    labware: tuple[str, ...] = ()
    spots: tuple[str, ...] = ()
    rows: tuple[PlateMapRow, ...] = ()
    values: tuple[str | float, ...] = ()
    numbers: tuple[tuple[str, float], ...] = ()


class NameCollector:
    """Collects the names of one run.

    Args:
        wells: Knows the run's labware.
        stack: Meets the protocol's functions.
        file_name: ``co_filename`` of the protocol's code.
    """

    def __init__(self, wells: WellResolver, stack: ProtocolStack, file_name: str) -> None:
        self._reader = ValueReader(wells)
        self._stack = stack
        self._file_name = file_name
        self._bindings: dict[NameBinding, None] = {}
        self._looks: dict[tuple[str, str], tuple[int, ...]] = {}
        self._last: dict[tuple[str, str], Any] = {}
        self._labware: dict[str, Any] = {}
        self._places: set[NameBinding] = set()

    @property
    def bindings(self) -> tuple[NameBinding, ...]:
        """What was found so far, each once, in order of appearance.

        The name of a place in a well, which a loop often binds anew, only where no other name
        holds that well: ``position = tube.bottom(1)``.
        """
        named = {ref for one in self._bindings if one not in self._places for ref in one.wells}
        return tuple(
            one for one in self._bindings if one not in self._places or named.isdisjoint(one.wells)
        )

    def look(self, names: Mapping[str, Any], function: str, line: int) -> None:
        """Take in the local (or global) names of one function."""
        for name, value in list(names.items()):
            if not name.startswith("__") and _may_hold(value):
                # A well of another context, say: no reason to stop the protocol.
                with suppress(Exception):
                    if self._is_new(function, name, value):
                        self._take(name, value, function, line, 0)

    def _is_new(self, function: str, name: str, value: Any) -> bool:
        """Whether a name holds anything else than at the last look: containers are long."""
        if type(value) in self._reader.lasting:
            if self._last.get((function, name)) is value:
                return False
            self._last[(function, name)] = value
            return True
        listed = [item for _, item in entries(value)] or items(value)
        if not listed:
            return True
        seen = (
            id(value),
            *map(id, listed),
            *(len(item) for item in listed if type(item) in (dict, list)),
        )
        if self._looks.get((function, name)) == seen:
            return False
        self._looks[(function, name)] = seen
        return True

    def _take(self, name: str, value: Any, function: str, line: int, depth: int) -> None:
        if depth and not self._is_new(function, name, value):
            return  # what an object holds is looked at again and again, by all of its methods
        read = self._reader
        if depth < DEEPEST:
            held = entries(value)
            if _is_labware_definition(held):
                return
            for key, item in held:
                said = word_of(key) if is_member(key) else key
                if _may_hold(item) and isinstance(said, (str, int, float)):
                    self._take(f"{name}[{said!r}]", item, function, line, depth + 1)
            for key, item in read.fields(value):
                if _may_hold(item):
                    self._take(f"{name}.{key}", item, function, line, depth + 1)
        held_by_it = read.read(value, depth)
        if not any(held_by_it):
            return
        binding = NameBinding(name, held_by_it.wells, function, line, *held_by_it[1:])
        if len(binding.labware) == 1 and issubclass(type(value), read.labware_type):
            self._labware[binding.labware[0]] = value
        if read.is_place(value):
            self._places.add(binding)
        self._bindings.setdefault(binding)

    @contextmanager
    def gathering(self, namespace: Mapping[str, Any]) -> Iterator[None]:
        """As :meth:`watching`, for who asks :meth:`so_far` and needs no last look."""
        self._reader.own_modules[str(namespace.get("__name__", "builtins"))] = True
        self._stack.met, self._stack.returned = self._look_at_wells, self._look_at
        try:
            yield
        finally:
            self._stack.met = self._stack.returned = None
            self._stack.close()
            self._last.clear()
            self._labware.clear()

    def so_far(self, namespace: Mapping[str, Any]) -> tuple[NameBinding, ...]:
        """What the names hold now, those of functions that are not over yet included.

        Args:
            namespace: The protocol's globals.
        """
        for frame in self._stack.running:
            self._look_at(frame)
        for module in helper_modules(namespace):
            self.look(vars(module), f"{module.__name__}.<module>", 0)
        self.look(namespace, "<module>", 1)
        return self.bindings

    def _look_at_notes(self) -> None:
        """What the protocol wrote on the wells themselves."""
        notes: dict[str, list[PlateMapRow]] = {}
        for labware in self._labware.values():
            for well in labware.wells():
                for name, said in self._reader.notes(well):
                    ref = self._reader.wells(well)
                    if ref:
                        notes.setdefault(name, []).append(PlateMapRow((("", ref[0]), (name, said))))
        for name, rows in notes.items():
            self._bindings.setdefault(NameBinding(name, (), "<wells>", 0, rows=tuple(rows)))

    @contextmanager
    def watching(self, namespace: Mapping[str, Any]) -> Iterator[None]:
        """Look at the local names of the protocol's functions, and in the end at its globals.

        Args:
            namespace: The protocol's globals.
        """
        with self.gathering(namespace):
            yield
            self._stack.close()
            self.so_far(namespace)
            with suppress(Exception):
                self._look_at_notes()

    def _look_at(self, frame: FrameType) -> None:
        if _may_be_read(frame.f_code):
            names = frame.f_locals
            self.look(names, *self._function_of(frame))
            if _SHARES_LOCALS:
                names.clear()  # this copy would keep alive what the function lets go of

    def _look_at_wells(self, frame: FrameType) -> None:
        if not _may_be_read(frame.f_code):
            return
        well_type = self._reader.well_type
        function = None
        names = frame.f_locals
        for name, value in names.items():
            if type(value) is well_type:
                function = function or self._function_of(frame)
                if self._last.get((function[0], name)) is not value:
                    self.look({name: value}, *function)
        if _SHARES_LOCALS:
            names.clear()

    def _function_of(self, frame: FrameType) -> tuple[str, int]:
        """Name and first line of a frame's function; see :class:`NameBinding`."""
        code = frame.f_code
        if code.co_filename == self._file_name:
            return code.co_name, code.co_firstlineno
        return f"{frame.f_globals.get('__name__', '')}.{code.co_name}", 0


def _may_be_read(code: CodeType) -> bool:
    """Whether a function's local names tell of a well's use, and can be read unnoticed."""
    if code.co_name.startswith("<"):
        return False  # comprehensions and lambdas; a module's names are looked at in the end
    if not code.co_flags & inspect.CO_OPTIMIZED:
        return False  # a class body, whose names may stand in a dict of its own making
    # To look would write into the dict that the protocol itself holds.
    return not _SHARES_LOCALS or _ASKS_FOR_LOCALS.isdisjoint(code.co_names)


def _may_hold(value: Any) -> bool:
    """Whether a value can tell of wells at all: most names hold numbers, texts and functions."""
    return type(value) not in BARE or is_spot(value)


def _is_labware_definition(held: Sequence[tuple[Any, Any]]) -> bool:
    """Whether a dict defines labware, and so names wells without telling of their use."""
    return {"schemaVersion", "wells", "ordering"} <= {key for key, _ in held if type(key) is str}
