"""Reads a protocol file, and what it needs, from disk."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..adapters.opentrons.rehearsal import Script
from ..errors import ConfigurationError, RehearsalError
from ..workbench.files import read_labware, read_protocol, read_values


def read_script(path: Path, labware: Sequence[Path] = (), parameters: Sequence[str] = ()) -> Script:
    """Read a Python protocol.

    Args:
        path: The protocol file.
        labware: Folders (or files) with custom labware definitions.
        parameters: Runtime parameters as ``NAME=VALUE``.

    Raises:
        ConfigurationError: A file cannot be read, or a parameter is not written so.
    """
    try:
        text = read_protocol(path)
    except (ConfigurationError, RehearsalError) as error:
        raise ConfigurationError(f"{path}: {error}") from None
    return Script(
        text=text,
        file_name=path.name,
        parameters=read_values(parameters),
        extra_labware=read_labware(labware),
    )
