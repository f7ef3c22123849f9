"""``aegis-ot llm``: requests to a model out as a file, answers in, for batches and by hand."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Annotated

import typer

from aegis_ot.cli.exit_codes import BROKEN
from aegis_ot.cli.options import (
    Assay,
    CsvParameters,
    Ignore,
    Labware,
    Parameters,
    Rules,
    Select,
    Timeout,
    one_of,
    refuse_to_overwrite,
)
from aegis_ot.llm import ScriptedBackend
from aegis_ot.vocabulary import counted
from aegis_ot.workbench import Asking, check_files, configurations_of
from aegis_ot.workbench.call_settings import settings_of
from aegis_ot.workbench.given import split

from ..batch import export_requests, import_answers
from ..configurations import AskingConfiguration, request_in
from .options import Files

ASKING = tuple(c.value for c in AskingConfiguration if c is not AskingConfiguration.RULES_ONLY)
"""Configurations that ask a model."""

app = typer.Typer()
llm = typer.Typer(
    help="Export requests to a model, and import answers got elsewhere.", no_args_is_help=True
)
app.add_typer(llm, name="llm")


@llm.command("export")
def export(
    files: Files,
    out: Annotated[Path, typer.Option(help="File of requests, one JSON object a line.")],
    config: Annotated[
        list[str] | None,
        typer.Option(
            help=f"{', '.join(ASKING)}; repeatable, or a comma list (hybrid if left out)."
        ),
    ] = None,
    assay: Assay = None,
    rules: Rules = None,
    select: Select = None,
    ignore: Ignore = None,
    parameter: Parameters = None,
    csv: CsvParameters = None,
    labware: Labware = None,
    timeout: Timeout = None,
) -> None:
    """Write the requests that a check with a model would make.

    Exit codes: 0 all are written, 2 a protocol could not be rehearsed.
    """
    refuse_to_overwrite("--out", out, files)
    configs = [one_of("--config", name, ASKING) for name in split("--config", config) or ["hybrid"]]
    requests, failed = [], False
    for configured, own in configurations_of(list(dict.fromkeys(files)), Path.cwd()):
        judging, rule_set = settings_of(
            configured,
            assay=assay,
            rules=rules,
            select=select,
            ignore=ignore,
            parameter=parameter,
            csv=csv,
            labware=labware,
            timeout=timeout,
        )
        # Nobody answers: the check is made for what a model would get to know.
        settings = dataclasses.replace(judging, asking=Asking(ScriptedBackend([])))
        for checked in check_files(own, settings, rule_set).protocols:
            if checked.problem is not None:
                failed = True
                typer.echo(f"{checked.file}: {checked.problem.message}", err=True)
            if checked.dossier is None:
                continue
            asked = (request_in(name, checked.dossier, rule_set) for name in configs)
            requests += [(checked.file, request) for request in asked if request is not None]
    count = export_requests(requests, out)
    typer.echo(f"{out}: {count} requests.")
    if failed:
        raise typer.Exit(BROKEN)


@llm.command("import")
def import_(
    answers: Annotated[Path, typer.Argument(help="File of answers, one JSON object a line.")],
    out: Annotated[Path, typer.Option(help="Replay folder, for --model replay:FOLDER.")],
    requests: Annotated[
        Path | None, typer.Option(help="The exported requests: answers are checked against them.")
    ] = None,
) -> None:
    """Turn answers got elsewhere into a replay folder.

    Exit codes: 0 all are kept, 2 some cannot be used.
    """
    done = import_answers(answers, out, requests)
    for problem in done.problems:
        typer.echo(problem, err=True)
    typer.echo(f"{out}: {counted(done.kept, 'answer')} kept; use them with --model replay:{out}")
    if done.problems or not done.kept:
        raise typer.Exit(BROKEN)
