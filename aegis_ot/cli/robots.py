"""``aegis-ot run`` and ``aegis-ot watch``: a protocol on a robot, seen from the terminal."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.text import Text

from ..errors import ConfigurationError, RobotError
from .exit_codes import BROKEN, CLEAN, FINDINGS, INTERRUPTED
from .options import CsvParameters, Labware, Parameters
from .paths import write_text
from .printing import PlainConsole

if TYPE_CHECKING:
    from ..robot import Analysis
    from ..robot.preparing import Inputs
    from ..robot.running import RobotRun
    from ..robot.verdicts import VerdictReader

console = PlainConsole(highlight=False)

Robot = Annotated[
    str, typer.Option("--robot", help="The robot's address, as the Opentrons App shows it.")
]
SidecarUrl = Annotated[
    str | None, typer.Option("--sidecar", help="Sidecar; else the guard's own settings.")
]
Token = Annotated[
    str | None, typer.Option("--token", help="Its token; better given as AEGIS_OT_TOKEN.")
]


app = typer.Typer()


@app.command()
def run(
    protocol: Annotated[Path, typer.Argument(help="A Python protocol.")],
    robot: Robot,
    yes: Annotated[bool, typer.Option("--yes", "-y", help="Start without asking.")] = False,
    analyse_only: Annotated[
        bool, typer.Option("--analyse-only", help="Stop after the robot's analysis.")
    ] = False,
    parameter: Parameters = None,
    labware: Labware = None,
    csv: CsvParameters = None,
    offsets: Annotated[
        str,
        typer.Option(
            help="Labware offsets of the run: known (what the robot keeps), none, or a JSON file."
        ),
    ] = "known",
    sidecar: SidecarUrl = None,
    token: Token = None,
    analysis_timeout: Annotated[
        float, typer.Option(help="How long the robot may analyse, s.")
    ] = 900.0,
    report: Annotated[Path | None, typer.Option(help="Write a JSON report here.")] = None,
) -> None:
    """Run a protocol on a robot: upload, analysis, Layer 1, start, verdicts, report."""
    from ..robot.preparing import Inputs
    from ..workbench.files import labware_files, read_csv_paths, read_values

    if not protocol.is_file():
        raise ConfigurationError(f"There is no protocol {protocol}.")
    values, files = read_values(parameter or ()), read_csv_paths(csv or ())
    inputs = Inputs(tuple(labware_files(labware or ())), values, files)
    result = not_yet_run(protocol)
    run_protocol(
        result, protocol, robot, inputs, sidecar, token, yes=yes, labware=labware or (),
        analyse_only=analyse_only, offsets=offsets, analysis_timeout=analysis_timeout,
        report=report,
    )  # fmt: skip
    raise typer.Exit(exit_code(result))


def not_yet_run(protocol: Path) -> RobotRun:
    """For :func:`run_protocol` to fill in."""
    from ..robot import Analysis
    from ..robot.running import RobotRun

    return RobotRun(protocol.name, "", "", "", Analysis("", done=False))


def run_protocol(
    result: RobotRun,
    protocol: Path,
    robot: str,
    inputs: Inputs,
    sidecar: str | None,
    token: str | None,
    *,
    yes: bool = False,
    labware: Sequence[Path] = (),
    analyse_only: bool = False,
    offsets: str = "known",
    analysis_timeout: float = 900.0,
    report: Path | None = None,
) -> None:
    """From upload to end, as ``aegis-ot run`` has it.

    Args:
        result: Filled in as far as it comes; without an ``id`` nothing was begun.
        protocol, robot: The file, and the robot's address.
        inputs: Of the protocol.
        sidecar, token: Of its sidecar; else of the guard's settings on this machine.
        yes, labware, analyse_only, offsets, analysis_timeout, report: Options of the command.

    Raises:
        RobotError: The robot refuses, or is lost.
        typer.Exit: It does not begin, or was left to the App; why was said.
    """
    from ..robot import RobotClient
    from ..robot.preparing import analyse, refuse_what_is_not_there, take_offsets
    from ..robot.running import run_analysed
    from .robot_screen import TerminalScreen, show_end

    with RobotClient(robot) as client:
        health = client.health()
        result.robot = name = str(health.get("name") or client.url)
        _say(f"{name} ({health.get('robot_model', 'robot')}, {health.get('api_version', '?')})")
        with TerminalScreen(console) as screen:
            waiting = screen.analysing
            identifier, analysis = analyse(client, protocol, waiting, analysis_timeout, inputs)
        result.url, result.analysis = client.url, analysis
        version = str(health.get("api_version") or "")
        refused = _show_analysis(protocol, analysis, labware, inputs, version)
        if refused or analyse_only:
            raise typer.Exit(FINDINGS if refused else CLEAN)
        refuse_what_is_not_there(client, analysis)
        for line in take_offsets(client, analysis, inputs, offsets):
            _say(line)
        _ask_to_start(name, yes)
        verdicts = _verdicts(sidecar, token, protocol, name)
        try:
            with TerminalScreen(console) as screen:
                run_analysed(client, identifier, result, screen, verdicts, inputs)
        except KeyboardInterrupt:
            _say(f"Left to the App: run {result.id} on {name} is {client.run(result.id).status}.")
            raise typer.Exit(INTERRUPTED) from None
        except RobotError:
            if result.id:
                _say(f"Run {result.id} was left as it stood; look at the robot.", "bold red")
            raise
        finally:
            if result.id and report is not None:
                _write_report(report, result)
    show_end(console, result)


@app.command()
def watch(
    robot: Robot,
    sidecar: SidecarUrl = None,
    token: Token = None,
    on_fail: Annotated[
        str, typer.Option(help="When a delivery fails: pause or continue.")
    ] = "pause",
    on_undecided: Annotated[
        str, typer.Option(help="When one cannot be judged: pause or continue.")
    ] = "pause",
    on_link_loss: Annotated[
        str, typer.Option(help="When the sidecar is lost: pause or continue.")
    ] = "pause",
    report: Annotated[Path | None, typer.Option(help="Write a JSON report here.")] = None,
) -> None:
    """Watch the run on a robot whose protocol carries no guard; waits until one begins."""
    from ..robot import Analysis, RobotClient
    from ..robot.keyframe_times import PastLink
    from ..robot.running import RobotRun
    from ..robot.verdicts import VerdictReader
    from ..robot.watching import WatchPolicies, await_run, watch_run
    from .options import one_of
    from .robot_screen import TerminalScreen, show_end

    choices = ("pause", "continue")
    policies = WatchPolicies(
        one_of("--on-fail", on_fail, choices),
        one_of("--on-undecided", on_undecided, choices),
        one_of("--on-link-loss", on_link_loss, choices),
    )
    url, secret = sidecar_of(sidecar, token)
    if url is None:
        raise ConfigurationError("Watching needs a sidecar: --sidecar http://127.0.0.1:7645.")
    with RobotClient(robot) as client:
        name = str(client.health().get("name") or client.url)
        link = PastLink(url, secret)
        link.health(policies.capture_timeout_s)
        _say(f"Waiting for a run on {name}")
        identifier = await_run(client, says=_say)
        analysis = Analysis("", done=False)
        result = RobotRun(client.protocol_name(identifier), name, client.url, identifier, analysis)
        reader = VerdictReader(url, secret)
        try:
            with TerminalScreen(console) as screen:
                screen.began(None)
                watch_run(client, result, link, screen, policies, reader)
        finally:
            reader.close()
            if report is not None:
                _write_report(report, result)
    show_end(console, result)
    raise typer.Exit(exit_code(result))


def _show_analysis(
    protocol: Path, analysis: Analysis, labware: Sequence[Path], inputs: Inputs, version: str
) -> bool:
    """Say what the analysis found; whether the protocol must not start."""
    if not analysis.ok:
        for error in analysis.errors:
            _say(error, "red")
        if lacks := re.search(r"No module named '([\w.]+)'", " ".join(analysis.errors)):
            _say(_how_to_bring(lacks[1], protocol), "yellow")
        for name in analysis.files_lacking:
            _say(f"The parameter {name} needs a file: --csv {name}=FILE.", "red")
        _say(f"{protocol.name}: the robot's analysis failed; nothing has moved.", "bold red")
        return True
    if analysis.guard_words:
        _say(analysis.guard_words[-1])
        return False
    _say("This protocol carries no guard; Layer 1 checks it here, and nobody watches its tips.")
    return _fails_here(protocol, labware, inputs, version)


def _how_to_bring(module: str, protocol: Path) -> str:
    if module.partition(".")[0] == "aegis_ot":
        return (
            f"aegis-ot is not on this robot. Run a file that carries it (aegis-ot wrap "
            f"{protocol.name}), or install it there (aegis-ot install, which needs ssh)."
        )
    return f"This robot lacks the package {module}. Install it there, or do without it."


def _fails_here(protocol: Path, labware: Sequence[Path], inputs: Inputs, version: str) -> bool:
    """Layer 1 with an ``opentrons`` that fits, the robot's own version first."""
    from ..dryrun import read_script
    from ..errors import RehearsalError
    from ..preflight import Options
    from ..preflight.check_protocol import errors_of, rejection, summary
    from ..workbench.engines import EngineMissing, engine_for, need_of
    from ..workbench.rehearser import Rehearser, TaskFailed
    from ..workbench.tasks import CheckTask

    files = {name: str(path) for name, path in inputs.files.items()}
    script = read_script(protocol, labware)
    script = replace(script, parameters=inputs.values, csv_parameters=files)
    try:
        engine = engine_for(need_of(script.text), version)
        with Rehearser(engine=engine, lasting=True) as rehearser:
            found = rehearser.perform(CheckTask(script, Options(), (), 120.0)).report
    except (EngineMissing, RehearsalError, TaskFailed) as error:
        _say(f"Layer 1 could not rehearse it here: {error}", "yellow")
        return False
    is_rejected = bool(errors_of(found))
    _say(rejection(found) if is_rejected else summary(found))
    return is_rejected


def _ask_to_start(name: str, yes: bool) -> None:
    if yes:
        return
    if not sys.stdin.isatty():
        raise ConfigurationError("Nobody can be asked whether to start. Add --yes.")
    if not typer.confirm(f"Start on {name}? Deck, tips and liquids are in place"):
        raise typer.Exit(CLEAN)


def _verdicts(
    sidecar: str | None, token: str | None, protocol: Path, robot: str
) -> VerdictReader | None:
    from ..robot.verdicts import VerdictReader

    url, secret = sidecar_of(sidecar, token)
    if url is None:
        return None
    reader = VerdictReader(url, secret, protocol.name, robot=robot)
    reader.check()
    return reader


def sidecar_of(sidecar: str | None, token: str | None) -> tuple[str | None, str | None]:
    """Its address and token: given here, or the guard's own settings on this machine."""
    from ..settings import load_settings

    given = {"sidecar": sidecar, "token": token}
    settings = load_settings(**{name: value for name, value in given.items() if value})
    return settings.sidecar, settings.token


def _write_report(path: Path, result: RobotRun) -> None:
    from ..robot.run_report import run_report

    text = json.dumps(run_report(result), indent=2, ensure_ascii=False)
    write_text(path, text + "\n")
    _say(f"Report: {path}")


def exit_code(result: RobotRun) -> int:
    """0 clean, 1 something is to be looked at or unheard, 2 the run failed."""
    if result.status == "failed":
        return BROKEN
    flagged = result.not_as_rehearsed or any(it.is_flagged for it in result.verdicts.values())
    return FINDINGS if flagged or result.unheard or result.status != "succeeded" else CLEAN


def _say(text: str, style: str = "") -> None:
    console.print(Text(text, style=style), soft_wrap=True)
