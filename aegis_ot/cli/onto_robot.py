"""``aegis-ot install`` and ``aegis-ot wrap``: the guard's two ways onto a robot."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from ..errors import ConfigurationError, ProtocolRejected
from ..workbench.files import NO_GUARD
from .exit_codes import FINDINGS
from .paths import write_text
from .robots import Robot

app = typer.Typer()


@app.command()
def install(
    robot: Robot,
    key: Annotated[
        Path | None, typer.Option(help="Private key file for ssh.", exists=True, dir_okay=False)
    ] = None,
    user: Annotated[str, typer.Option(help="Who logs in there.")] = "root",
    port: Annotated[int | None, typer.Option(help="Port of its ssh, where not 22.")] = None,
    restart: Annotated[
        bool, typer.Option(help="Restart the robot's server, so that it takes the new version.")
    ] = True,
) -> None:
    """Install the guard on an OT-2 or Flex over ssh, and try it there."""
    from ..robot.installing import install as put_there

    _refuse_while_running(robot)

    def tell(text: str) -> None:
        typer.echo(f"{robot}: {text} ...")

    try:
        found = put_there(robot, key, restart, tell, user=user, port=port)
    except KeyboardInterrupt:
        typer.echo(f"{robot}: what is installed there may be half of it. Run it again.", err=True)
        raise
    typer.echo(
        f"{robot}: aegis-ot {found.version} works there, under Python {found.python} and "
        f"opentrons {found.opentrons}."
        + (" Its server takes about a minute to come back." if restart else "")
    )


def _refuse_while_running(robot: str) -> None:
    from ..errors import RobotRefused, RobotUnreachable
    from ..robot import RobotClient

    with RobotClient(robot) as client:
        try:
            current = client.current_run()
            view = None if current is None else client.run(current)
        except (RobotUnreachable, RobotRefused):
            return  # its server may be what is to be mended
    if view is not None and not view.ended and view.status != "idle":
        raise ConfigurationError(f"{robot} runs a protocol ({view.status}). Install afterwards.")


@app.command()
def wrap(
    protocol: Annotated[Path, typer.Argument(help="A Python protocol, guarded or not.")],
    out: Annotated[Path, typer.Option(help="The file to write.")],
    setting: Annotated[
        list[str] | None,
        typer.Option("--set", help="Setting of the guard as NAME=VALUE. May be given often."),
    ] = None,
    measure: Annotated[
        bool, typer.Option(help="Simulate both here, and say what the guard adds.")
    ] = True,
) -> None:
    """Write a protocol with the guard inside, for a robot on which nothing may be installed.

    Exit codes: 0 written, 1 written, but the guard refuses this protocol, 2 it cannot be read, does
    not simulate, or a setting is no good.
    """
    from ..robot.timing import simulation_s
    from ..robot.wrapping import wrap as put_in

    if protocol.suffix.lower() == ".json":
        raise ConfigurationError(f"{protocol} is a JSON file: {NO_GUARD}")
    try:
        text = protocol.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigurationError(f"Cannot read the protocol {protocol}: {error}.") from None
    if out.exists() and out.samefile(protocol):
        raise ConfigurationError("--out would overwrite the protocol itself. Name another file.")
    wrapped = put_in(text, _settings(setting or ()))
    write_text(out, wrapped.text, newline="")
    typer.echo(
        f"{out}: {len(wrapped.text.encode()) / 1000:.0f} kB, {wrapped.bundle.modules} modules and "
        "the rules inside."
    )
    if wrapped.moved:
        typer.echo("The protocol began in its first line: its lines are one further down now.")
    if measure:
        try:
            plain, guarded = simulation_s(protocol, protocol.name), simulation_s(out, out.name)
        except ProtocolRejected as refusal:
            typer.echo(f"A robot will refuse it, as Layer 1 does here:\n{refusal}", err=True)
            raise typer.Exit(FINDINGS) from None
        typer.echo(
            f"Simulated here in {guarded:.1f} s, {plain:.1f} s without the guard; a second "
            "analysis in the same process is faster. An OT-2 takes about ten times as long."
        )


def _settings(given: list[str] | tuple[str, ...]) -> dict[str, Any]:
    from ..settings import NAMES, load_settings

    found: dict[str, Any] = {}
    for item in given:
        name, separator, value = item.partition("=")
        if not separator or name not in NAMES:
            raise ConfigurationError(f"--set {item!r} is no setting. Write it as assay=pcr.")
        found[name] = value
    load_settings(**found)  # refuses what a robot would refuse
    return found
