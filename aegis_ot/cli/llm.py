"""``aegis-ot llm``: requests to a model out as a file, answers in, for batches and by hand."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..checking import Rehearser, TaskFailed
from ..checking.dossiers import CheckWithDossier
from ..checking.files import read_protocol
from ..checking.run import options_for
from ..errors import ConfigurationError
from ..preflight import Database, Options, load_database
from ..preflight.script import Script
from ..reasoning import Configuration, Request, export_requests, import_answers, request_in
from .app import BROKEN, app

llm = typer.Typer(
    help="Export requests to a model, and import answers got elsewhere.", no_args_is_help=True
)
app.add_typer(llm, name="llm")

_ASKING = [c.value for c in Configuration if c is not Configuration.RULES_ONLY]


@llm.command("export")
def export(
    files: Annotated[list[Path], typer.Argument(help="Python protocols.")],
    out: Annotated[Path, typer.Option(help="File of requests, one JSON object a line.")],
    config: Annotated[str, typer.Option(help=f"One of {', '.join(_ASKING)}.")] = "hybrid",
    assay: Annotated[list[str] | None, typer.Option(help="Assay family, if known.")] = None,
    rules: Annotated[list[Path] | None, typer.Option(help="Further rules.")] = None,
    timeout: Annotated[float, typer.Option(help="Longest rehearsal, s.")] = 120.0,
) -> None:
    """Write the requests that a check with a model would make.

    Exit codes: 0 all are written, 2 a protocol could not be rehearsed.
    """
    if config not in _ASKING:
        raise ConfigurationError(f"--config: {config!r} is not one of {', '.join(_ASKING)}.")
    paths = tuple(str(path.resolve()) for path in rules or ())
    database = load_database(paths)
    for family in assay or ():
        database.family(family)
    options = Options(assay=tuple(assay or ()))
    requests: list[tuple[str, Request]] = []
    failed = 0
    with Rehearser(paths) as rehearser:
        for file in files:
            try:
                requests.append(
                    _request(rehearser, file, config, options, paths, timeout, database)
                )
            except (TaskFailed, ConfigurationError) as error:
                typer.echo(f"{file}: {error}", err=True)
                failed += 1
    count = export_requests(requests, out)
    typer.echo(f"{out}: {count} requests.")
    if failed:
        raise typer.Exit(BROKEN)


def _request(
    rehearser: Rehearser,
    file: Path,
    config: str,
    options: Options,
    rules: tuple[str, ...],
    timeout_s: float,
    database: Database,
) -> tuple[str, Request]:
    text = read_protocol(file)
    task = CheckWithDossier(Script(text, file.name), options_for(text, options), rules, timeout_s)
    _, dossier = rehearser.perform(task)
    request = request_in(config, dossier, database)
    assert request is not None  # _ASKING holds only configurations that ask
    return file.as_posix(), request


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
