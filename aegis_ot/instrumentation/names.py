"""Which local names of the protocol held which wells: the names that the scientist gave.

A profile hook on the return of the protocol's own functions sees every local name with its
last value, through loops, helpers and comprehensions, even in helpers that move no liquid.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from types import FrameType
from typing import Any

from ..vocabulary import WellRef
from .wells import WellResolver

_DEEPEST = 3
"""Containers nested deeper than this are not a plate map any more."""


@dataclass(frozen=True)
class NameBinding:
    """One name that held wells.

    Attributes:
        name: As written in the protocol; ``layout["ntc"]`` for an entry of a dict.
        wells: The wells it held, in order; empty for a name that held whole labware.
        function: The function whose local it was, ``"<module>"`` for a global.
        line: First line of that function.
        labware: Keys of the labware it held, in order.
    """

    name: str
    wells: tuple[WellRef, ...]
    function: str
    line: int
    labware: tuple[str, ...] = ()


class NameCollector:
    """Collects the names of one run."""

    def __init__(self, wells: WellResolver, file_name: str) -> None:
        self._wells = wells
        self._file_name = file_name
        self._bindings: dict[tuple[object, ...], NameBinding] = {}

    @property
    def bindings(self) -> tuple[NameBinding, ...]:
        """What was found so far, each once, in order of appearance."""
        return tuple(self._bindings.values())

    def look(self, names: Mapping[str, Any], function: str, line: int) -> None:
        """Take in the local (or global) names of one function."""
        for name, value in list(names.items()):
            if not name.startswith("__"):
                self._take(name, value, function, line, 0)

    def _take(self, name: str, value: Any, function: str, line: int, depth: int) -> None:
        if isinstance(value, dict) and depth < _DEEPEST:
            for key, item in list(value.items()):
                if isinstance(key, (str, int)):
                    self._take(f"{name}[{key!r}]", item, function, line, depth + 1)
        wells, labware = self._wells_in(value, depth), self._labware_in(value, depth)
        if wells or labware:
            binding = NameBinding(name, wells, function, line, labware)
            self._bindings.setdefault((function, name, wells, labware), binding)

    def _wells_in(self, value: Any, depth: int) -> tuple[WellRef, ...]:
        core = getattr(value, "_core", None)
        if core is not None and hasattr(core, "get_max_volume") and hasattr(core, "get_top"):
            info = self._wells.info_of(core)
            return () if info.is_tip_rack else (self._wells.ref(info.key, str(core.get_name())),)
        if isinstance(value, (list, tuple, set, frozenset)) and depth < _DEEPEST:
            return tuple(ref for item in value for ref in self._wells_in(item, depth + 1))
        return ()

    def _labware_in(self, value: Any, depth: int) -> tuple[str, ...]:
        core = getattr(value, "_core", None)
        if core is not None and hasattr(core, "get_well_core"):
            return (self._wells.register(core).key,)
        if isinstance(value, (list, tuple)) and depth < _DEEPEST:
            return tuple(key for item in value for key in self._labware_in(item, depth + 1))
        return ()

    @contextmanager
    def watching(self) -> Iterator[None]:
        """Watch the returns of the protocol's functions in this thread."""
        previous = sys.getprofile()

        def hook(frame: FrameType, event: str, _argument: Any) -> None:
            if event == "return" and frame.f_code.co_filename == self._file_name:
                code = frame.f_code
                self.look(frame.f_locals, code.co_name, code.co_firstlineno)

        if previous is not None:  # a profiler or debugger is at work: leave it in peace
            yield
            return
        sys.setprofile(hook)
        try:
            yield
        finally:
            sys.setprofile(None)
