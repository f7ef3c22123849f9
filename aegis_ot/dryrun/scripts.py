"""Reads a protocol file, and what it needs, from disk."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..errors import ConfigurationError
from ..preflight.script import Script


def read_script(path: Path, labware: Sequence[Path] = (), parameters: Sequence[str] = ()) -> Script:
    """Read a Python protocol.

    Args:
        path: The protocol file.
        labware: Folders (or files) with custom labware definitions.
        parameters: Runtime parameters as ``NAME=VALUE``; a value is read as JSON where it is
            JSON (``4``, ``true``, ``2.5``), else as text.

    Raises:
        ConfigurationError: A file cannot be read, or a parameter has no ``=``.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigurationError(f"Cannot read the protocol {path}: {error}") from error
    return Script(
        text=text,
        file_name=path.name,
        parameters=dict(_parameter(item) for item in parameters),
        extra_labware=_definitions(labware),
    )


def _parameter(item: str) -> tuple[str, Any]:
    name, equals, value = item.partition("=")
    if not equals or not name:
        raise ConfigurationError(f"Runtime parameter {item!r}: write it as NAME=VALUE.")
    try:
        return name, json.loads(value)
    except ValueError:
        return name, value


def _definitions(places: Sequence[Path]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for place in places:
        files = sorted(place.rglob("*.json")) if place.is_dir() else [place]
        if not files:
            raise ConfigurationError(f"No labware definition (*.json) in {place}.")
        for file in files:
            try:
                definition = json.loads(file.read_text(encoding="utf-8"))
                uri = "{}/{}/{}".format(
                    definition["namespace"],
                    definition["parameters"]["loadName"],
                    definition["version"],
                )
            except (OSError, UnicodeDecodeError, ValueError, KeyError, TypeError) as error:
                raise ConfigurationError(
                    f"{file} is no Opentrons labware definition: {type(error).__name__}: {error}"
                ) from error
            found[uri] = definition
    return found
