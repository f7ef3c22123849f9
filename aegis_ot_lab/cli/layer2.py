"""``aegis-ot evaluate layer2``: scorers on a labelled set of trajectories."""

from __future__ import annotations

import json
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from aegis_ot.cli.exit_codes import BROKEN, CLEAN
from aegis_ot.cli.models import ModelName, RecordFolder, backend_of
from aegis_ot.cli.options import one_of
from aegis_ot.cli.paths import open_dataset, tip_finder, write_text
from aegis_ot.errors import ConfigurationError
from aegis_ot.vocabulary import counted
from aegis_ot.workbench.given import split

from .options import writable_folder

if TYPE_CHECKING:
    from aegis_ot.llm import Backend

    from ..evaluation.layer2 import Layer2Result

_SCORERS = (
    "pca, isolation-forest, one-class-svm, autoencoder, single-frame-pca, mahalanobis (the "
    "paper's), column, pair, ensemble"
)


def layer2(
    dataset: Annotated[Path, typer.Argument(help="Folder of a trajectory data set.")],
    scorer: Annotated[
        list[str] | None,
        typer.Option(help=f"{_SCORERS}. Repeatable, or a comma list. Default: ensemble."),
    ] = None,
    protocol: Annotated[
        str,
        typer.Option(
            help="lopo: a threshold per held-out plate. cascade: calibration, triage and the "
            "volumetric gate, as in a live run."
        ),
    ] = "lopo",
    boxes: Annotated[
        str,
        typer.Option(
            help="detector (the shipped one), registered (it, and positions.csv), "
            "true (boxes.csv), or an .onnx file. Default: as in a live run, registered where the "
            "set has positions.csv, else detector."
        ),
    ] = "",
    threshold: Annotated[
        str,
        typer.Option(
            help="first-normal (the paper's), p-value or pooled. Default: first-normal for the "
            "paper's scorers, p-value for the ensemble, pooled for the others."
        ),
    ] = "",
    leave_out: Annotated[
        str,
        typer.Option(
            help="plate, or camera: no plate of the same kind of camera is learned from (meta.json "
            "names the kinds)."
        ),
    ] = "plate",
    json_out: Annotated[
        Path | None, typer.Option("--json", help="Write all figures here as JSON.")
    ] = None,
    figures: Annotated[
        Path | None, typer.Option(help="Draw figures into this folder, as PNG.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of the bootstrap.")] = 0,
    model: ModelName = None,
    record: RecordFolder = None,
) -> None:
    """Score Layer 2 on a trajectory data set, leaving one plate out at a time.

    Each plate is scored by a model fitted on the normal wells of all other plates. The plate's
    own first normal well sets the threshold, and is not scored. With several scorers the five
    figures at the top of the JSON are those of the first. A model is asked, in the cascade, about
    the flagged wells that the volumetric gate does not fail, and about a share of the others.

    Exit codes: 0 scored, 2 the data set or a setting is no good, or a model that was asked gave no
    answer (export:FILE, which gives none, is no fault).
    """
    from aegis_ot.cli.progress import StageBar
    from aegis_ot_lab.found_tips import find_tips

    from ..evaluation.layer2 import LEAVE_OUT, PROTOCOLS, THRESHOLDS, evaluate_layer2
    from ..scorers import SCORERS

    names = [name.replace("-", "_") for name in split("--scorer", scorer) or ("ensemble",)]
    for name in names:
        one_of("--scorer", name.replace("_", "-"), [known.replace("_", "-") for known in SCORERS])
    one_of("--protocol", protocol, PROTOCOLS)
    one_of("--threshold", threshold, ("", *THRESHOLDS))
    one_of("--leave-out", leave_out, LEAVE_OUT)
    backend = _model_of(protocol, model, record)
    gates = []
    if backend is not None:
        from aegis_ot.llm.vlm import VlmGate

        gates = [VlmGate(backend)]
    if figures is not None:
        writable_folder(figures)
    data = open_dataset(dataset)
    results, seconds = [], []
    with StageBar() as shown:
        boxes = boxes or ("registered" if data.positions else "detector")
        tips = find_tips(data, tip_finder(boxes), shown)
        for name in dict.fromkeys(names):
            begun = time.monotonic()
            result = evaluate_layer2(
                data, name, protocol,
                threshold=threshold, leave_out=leave_out, seed=seed, tips=tips, gates=gates,
                progress=shown,
            )  # fmt: skip
            results.append(result)
            seconds.append(time.monotonic() - begun)
        if figures is not None:
            from ..evaluation.layer2.figures import draw_figures

            drawn = draw_figures(results, figures, tips.samples, progress=shown)
    for warning in data.warnings:
        typer.echo(f"{data.root}: {warning}", err=True)
    for result, took in zip(results, seconds, strict=True):
        typer.echo(f"{result.text()}\n  {'took':18} {took:.1f} s\n")
    if json_out is not None:
        account: dict[str, Any] = results[0].to_json() | {"seconds": round(seconds[0], 2)}
        if len(results) > 1:
            account["scorers"] = {
                result.scorer: result.to_json() | {"seconds": round(took, 2)}
                for result, took in zip(results, seconds, strict=True)
            }
        write_text(json_out, json.dumps(account, indent=1, ensure_ascii=False) + "\n")
        typer.echo(f"Figures as JSON: {json_out}", err=True)
    if figures is not None:
        typer.echo(f"{len(drawn)} figures in {figures}", err=True)
    raise typer.Exit(_answered(backend, results))


def _model_of(protocol: str, model: str | None, record: Path | None) -> Backend | None:
    """The model that the cascade asks, if the command line or the environment names one.

    Raises:
        ConfigurationError: One is named where none is asked.
    """
    if protocol == "cascade":
        return backend_of(model, record)
    if model is not None or record is not None:
        raise ConfigurationError("A model is a gate of the cascade: add --protocol cascade.")
    return None


def _answered(backend: Backend | None, results: Sequence[Layer2Result]) -> int:
    """The exit code, by how the model answered; says where its questions were written to instead.

    Raises:
        ConfigurationError: They could not be written.
    """
    if all(result.model is None or not result.model.trouble for result in results):
        return CLEAN
    kind, _, file = ("" if backend is None else backend.name).partition(":")
    if kind != "export":
        return BROKEN
    from aegis_ot.llm.backends.exporting import read_requests

    written = counted(len(read_requests(Path(file))), "question")
    typer.echo(f"{written} in {file}; the figures above are without a model.")
    return CLEAN
