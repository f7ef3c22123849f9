"""``aegis-ot train``: the project's own networks, from seeds."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from aegis_ot.cli.paths import open_dataset

from .options import writable_folder

app = typer.Typer()
train = typer.Typer(help="Train the tip detector.", no_args_is_help=True)
app.add_typer(train, name="train")


@train.callback()
def _train() -> None:
    """Keeps the network's name in the command, also while there is one only."""


@train.command()
def detector(
    datasets: Annotated[
        list[Path] | None,
        typer.Argument(help="Data sets with boxes.csv; none trains on drawn frames alone."),
    ] = None,
    out: Annotated[
        Path, typer.Option("--out", "-o", help="Folder for tip_detector.onnx and its .json.")
    ] = Path("detector"),
    seed: Annotated[int, typer.Option(min=0, help="Fixes the weights.")] = 0,
    hold_out: Annotated[
        list[str] | None,
        typer.Option(help="Plate that is left out and measured on. Repeatable."),
    ] = None,
    start: Annotated[
        str | None,
        typer.Option(
            metavar="FILE",
            help="Weights to train on from (.onnx), or 'shipped': to teach them a camera more, "
            "in a third of the time.",
        ),
    ] = None,
) -> None:
    """Train the tip detector; the same data sets, seed and versions give the same weights.

    Needs PyTorch: install the package with its extra 'train'. Use the result as
    cascade.detector of the sidecar, or with --boxes.

    Exit codes: 0 written, 2 PyTorch is missing, or a data set is no good.
    """
    from ..training import train_detector

    for folder in datasets or ():
        open_dataset(folder).true_boxes()
    writable_folder(out)
    path = train_detector(
        datasets or (),
        out / "tip_detector.onnx",
        seed,
        hold_out=hold_out or (),
        progress=lambda line: typer.echo(line, err=True),
        start=start,
    )
    typer.echo(f"{path}: {path.stat().st_size / 1e6:.2f} MB, seed {seed}.")
