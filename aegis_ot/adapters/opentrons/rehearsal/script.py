"""The text of a protocol, and how a running protocol finds its own."""

from __future__ import annotations

import functools
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import CodeType, FrameType
from typing import Any


@dataclass(frozen=True)
class Script:
    """A protocol as Opentrons loads it: its text, and what it may need.

    Attributes:
        text: Python source.
        file_name: As Opentrons names it (bare, without folders).
        parameters: Values for runtime parameters, by variable name.
        csv_parameters: Paths for CSV runtime parameters, by variable name.
        extra_labware: Custom labware definitions, by URI.
        data_files: Data files, by name.
    """

    text: str
    file_name: str
    parameters: Mapping[str, Any] = field(default_factory=dict)
    csv_parameters: Mapping[str, Any] = field(default_factory=dict)
    extra_labware: Mapping[str, Any] = field(default_factory=dict)
    data_files: Mapping[str, bytes] = field(default_factory=dict)


_LOADERS = {"exec_run": ("proto", "new_globs"), "_perform": ("protocol", "namespace")}
"""Opentrons' loader and the rehearsal's own: their local names for the ``PythonProtocol`` that
they execute, and for its globals."""

_WRAPPERS = 32
"""So many decorators and ``partial`` are looked through; one may wrap itself."""


def find_home(run: Any) -> tuple[str, Mapping[str, Any]]:
    """Where the protocol that is running right now is written.

    A ``run`` that went through a decorator, a ``partial`` or an object of the protocol's own does
    not always lead back to its text; Opentrons' loader knows it.

    Args:
        run: What was guarded, or the frame that asked for it: for where no loader is on the stack.

    Returns:
        ``co_filename`` of the protocol's code, and its globals.
    """
    loaded, namespace = _loaded(sys._getframe(1))
    if loaded is not None and isinstance(loaded.contents, CodeType) and isinstance(namespace, dict):
        return loaded.contents.co_filename, namespace
    if isinstance(run, FrameType):
        return run.f_code.co_filename, run.f_globals
    for _ in range(_WRAPPERS):
        partial = isinstance(run, functools.partial)
        inner = run.func if partial else getattr(run, "__wrapped__", None)
        if inner is None:
            break
        run = inner
    function = run if hasattr(run, "__code__") else type(run).__call__
    code = getattr(function, "__code__", None)
    return (code.co_filename, function.__globals__) if code else ("<protocol>", {})


def find_script(file_name: str, protocol: Any) -> Script | None:
    """The script that is running right now, or ``None`` where its text cannot be had.

    Opentrons compiles a protocol from text, without a file that Python could read back; but the
    loader's own frame is still on the stack and holds the text. Where it is not (a notebook, a
    plain Python program) the file is read.

    Args:
        file_name: ``co_filename`` of the protocol's code.
        protocol: The live ``ProtocolContext``; its custom labware is taken along.
    """
    loaded, _ = _loaded(sys._getframe(1))
    if loaded is not None:
        text = loaded.text
        return Script(
            text=text.decode("utf-8", "replace") if isinstance(text, bytes) else text,
            file_name=file_name,
            extra_labware={**(loaded.extra_labware or {}), **_custom_labware(protocol)},
            data_files=dict(loaded.bundled_data or {}),
        )
    try:
        text = Path(file_name).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError, ValueError):
        return None
    return Script(text=text, file_name=file_name, extra_labware=_custom_labware(protocol))


def _loaded(frame: FrameType | None) -> tuple[Any, Any]:
    """The ``PythonProtocol`` that a loader on this stack executes, and its globals."""
    while frame is not None:
        if frame.f_code.co_name in _LOADERS:
            protocol, namespace = _LOADERS[frame.f_code.co_name]
            loaded = frame.f_locals.get(protocol)
            if hasattr(loaded, "text") and hasattr(loaded, "contents"):
                return loaded, frame.f_locals.get(namespace)
        frame = frame.f_back
    return None, None


def _custom_labware(protocol: Any) -> dict[str, Any]:
    """Definitions that were given to the live run and that Opentrons does not ship."""
    client = getattr(protocol._core, "_engine_client", None)
    if client is None:
        return dict(getattr(protocol._core, "_extra_labware", None) or {})
    try:
        definitions = client.state.labware._state.definitions_by_uri
    except AttributeError:
        return {}
    return {uri: item for uri, item in definitions.items() if not uri.startswith("opentrons/")}
