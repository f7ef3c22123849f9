"""``aegis-ot dataset``: make trajectory data sets."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from aegis_ot.cli.paths import empty_folder
from aegis_ot.errors import ConfigurationError
from aegis_ot.vocabulary import counted

if TYPE_CHECKING:
    pass

app = typer.Typer()
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
    from aegis_ot.vision.dataset import load_dataset
    from aegis_ot.vision.tips import pipette_class

    from ..drawing import write_dataset

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
