"""A sidecar's store opened by whoever reads it afterwards."""

from __future__ import annotations

from pathlib import Path

from ...errors import ConfigurationError
from . import DATABASE, Store


def is_store(folder: Path) -> bool:
    """Whether a folder holds a sidecar's store."""
    return (folder / DATABASE).is_file()


def open_store(folder: Path, alone: bool = False) -> Store:
    """Open an existing store, ``alone`` for who writes to it.

    Raises:
        ConfigurationError: The folder holds none. One is never made.
        StoreError: It cannot be read.
    """
    if not is_store(folder):
        raise ConfigurationError(
            f"{folder} holds no {DATABASE}: name the data folder of a sidecar (its setting 'data')."
        )
    return Store(folder, alone)
