"""``aegis-ot llm``: requests to a model out as a file, answers in, for batches and by hand."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..checking import Asking, CheckSettings, check_files
from ..checking.files import read_csv_paths, read_labware, read_values
from ..preflight import Options, load_database
from ..reasoning import ScriptedBackend, export_requests, import_answers, request_in
from .app import BROKEN, app
from .checks import one_of, split
from .models import ASKING

llm = typer.Typer(
    help="Export requests to a model, and import answers got elsewhere.", no_args_is_help=True
)
app.add_typer(llm, name="llm")


@llm.command("export")
def export(
    files: Annotated[list[Path], typer.Argument(help="Python protocols.")],
    out: Annotated[Path, typer.Option(help="File of requests, one JSON object a line.")],
    config: Annotated[
        list[str] | None,
        typer.Option(help=f"{', '.join(ASKING)}; repeatable, or a comma list [default: hybrid]."),
    ] = None,
    assay: Annotated[list[str] | None, typer.Option(help="Assay family, if known.")] = None,
    rules: Annotated[list[Path] | None, typer.Option(help="Further rules.")] = None,
    parameter: Annotated[
        list[str] | None, typer.Option(help="Runtime parameter as NAME=VALUE.")
    ] = None,
    csv: Annotated[
        list[str] | None, typer.Option(help="File of a CSV runtime parameter as NAME=PATH.")
    ] = None,
    labware: Annotated[
        list[Path] | None, typer.Option(help="Folder or file with custom labware definitions.")
    ] = None,
    timeout: Annotated[float, typer.Option(help="Longest rehearsal, s.")] = 120.0,
) -> None:
    """Write the requests that a check with a model would make.

    Exit codes: 0 all are written, 2 a protocol could not be rehearsed.
    """
    paths = tuple(str(path.resolve()) for path in rules or ())
    database = load_database(paths)
    for family in assay or ():
        database.family(family)
    configs = [one_of("--config", name, ASKING) for name in split(config) or ["hybrid"]]
    settings = CheckSettings(
        options=Options(assay=tuple(assay or ())),
        rules=paths,
        parameters=read_values(parameter or ()),
        csv_parameters=read_csv_paths(csv or ()),
        labware=read_labware(labware or ()),
        timeout_s=timeout,
        # Nobody answers: the check is made for what a model would get to know.
        asking=Asking(ScriptedBackend([])),
    )
    run = check_files(files, settings, database)
    requests = [
        (checked.file, request)
        for checked in run.protocols
        for name in configs
        if checked.dossier is not None
        and (request := request_in(name, checked.dossier, database)) is not None
    ]
    failed = [(c.file, c.problem.message) for c in run.protocols if c.problem is not None]
    for file, problem in failed:
        typer.echo(f"{file}: {problem}", err=True)
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
    typer.echo(f"{out}: {done.kept} answers kept; use them with --model replay:{out}")
    if done.problems or not done.kept:
        raise typer.Exit(BROKEN)
