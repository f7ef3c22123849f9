"""Which names of the protocol held which wells: the names that the scientist gave.

The local names of each of the protocol's functions are looked at as it returns, through loops
and helpers, even in helpers that move no liquid.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Any

from ..vocabulary import WellRef
from .held import DEEPEST, Reader, Row, entries, items
from .objects import is_member, word_of
from .own_functions import helper_modules, own_functions
from .returns import heard_returns
from .wells import WellResolver

_SHARES_LOCALS = sys.version_info < (3, 13)
"""Whether all who ask for a function's local names get the same dict, brought up to date."""
_ASKS_FOR_LOCALS = frozenset({"locals", "vars", "f_locals"})
_MOST_LOOKS = 5000
"""A function that returns more often computes something: at 10 µs a look it would be felt."""


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
    rows: tuple[Row, ...] = ()
    values: tuple[str | float, ...] = ()
    numbers: tuple[tuple[str, float], ...] = ()


class NameCollector:
    """Collects the names of one run.

    Args:
        wells: Knows the run's labware.
        file_name: ``co_filename`` of the protocol's code.
    """

    def __init__(self, wells: WellResolver, file_name: str) -> None:
        self._reader = Reader(wells)
        self._file_name = file_name
        self._bindings: dict[NameBinding, None] = {}
        self._returns: Counter[tuple[str, int]] = Counter()
        self._looks: dict[tuple[str, str], tuple[int, ...]] = {}
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
            if not name.startswith("__"):
                # A well of another context, say: no reason to stop the protocol.
                with suppress(Exception):
                    if self._is_new(function, name, value):
                        self._take(name, value, function, line, 0)

    def _is_new(self, function: str, name: str, value: Any) -> bool:
        """Whether a name holds anything else than at the last look: containers are long."""
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
            for key, item in entries(value):
                said = word_of(key) if is_member(key) else key
                if isinstance(said, (str, int, float)):
                    self._take(f"{name}[{said!r}]", item, function, line, depth + 1)
            for key, item in read.fields(value):
                self._take(f"{name}.{key}", item, function, line, depth + 1)
        binding = NameBinding(
            name,
            read.wells(value, depth),
            function,
            line,
            read.labware(value, depth),
            read.spots(value, depth),
            read.rows(value),
            read.values(value),
            read.numbers(value),
        )
        if len(binding.labware) == 1 and issubclass(type(value), read.labware_type):
            self._labware[binding.labware[0]] = value
        if read.is_place(value):
            self._places.add(binding)
        self._add(binding)

    def _add(self, found: NameBinding) -> None:
        if any((found.wells, found.labware, found.spots, found.rows, found.values, found.numbers)):
            self._bindings.setdefault(found)

    def _look_at_notes(self) -> None:
        """What the protocol wrote on the wells themselves."""
        notes: dict[str, list[Row]] = {}
        for labware in self._labware.values():
            for well in labware.wells():
                for name, said in self._reader.notes(well):
                    ref = self._reader.wells(well)
                    if ref:
                        notes.setdefault(name, []).append(Row((("", ref[0]), (name, said))))
        for name, rows in notes.items():
            self._add(NameBinding(name, (), "<wells>", 0, rows=tuple(rows)))

    @contextmanager
    def watching(self, namespace: Mapping[str, Any], text: str = "") -> Iterator[None]:
        """Look at the names of the protocol's functions as they return, in this thread.

        Args:
            namespace: The protocol's globals.
            text: Its source, where there is no file to read it from.
        """
        modules = helper_modules(namespace)
        self._reader.modules = {str(namespace.get("__name__", "builtins"))}
        self._reader.modules.update(module.__name__ for module in modules)
        files = {self._file_name, *(str(module.__file__) for module in modules)}
        functions = {
            id(function): function
            for names in (namespace, *map(vars, modules))
            for function in own_functions(names, files)
        }

        def source(file_name: str) -> str:
            if text and file_name == self._file_name:
                return text
            try:
                return Path(file_name).read_text(encoding="utf-8")
            except (OSError, ValueError):
                return ""

        try:
            with heard_returns(tuple(functions.values()), source, self._look_at):
                yield
        finally:
            for module in modules:
                self.look(vars(module), f"{module.__name__}.<module>", 0)
            with suppress(Exception):
                self._look_at_notes()
            self._labware.clear()

    def _look_at(self, frame: FrameType) -> None:
        code = frame.f_code
        if _SHARES_LOCALS and not _ASKS_FOR_LOCALS.isdisjoint(code.co_names):
            return  # to look would write into the dict that the protocol itself holds
        place = (code.co_filename, code.co_firstlineno)
        self._returns[place] += 1
        if self._returns[place] > _MOST_LOOKS:
            return
        if code.co_filename == self._file_name:
            self.look(frame.f_locals, code.co_name, code.co_firstlineno)
        else:
            module = frame.f_globals.get("__name__", "")
            self.look(frame.f_locals, f"{module}.{code.co_name}", 0)
