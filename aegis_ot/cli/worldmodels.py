"""``aegis-ot fit`` and ``aegis-ot world-model``: the world model of a lab as a file."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import ConfigurationError
from .options import one_of
from .paths import open_dataset, tip_finder

if TYPE_CHECKING:
    from ..vision.models import ModelFile


app = typer.Typer()


@app.command()
def fit(
    recordings: Annotated[
        list[Path],
        typer.Argument(help="Folders: trajectory data sets, or the data folder of a sidecar."),
    ],
    out: Annotated[Path, typer.Option("--out", "-o", help="The model file to write.")],
    scorer: Annotated[str, typer.Option(help="pca, column, patches or ensemble.")] = "ensemble",
    boxes: Annotated[
        str, typer.Option(help="detector (the shipped one), true (boxes.csv), or an .onnx file.")
    ] = "detector",
) -> None:
    """Build the world model of a lab from its recorded normal runs.

    Of a data set the wells labelled normal are learned; of a sidecar's store those that passed,
    as things stand after the operator's decisions. Use it with: aegis-ot sidecar --world-model.

    Exit codes: 0 written, 2 nothing could be learned, or the file cannot be written.
    """
    from ..sidecar.opening import is_store
    from ..worldmodel.fitting import STORED, fit_model
    from .progress import Shown

    one_of("--scorer", scorer, STORED)
    if out.is_dir():
        raise ConfigurationError(f"{out} is a folder; name the model file to write.")
    found = [folder if is_store(folder) else open_dataset(folder) for folder in recordings]
    begun = time.monotonic()
    with Shown() as shown:
        model = fit_model(found, out, scorer, tip_finder(boxes), shown)
    typer.echo(_describe(out, model))
    typer.echo(f"Written in {time.monotonic() - begun:.1f} s.", err=True)


@app.command("world-model")
def show_model(
    file: Annotated[Path, typer.Argument(help="A file that aegis-ot fit wrote.")],
) -> None:
    """Verify a world model, and say what it was made from.

    Exit codes: 0 it can be used, 2 it is missing, damaged or of another version.
    """
    from ..sidecar.analysers import load_scorer
    from ..vision.models import load_model

    load_scorer(file)
    typer.echo(_describe(file, load_model(file)))


def _describe(path: Path, model: ModelFile) -> str:
    from ..vision.reach import recordings_of, shortcomings, smallest_in

    lines = [
        f"{path}: {model.kind}, {path.stat().st_size / 1e6:.2f} MB, made by aegis_ot "
        f"{model.package}, sha256 {model.checksum[:16]}..."
    ]
    for used in recordings_of(model):
        left_out = f", {used['left_out']} without a tip left out" if used.get("left_out") else ""
        lines.append(
            f"  {used.get('name')} ({used.get('source')}): {used.get('normals')} normal wells"
            f"{left_out}"
        )
    lines += [f"  {said}" for said in (*shortcomings(model), *map(str, smallest_in(model)))]
    return "\n".join(lines)
