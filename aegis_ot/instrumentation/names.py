"""Which local names of the protocol held which wells: the names that the scientist gave.

A profile hook on the return of the protocol's own functions sees every local name with its
last value, through loops, helpers and comprehensions, even in helpers that move no liquid.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from types import CodeType, FrameType
from typing import Any

from ..vocabulary import WellRef
from .wells import WellResolver

_DEEPEST = 3
"""Containers nested deeper than this are not a plate map any more."""
_LONGEST = 1536
"""Nor longer ones: no plate has more wells, and rows of data are not worth the time."""

_CHEAP_TO_TURN_OFF = sys.version_info < (3, 12)
"""From Python 3.12 on each change of the profile function makes all code be prepared anew."""


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
        from opentrons.protocol_api import Labware, Well

        # Asked for by type: a protocol's own objects may answer any attribute, or raise at it.
        self._well_type: type = Well
        self._labware_type: type = Labware
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
                # A well of another context, say: no reason to stop the protocol.
                with suppress(Exception):
                    self._take(name, value, function, line, 0)

    def _take(self, name: str, value: Any, function: str, line: int, depth: int) -> None:
        if issubclass(type(value), dict) and depth < _DEEPEST and dict.__len__(value) <= _LONGEST:
            for key, item in list(dict.items(value)):
                if isinstance(key, (str, int, float)):
                    self._take(f"{name}[{key!r}]", item, function, line, depth + 1)
        wells, labware = self._wells_in(value, depth), self._labware_in(value, depth)
        if wells or labware:
            binding = NameBinding(name, wells, function, line, labware)
            self._bindings.setdefault((function, name, wells, labware), binding)

    def _wells_in(self, value: Any, depth: int) -> tuple[WellRef, ...]:
        if issubclass(type(value), self._well_type):
            core = value._core
            info = self._wells.info_of(core)
            return () if info.is_tip_rack else (self._wells.ref(info.key, str(core.get_name())),)
        items = _items(value, (list, tuple, set, frozenset)) if depth < _DEEPEST else ()
        return tuple(ref for item in items for ref in self._wells_in(item, depth + 1))

    def _labware_in(self, value: Any, depth: int) -> tuple[str, ...]:
        if issubclass(type(value), self._labware_type):
            return (self._wells.register(value._core).key,)
        items = _items(value, (list, tuple)) if depth < _DEEPEST else ()
        return tuple(key for item in items for key in self._labware_in(item, depth + 1))

    @contextmanager
    def watching(self, namespace: Mapping[str, Any] | None = None) -> Iterator[None]:
        """Watch the returns of the protocol's functions in this thread.

        Args:
            namespace: The protocol's globals. If ``run`` is its only function, its frame is kept
                until the end instead: the hook costs a fifth of a simulation's time or more.
        """
        if sys.getprofile() is not None:  # a profiler or debugger is at work: leave it in peace
            yield
            return
        only = self._only_function(namespace) if namespace is not None else None
        kept: list[FrameType] = []

        def hook(frame: FrameType, event: str, _argument: Any) -> None:
            code = frame.f_code
            if code is only and event == "call":
                kept.append(frame)
                sys.setprofile(None)
            elif event == "return" and code.co_filename == self._file_name:
                self.look(frame.f_locals, code.co_name, code.co_firstlineno)

        hook.sees_names_only = True  # type: ignore[attr-defined]
        sys.setprofile(hook)
        try:
            yield
        finally:
            if not kept or sys.getprofile() is hook:
                sys.setprofile(None)
            for frame in kept:
                self.look(frame.f_locals, frame.f_code.co_name, frame.f_code.co_firstlineno)

    def _only_function(self, namespace: Mapping[str, Any]) -> CodeType | None:
        """The code of ``run``, if no other function or class of the protocol can be found.

        Comprehensions and lambdas do not count: they bind no names that tell of a well's use.
        """
        run = getattr(inspect.unwrap(namespace.get("run")), "__code__", None)  # type: ignore[arg-type]
        module = namespace.get("__name__", "builtins")
        if not isinstance(run, CodeType) or run.co_filename != self._file_name or _defines(run):
            return None
        for value in list(namespace.values()):
            if isinstance(value, type) and value.__module__ == module:
                return None
            code = getattr(value, "__code__", None)
            if (
                isinstance(code, CodeType)
                and code is not run
                and code.co_filename == self._file_name
                and not code.co_name.startswith("<")
            ):
                return None
        return run


def _defines(code: CodeType) -> bool:
    """Whether functions or classes are defined within a function."""
    return any(
        isinstance(inner, CodeType) and (not inner.co_name.startswith("<") or _defines(inner))
        for inner in code.co_consts
    )


def _items(value: Any, kinds: tuple[type, ...]) -> tuple[Any, ...]:
    """What a container holds, past whatever a subclass of the protocol makes of iteration."""
    for kind in kinds:
        if issubclass(type(value), kind):
            return tuple(kind.__iter__(value)) if kind.__len__(value) <= _LONGEST else ()  # type: ignore[attr-defined]
    return ()


def pause_watching() -> Any:
    """Take the hook of :meth:`NameCollector.watching` off; give what this returns to ``resume``.

    The hook is told of every call in Opentrons, hundreds for each command, most of them below
    the cores, where none of the protocol's own functions runs. A profile function that is not
    ours stays.
    """
    hook = sys.getprofile() if _CHEAP_TO_TURN_OFF else None
    if getattr(hook, "sees_names_only", False):
        sys.setprofile(None)
        return hook
    return None


def resume_watching(hook: Any) -> None:
    """Put the hook back."""
    if hook is not None:
        sys.setprofile(hook)
