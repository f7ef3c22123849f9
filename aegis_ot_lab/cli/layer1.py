"""``aegis-ot evaluate layer1``: Layer 1 on labelled protocols."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated

import typer

from aegis_ot.cli.counting import Counting
from aegis_ot.cli.exit_codes import BROKEN, CLEAN
from aegis_ot.cli.models import RecordFolder, backend_of
from aegis_ot.cli.options import Labware, Rules, one_of
from aegis_ot.cli.paths import write_text
from aegis_ot.errors import ConfigurationError
from aegis_ot.llm import load_prices
from aegis_ot.preflight import load_rules
from aegis_ot.workbench import Asking, CheckSettings
from aegis_ot.workbench.files import read_labware
from aegis_ot.workbench.given import split

from ..configurations import AskingConfiguration, asking_in
from ..evaluation.layer1 import (
    Checking,
    Layer1Result,
    draw_ablation,
    evaluate_layer1,
    read_labels,
)
from .options import ModelNames, writable_folder

LAYER1_CONFIGS = tuple(configuration.value for configuration in AskingConfiguration)
"""Judges of protocols that this command can score."""


def layer1(
    folder: Annotated[Path, typer.Argument(help="Protocols beside a labels.json.")],
    json_out: Annotated[
        Path | None, typer.Option("--json", help="Write all figures here as JSON.")
    ] = None,
    figures: Annotated[
        Path | None, typer.Option(help="Draw the ablation bar charts into this folder.")
    ] = None,
    config: Annotated[
        list[str] | None,
        typer.Option(
            help=f"Who judges: {', '.join(LAYER1_CONFIGS)}. Repeatable, or a comma list "
            "(rules-only if left out)."
        ),
    ] = None,
    model: ModelNames = None,
    record: RecordFolder = None,
    prices: Annotated[
        Path | None, typer.Option(help="Price table of your own (AEGIS_OT_PRICES if left out).")
    ] = None,
    rules: Rules = None,
    labware: Labware = None,
    seed: Annotated[int, typer.Option(min=0, help="Of the bootstrap.")] = 0,
    timeout: Annotated[float, typer.Option(help="Longest rehearsal of one protocol, s.")] = 120.0,
) -> None:
    """Score Layer 1 on a folder in the protocol benchmark format.

    Exit codes: 0 scored, 2 a protocol could not be judged, a model that was asked gave no
    answer, or the folder is no good.
    """
    askings = list(_askings(split("--config", config) or ["rules-only"], model or [], record))
    table = load_prices(prices)
    rule_set = load_rules(tuple(str(path) for path in rules or ()))
    labels = read_labels(
        folder,
        [family.family for family in rule_set.assays],
        [rule.id for rule in rule_set.rules],
    )
    if figures is not None:
        writable_folder(figures)
    results: list[Layer1Result] = []
    for name, asking in askings:
        settings = CheckSettings(
            rules=tuple(str(path.resolve()) for path in rules or ()),
            labware=read_labware(labware or ()),
            timeout_s=timeout,
            asking=asking,
        )
        with Counting(len(labels)) as counting:
            result = evaluate_layer1(
                folder.resolve(),
                labels,
                Checking(settings, rule_set),
                name,
                seed=seed,
                prices=table,
                model=asking.backend.name if asking else "",
                done=counting.done,
            )
        typer.echo(result.text(), nl=False)
        results.append(result)
    if json_out is not None:
        values = [result.to_json() for result in results]
        shown = values[0] if len(values) == 1 else {"results": values}
        write_text(json_out, json.dumps(shown, indent=1, ensure_ascii=False) + "\n")
    if figures is not None:
        try:
            drawn = draw_ablation(results, figures)
        except OSError as error:
            raise ConfigurationError(f"A figure cannot be written: {error}.") from None
        for path in drawn:
            typer.echo(f"figure: {path}", err=True)
    broken = any(result.unjudged or result.unanswered for result in results)
    raise typer.Exit(BROKEN if broken else CLEAN)


def _askings(
    configs: Sequence[str], models: Sequence[str], record: Path | None
) -> Iterator[tuple[str, Asking | None]]:
    """One for each configuration, by its name, and model; ``None`` stands for the rules alone."""
    for name in dict.fromkeys(configs):
        one_of("--config", name, LAYER1_CONFIGS)
        if name == AskingConfiguration.RULES_ONLY.value:
            yield name, None
            continue
        chosen: Sequence[str | None] = models or (None,)
        for model in chosen:
            backend = backend_of(model, record)
            if backend is None:
                raise ConfigurationError(
                    f"--config {name} asks a model. Name one with --model or in AEGIS_OT_MODEL."
                )
            yield name, asking_in(name, backend)
