"""``aegis-ot check``: Layer 1 on files, for terminals, editors, hooks and CI."""

from __future__ import annotations

import dataclasses
import json
import os
import shutil
import sys
from pathlib import Path
from typing import Annotated, Any

import typer

from ..errors import ConfigurationError
from ..reports import FORMATS, SHOW_ROLES, renderer
from ..reports.check_text import check_text
from ..reports.wrapping import wrapped
from ..vocabulary import VerdictWord, counted
from ..workbench import Asking, CheckRun, Configuration, Project, check_projects, configurations_of
from ..workbench.baseline import baseline_text, read_baseline
from ..workbench.call_settings import settings_of
from ..workbench.shelf import protocols_named
from ..workbench.side_by_side import processors
from .counting import Counting
from .engines import InstallEngines, install_for_files
from .exit_codes import BROKEN, CLEAN
from .models import ModelName, RecordFolder, backend_of
from .options import (
    Assay,
    CsvParameters,
    FilesOrFolders,
    Ignore,
    Labware,
    Parameters,
    Rules,
    Select,
    Strict,
    Timeout,
    one_of,
    refuse_to_overwrite,
)
from .paths import write_text

app = typer.Typer()


@app.command()
def check(
    context: typer.Context,
    files: FilesOrFolders = None,
    output_format: Annotated[
        str, typer.Option("--format", "-f", help=f"One of {', '.join(FORMATS)}.")
    ] = "text",
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="Write here, not to the terminal.")
    ] = None,
    assay: Assay = None,
    rules: Rules = None,
    select: Select = None,
    ignore: Ignore = None,
    strict: Strict = False,
    explain_roles: Annotated[
        bool, typer.Option("--explain-roles", help="Show what each well is taken for, and why.")
    ] = False,
    parameter: Parameters = None,
    csv: CsvParameters = None,
    labware: Labware = None,
    all_parameters: Annotated[
        bool, typer.Option("--all-parameters", help="Try all values of runtime parameters.")
    ] = False,
    timeout: Timeout = None,
    baseline: Annotated[
        Path | None, typer.Option(help="Leave out the findings that this file lists.")
    ] = None,
    write_baseline: Annotated[
        Path | None, typer.Option(help="Write such a file from what is found now.")
    ] = None,
    roles_file: Annotated[
        Path | None,
        typer.Option(
            "--roles-template",
            help="Write the guard's roles for one protocol, filled with what is known.",
        ),
    ] = None,
    jobs: Annotated[
        int | None,
        typer.Option(
            "--jobs",
            "-j",
            min=1,
            help="Protocols to check at a time (one per processor if left out).",
        ),
    ] = None,
    mend: Annotated[
        bool, typer.Option("--fix", help="Mend what is sure, judge again, and write what holds.")
    ] = False,
    watch: Annotated[
        bool, typer.Option("--watch", help="Check again whenever a file changes, until Ctrl-C.")
    ] = False,
    model: ModelName = None,
    record: RecordFolder = None,
    install_engines: InstallEngines = False,
    robot: Annotated[
        str | None,
        typer.Option(
            help="The robot that the protocols are for: an engine of its version is taken."
        ),
    ] = None,
    run_id: Annotated[
        str | None,
        typer.Option("--run", help="Judge what this run on --robot really did; current: its last."),
    ] = None,
) -> None:
    """Check protocols before they run: rehearse them, and judge them by the rules.

    Beside Python protocols it takes Protocol Designer's files (schema 6 and newer) and analyses
    (opentrons analyze --json-output); findings there cite commands, and steps where the file tells
    them. Of a folder every protocol below it is checked; hidden folders and installed packages are
    passed over. A model, where one is named, adds to what the rules decide, and never takes from
    it.

    Exit codes: 0 clean, 1 findings, 2 a protocol could not be judged, a model that was asked
    gave no answer, or the call is wrong.
    """
    one_of("--format", output_format, FORMATS)
    if watch and files:
        from .watching import watch as keep_checking

        once: Any = context.command.callback
        keep_checking(files, lambda: once(**{**context.params, "watch": False}))
    if baseline and write_baseline:
        raise ConfigurationError("--baseline and --write-baseline cannot be given together.")
    if write_baseline and output:
        raise ConfigurationError(
            "--output and --write-baseline cannot be given together: a baseline is all that is "
            "written then."
        )
    version, files = _of_robot(robot, run_id, files or [])
    files = protocols_named(files)
    if roles_file and len(files) > 1:
        raise ConfigurationError("--roles-template takes one protocol at a time.")
    if install_engines:
        install_for_files(files)
    projects = []
    for configured, own in configurations_of(files, Path.cwd()):
        judging, rule_set = settings_of(
            configured,
            assay=assay,
            rules=rules,
            select=select,
            ignore=ignore,
            strict=strict,
            parameter=parameter,
            csv=csv,
            labware=labware,
            timeout=timeout,
        )
        inputs = [*files, *judging.csv_parameters.values(), *(rules or ()), *(labware or ())]
        refuse_to_overwrite("--write-baseline", write_baseline, inputs)
        refuse_to_overwrite("--roles-template", roles_file, inputs)
        if roles_file and roles_file.is_file() and roles_file.stat().st_size:
            raise ConfigurationError(
                f"--roles-template {roles_file}: it is there already, and may have been completed: "
                "give another name, or move it away."
            )
        known = baseline or (Path(configured.baseline) if configured.baseline else None)
        refuse_to_overwrite("--output", output, [*inputs, *([known] if known else ())])
        settings = dataclasses.replace(
            judging,
            all_parameters=all_parameters,
            explain_roles=explain_roles,
            playback=output_format == "html",
            asking=_asking(model, record, configured),
            jobs=jobs or processors(),
            robot_version=version,
            baseline=read_baseline(known) if known and not write_baseline else None,
        )
        projects.append(Project(own, settings, rule_set))
    with Counting(len(files)) as counting:
        run = check_projects(projects, files, counting.done)
    if mend:
        from .fixes import fix_all

        run = fix_all(run, projects)
    if write_baseline:
        write_text(write_baseline, baseline_text(write_baseline, run.protocols))
        count = sum(len(checked.findings) for checked in run.protocols)
        told = counted(count, "finding is", "findings are")
        typer.echo(f"{write_baseline}: {told} known from now on.", err=True)
        if run.exit_code != BROKEN:
            raise typer.Exit(CLEAN)
        silent = [c for c in run.protocols if c.unanswered or c.verdict is VerdictWord.ERROR]
        typer.echo(check_text(dataclasses.replace(run, protocols=silent)), err=True, nl=False)
        raise typer.Exit(BROKEN)
    _show(run, output_format, output)
    if roles_file:
        from ..workbench.roles_template import roles_template

        write_text(roles_file, roles_template(run.protocols[0], projects[0].rule_set))
        typer.echo(f"{roles_file}: the roles, to be completed and pasted.", err=True)
    raise typer.Exit(run.exit_code)


def _of_robot(robot: str | None, run_id: str | None, files: list[Path]) -> tuple[str, list[Path]]:
    """The robot's version, and what is to be judged: the files, or the run written into one."""
    if run_id and (files or not robot):
        raise ConfigurationError("--run goes with --robot, and without files.")
    if not (files or run_id):
        raise ConfigurationError("Name protocols, folders, or a run: --robot HOST --run ID.")
    if robot is None:
        return "", files
    from ..robot import RobotClient
    from ..robot.recorded import recorded_run

    with RobotClient(robot) as client:
        version = str(client.health().get("api_version") or "")
        if run_id is None:
            return version, files
        known = client.current_run() if run_id == "current" else run_id
        if known is None:
            raise ConfigurationError(f"There is no run on {client.url}.")
        document = recorded_run(client, known)
    path = Path(f"run-{''.join(c for c in known if c.isalnum() or c in '-_')}.json")
    write_text(path, json.dumps(document))
    typer.echo(f"{path}: what the run did, as the robot tells it.", err=True)
    return version, [path]


def _asking(model: str | None, record: Path | None, configured: Configuration) -> Asking | None:
    backend = backend_of(model, record, configured.model, configured.folder)
    return None if backend is None else Asking(backend)


def _show(run: CheckRun, output_format: str, output: Path | None) -> None:
    if run.explain_roles and output_format not in SHOW_ROLES:
        told = f"--explain-roles: {output_format} has no place for roles"
        typer.echo(f"aegis-ot: {told}; {', '.join(SHOW_ROLES)} show them.", err=True)
    if output is not None:
        write_text(output, renderer(output_format)(run))
        typer.echo(f"{output_format} report: {output}", err=True)
        return
    if output_format == "text":
        text = check_text(run, colour=_colours())
        if sys.stdout.isatty():
            text = wrapped(text, shutil.get_terminal_size().columns)
    else:
        text = renderer(output_format)(run)
    # Bytes: a Windows console's own encoding may lack the µ of a message. A protocol's text may
    # hold half a surrogate pair.
    sys.stdout.buffer.write(text.encode("utf-8", "backslashreplace"))
    sys.stdout.buffer.flush()


def _colours() -> bool:
    if os.environ.get("NO_COLOR"):
        return False
    return sys.stdout.isatty() and os.environ.get("TERM") != "dumb"
