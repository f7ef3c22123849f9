"""The text of a protocol, and how a running protocol finds its own."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
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


def find_script(file_name: str, protocol: Any) -> Script | None:
    """The script that is running right now, or ``None`` where its text cannot be had.

    Opentrons compiles a protocol from text, without a file that Python could read back; but the
    loader's own frame is still on the stack and holds the text. Where it is not (a notebook, a
    plain Python program) the file is read.

    Args:
        file_name: ``co_filename`` of the protocol's code.
        protocol: The live ``ProtocolContext``; its custom labware is taken along.
    """
    loaded = _loaded_protocol(sys._getframe(1))
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


def _loaded_protocol(frame: FrameType | None) -> Any:
    """The ``PythonProtocol`` that Opentrons' loader holds on this stack."""
    while frame is not None:
        if frame.f_code.co_name == "exec_run":
            candidate = frame.f_locals.get("proto")
            if hasattr(candidate, "text") and hasattr(candidate, "contents"):
                return candidate
        frame = frame.f_back
    return None


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
