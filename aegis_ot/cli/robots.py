"""``aegis-ot run`` and ``aegis-ot watch``: a protocol on a robot, seen from the terminal."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.text import Text

from ..errors import ConfigurationError, RobotError
from .exit_codes import BROKEN, CLEAN, FINDINGS, INTERRUPTED
from .printing import PlainConsole

if TYPE_CHECKING:
    from ..robot import Analysis
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
    parameter: Annotated[
        list[str] | None, typer.Option(help="Runtime parameter as NAME=VALUE.")
    ] = None,
    labware: Annotated[
        list[Path] | None, typer.Option(help="Folder or file with custom labware definitions.")
    ] = None,
    offsets: Annotated[
        str,
        typer.Option(
            help="known: refuse where the robot knows labware offsets, which this run would not "
            "have; none: run without them."
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
    from ..checking.files import labware_files, read_values
    from ..robot import RobotClient
    from ..robot.offsets import refuse_lost_offsets
    from ..robot.running import Inputs, RobotRun, analyse, run_analysed
    from .options import one_of
    from .robot_screen import TerminalScreen, show_end

    if not protocol.is_file():
        raise ConfigurationError(f"There is no protocol {protocol}.")
    heeds_offsets = one_of("--offsets", offsets, ("known", "none")) == "known"
    files = labware_files(labware or ())
    inputs = Inputs(tuple(files), read_values(parameter or ()))
    with RobotClient(robot) as client:
        health = client.health()
        name = str(health.get("name") or client.url)
        _say(f"{name} ({health.get('robot_model', 'robot')}, {health.get('api_version', '?')})")
        with TerminalScreen(console) as screen:
            identifier, analysis = analyse(client, protocol, screen, analysis_timeout, inputs)
        refused = _show_analysis(protocol, analysis, labware or (), parameter or ())
        if refused or analyse_only:
            raise typer.Exit(FINDINGS if refused else CLEAN)
        if heeds_offsets:
            refuse_lost_offsets(client, analysis.places)
        _ask_to_start(name, yes)
        verdicts = _verdicts(sidecar, token, protocol, name)
        result = RobotRun(protocol.name, name, client.url, "", analysis)
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
    raise typer.Exit(_code(result))


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
    from ..robot.moments import PastLink
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
    url, secret = _sidecar_of(sidecar, token)
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
    raise typer.Exit(_code(result))


def _show_analysis(
    protocol: Path, analysis: Analysis, labware: Sequence[Path], parameters: Sequence[str]
) -> bool:
    """Say what the analysis found; whether the protocol must not start."""
    if not analysis.ok:
        for error in analysis.errors:
            _say(error, "red")
        _say(f"{protocol.name}: the robot's analysis failed; nothing has moved.", "bold red")
        return True
    if analysis.guard_words:
        _say(analysis.guard_words[-1])
        return False
    _say("This protocol carries no guard; Layer 1 checks it here, and nobody watches its tips.")
    return _fails_here(protocol, labware, parameters)


def _fails_here(protocol: Path, labware: Sequence[Path], parameters: Sequence[str]) -> bool:
    from ..dryrun import read_script
    from ..errors import RehearsalError
    from ..preflight.check_protocol import check_script, errors_of, rejection, summary

    try:
        found = check_script(read_script(protocol, labware, parameters))
    except RehearsalError as error:
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

    url, secret = _sidecar_of(sidecar, token)
    if url is None:
        return None
    reader = VerdictReader(url, secret, protocol.name, robot=robot)
    reader.check()
    return reader


def _sidecar_of(sidecar: str | None, token: str | None) -> tuple[str | None, str | None]:
    """Its address and token: given here, or the guard's own settings on this machine."""
    from ..settings import load_settings

    given = {"sidecar": sidecar, "token": token}
    settings = load_settings(**{name: value for name, value in given.items() if value})
    return settings.sidecar, settings.token


def _write_report(path: Path, result: RobotRun) -> None:
    from ..robot.run_report import run_report

    path.parent.mkdir(parents=True, exist_ok=True)
    text = json.dumps(run_report(result), indent=2, ensure_ascii=False)
    path.write_text(text + "\n", encoding="utf-8")
    _say(f"Report: {path}")


def _code(result: RobotRun) -> int:
    if result.status == "failed":
        return BROKEN
    flagged = any(known.is_flagged for known in result.verdicts.values())
    return FINDINGS if flagged or result.unheard or result.status != "succeeded" else CLEAN


def _say(text: str, style: str = "") -> None:
    console.print(Text(text, style=style), soft_wrap=True)
