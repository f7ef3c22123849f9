"""``aegis-ot dataset``: make trajectory data sets."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import ConfigurationError, DatasetError
from ..vocabulary import counted
from .app import app

if TYPE_CHECKING:
    from ..vision.dataset import Dataset

dataset = typer.Typer(help="Make trajectory data sets.", no_args_is_help=True)
app.add_typer(dataset, name="dataset")


@dataset.command()
def simulate(
    out: Annotated[Path, typer.Argument(help="New or empty folder.")],
    pipette: Annotated[str, typer.Option(help="p20, p300, p1000, or a name of Opentrons'.")] = (
        "p1000"
    ),
    plates: Annotated[int, typer.Option(min=1, max=1000, help="Each a camera pose of its own.")] = (
        16
    ),
    seed: Annotated[int, typer.Option(min=0, help="Fixes everything.")] = 0,
    size: Annotated[str, typer.Option(help="Frame size, px.")] = "640x480",
) -> None:
    """Draw a data set with the simulated camera, in the shape of the paper's.

    Sixteen plates hold 26 normal wells, 36 failures and two without a tip. Its meta.json says
    that the frames are synthetic.
    """
    from ..simulation import write_dataset
    from ..vision.dataset import load_dataset
    from ..vision.tips import pipette_class

    if not re.fullmatch(r"p[1-9]\d*", pipette_class(pipette)):
        raise ConfigurationError(
            f"--pipette: {pipette!r} is no pipette; write p20, p300, p1000 or Opentrons' name."
        )
    empty_folder(out)
    write_dataset(out, plates, seed, pipette, size=_size(size))
    made = load_dataset(out)
    failures = sum(record.label == "failure" for record in made.records)
    shown = counted(len(made.records), "trajectory", "trajectories")
    typer.echo(
        f"{out}: {shown} on {counted(len(made.plates), 'plate')}, {failures} of them failures; "
        "synthetic frames."
    )


def empty_folder(folder: Path) -> None:
    """Make sure that a folder is new or empty.

    Raises:
        ConfigurationError: It holds something, or is none.
    """
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise ConfigurationError(f"{folder} is not empty; name a new folder.")


def writable_folder(folder: Path) -> None:
    """Make a folder: fail before the work and not after it.

    Raises:
        ConfigurationError: It cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ConfigurationError(f"{folder} cannot be made: {error.strerror}.") from None


def tip_finder(boxes: str) -> str:
    """What ``--boxes`` names, as the evaluation room says it."""
    return "default" if boxes == "detector" else boxes


def open_dataset(folder: Path) -> Dataset:
    """Load a data set.

    Raises:
        DatasetError: It is faulty, or the folder only holds data sets in folders of its own.
    """
    from ..vision.dataset import load_dataset

    if folder.is_dir() and not (folder / "manifest.csv").exists():
        inside = sorted(path.parent.name for path in folder.glob("*/manifest.csv"))
        if inside:
            raise DatasetError(
                f"{folder} is no data set, but holds some: {', '.join(inside[:10])}. "
                f"Name one of them, as {folder / inside[0]}."
            )
    return load_dataset(folder)


def _size(text: str) -> tuple[int, int]:
    parts = text.lower().split("x")
    try:
        width, height = (int(part) for part in parts)
    except ValueError:
        raise ConfigurationError(
            f"--size: {text!r} is no size; write it as 640x480 (width, height)."
        ) from None
    if not (160 <= width <= 4096 and 120 <= height <= 4096):
        raise ConfigurationError(f"--size: {text} is out of range (160x120 to 4096x4096).")
    return width, height
