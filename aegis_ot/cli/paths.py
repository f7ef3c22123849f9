"""Files and folders that commands read and write, told of in one way."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import ConfigurationError, DatasetError

if TYPE_CHECKING:
    from ..vision.dataset import Dataset


def write_text(path: Path, text: str, newline: str | None = None) -> None:
    """Write a file, making its folder; ``newline`` as :func:`open` takes it.

    Raises:
        ConfigurationError: It cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8", errors="backslashreplace", newline=newline)
    except OSError as error:
        raise ConfigurationError(f"{path} cannot be written: {error.strerror}.") from None


def empty_folder(folder: Path) -> None:
    """Make sure that a folder is new or empty.

    Raises:
        ConfigurationError: It holds something, or is none.
    """
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise ConfigurationError(f"{folder} is not empty; name a new folder.")


def tip_finder(boxes: str) -> str:
    """What ``--boxes`` names, as the evaluation room says it."""
    return "default" if boxes == "detector" else boxes


def open_dataset(folder: Path) -> Dataset:
    """Load a data set.

    Raises:
        DatasetError: It is faulty, or the folder only holds data sets in folders of its own.
    """
    from aegis_ot.vision.dataset import load_dataset

    if folder.is_dir() and not (folder / "manifest.csv").exists():
        inside = sorted(path.parent.name for path in folder.glob("*/manifest.csv"))
        if inside:
            raise DatasetError(
                f"{folder} is no data set, but holds some: {', '.join(inside[:10])}. "
                f"Name one of them, as {folder / inside[0]}."
            )
    return load_dataset(folder)
