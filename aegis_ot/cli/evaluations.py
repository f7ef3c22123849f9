"""``aegis-ot evaluate``: scores on labelled data."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated

import typer

from ..checking import CheckSettings
from ..checking.files import read_labware
from ..evaluation.layer1 import Prediction, RulesOnly, evaluate_layer1, read_labels
from ..preflight import load_database
from .app import BROKEN, CLEAN, app
from .checks import one_of, write_text

evaluate = typer.Typer(no_args_is_help=True, help="Score a layer on labelled data.")
app.add_typer(evaluate, name="evaluate")

LAYER1_CONFIGS = ("rules-only",)
"""Judges of protocols that this command can score."""


@evaluate.callback()
def _evaluate() -> None:
    """Keeps the layer's name in the command, also while there is one only."""


@evaluate.command()
def layer1(
    folder: Annotated[Path, typer.Argument(help="Protocols beside a labels.json.")],
    json_out: Annotated[
        Path | None, typer.Option("--json", help="Write all figures here as JSON.")
    ] = None,
    config: Annotated[
        str, typer.Option(help=f"Who judges: {', '.join(LAYER1_CONFIGS)}.")
    ] = "rules-only",
    rules: Annotated[
        list[Path] | None, typer.Option(help="File or folder of further rules.")
    ] = None,
    labware: Annotated[
        list[Path] | None, typer.Option(help="Folder or file with custom labware definitions.")
    ] = None,
    seed: Annotated[int, typer.Option(help="Of the bootstrap.")] = 0,
    timeout: Annotated[float, typer.Option(help="Longest rehearsal of one protocol, s.")] = 120.0,
) -> None:
    """Score Layer 1 on a folder in the protocol benchmark format.

    Exit codes: 0 scored, 2 a protocol could not be judged, or the folder is no good.
    """
    one_of("--config", config, LAYER1_CONFIGS)
    database = load_database(tuple(str(path) for path in rules or ()))
    labels = read_labels(
        folder,
        [family.family for family in database.families],
        [rule.id for rule in database.rules],
    )
    settings = CheckSettings(
        rules=tuple(str(path.resolve()) for path in rules or ()),
        labware=read_labware(labware or ()),
        timeout_s=timeout,
    )
    progress = _Progress(len(labels))
    result = evaluate_layer1(
        folder.resolve(),
        labels,
        RulesOnly(settings, database),
        config,
        seed=seed,
        done=progress.done,
    )
    progress.end()
    typer.echo(result.text(), nl=False)
    if json_out is not None:
        write_text(json_out, json.dumps(result.to_json(), indent=1, ensure_ascii=False) + "\n")
    raise typer.Exit(BROKEN if result.unjudged else CLEAN)


class _Progress:
    """How far it is, on a terminal only."""

    def __init__(self, total: int) -> None:
        self._total = total
        self._count = 0
        self._shown = sys.stderr.isatty()

    def done(self, prediction: Prediction) -> None:
        self._count += 1
        if self._shown:
            print(
                f"\r{self._count}/{self._total} {prediction.file:40}",
                end="",
                file=sys.stderr,
                flush=True,
            )

    def end(self) -> None:
        if self._shown:
            print("\r" + " " * 60 + "\r", end="", file=sys.stderr, flush=True)
