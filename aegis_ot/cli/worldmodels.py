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
    scorer: Annotated[str, typer.Option(help="pca, column, pair or ensemble.")] = "ensemble",
    boxes: Annotated[
        str, typer.Option(help="detector (the shipped one), true (boxes.csv), or an .onnx file.")
    ] = "detector",
    start: Annotated[
        str, typer.Option(help="shipped: keep the shipped model, and fit the lab's limits alone.")
    ] = "",
    false_stops_per_plate: Annotated[
        float | None,
        typer.Option(min=0.0, help="Normal wells of 96 that the lab's limits may flag; 1."),
    ] = None,
    smallest_leftover: Annotated[
        float | None,
        typer.Option(min=1, max=100, help="Instead: % left in the tip to catch 9 times in 10."),
    ] = None,
) -> None:
    """Build the world model of a lab from its recorded runs.

    Of a data set the wells labelled normal are learned, and the failures of a qualification teach
    the lab's own limits; of a sidecar's store those that passed, as things stand after the
    operator's decisions. Use it with: aegis-ot sidecar --world-model.

    Exit codes: 0 written, 2 nothing could be learned, or the file cannot be written.
    """
    from ..sidecar.store.opening import is_store
    from ..worldmodel.fitting import STORED, fit_model
    from ..worldmodel.limits import FALSE_STOPS, LimitGoal
    from .progress import StageBar

    one_of("--scorer", scorer, STORED)
    if out.is_dir():
        raise ConfigurationError(f"{out} is a folder; name the model file to write.")
    if smallest_leftover is not None and false_stops_per_plate is not None:
        raise ConfigurationError(
            "Choose one: --false-stops-per-plate says what may be flagged, --smallest-leftover "
            "what must be caught; each follows from the other."
        )
    wanted = LimitGoal(
        FALSE_STOPS if false_stops_per_plate is None else false_stops_per_plate,
        None if smallest_leftover is None else smallest_leftover / 100,
    )
    found = [folder if is_store(folder) else open_dataset(folder) for folder in recordings]
    begun = time.monotonic()
    with StageBar() as shown:
        model = fit_model(found, out, scorer, tip_finder(boxes), shown, start=start, wanted=wanted)
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
    from ..worldmodel.reach import limits_in, recordings_of, shortcomings, smallest_in

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
    lines += [f"  {said}" for said in limits_in(model)]
    return "\n".join(lines)
