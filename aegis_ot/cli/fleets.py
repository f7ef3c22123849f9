"""``aegis-ot fleet``: many robots at once."""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
import signal
import sys
from collections.abc import Coroutine, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.live import Live
from rich.table import Table
from rich.text import Text

from ..errors import AegisError, ConfigurationError
from ..vocabulary import counted
from .exit_codes import BROKEN, CLEAN, FINDINGS, INTERRUPTED
from .paths import write_text
from .printing import PlainConsole

if TYPE_CHECKING:
    from ..fleet import FleetConfig, FleetReport, Job
    from ..fleet.report import FleetEntry

app = typer.Typer()
fleet = typer.Typer(help="Many robots: one agent each.", no_args_is_help=True)
app.add_typer(fleet, name="fleet")
console = PlainConsole(highlight=False)

Robots = Annotated[Path, typer.Option("--robots", help="The fleet: a TOML or JSON file.")]
_STYLES = {"succeeded": "green", "stopped": "yellow", "broken off": "yellow"}


@fleet.command()
def run(
    protocols: Annotated[list[Path], typer.Argument(help="Python protocols.")],
    robots: Robots,
    yes: Annotated[
        bool,
        typer.Option(
            "--yes", "-y", help="Every real robot is ready for the first protocol that it gets."
        ),
    ] = False,
    labware: Annotated[
        list[Path] | None, typer.Option(help="Folder or file with custom labware definitions.")
    ] = None,
    parameter: Annotated[
        list[str] | None, typer.Option(help="Runtime parameter of all, as NAME=VALUE.")
    ] = None,
    report: Annotated[
        Path | None, typer.Option(help="Write the fleet report here: .json, or .html with both.")
    ] = None,
) -> None:
    """Run protocols on a fleet, the longest first, each on a robot that has what it needs."""
    from ..fleet import run_fleet

    if report is not None and report.suffix not in (".json", ".html"):
        raise ConfigurationError(f"The report {report} must end in .json or .html.")
    config = _load(robots)
    if not yes and not sys.stdin.isatty() and any(not robot.simulated for robot in config.robot):
        raise ConfigurationError("Nobody can be asked whether decks are in place. Add --yes.")
    jobs = _read(protocols, labware or (), parameter or ())
    with _FleetLines([robot.name for robot in config.robot], yes) as screen:
        result = asyncio.run(_interruptible(run_fleet(config, jobs, screen)))
    if report is not None:
        _write(report, result)
    raise typer.Exit(_conclude(result))


@fleet.command()
def serve(
    robots: Robots,
    robot: Annotated[
        list[str] | None, typer.Option(help="Only these; else all with remote = true.")
    ] = None,
) -> None:
    """Serve agents on this host, for a fleet that is run elsewhere. Ctrl-C ends it."""
    from ..fleet import serve_agents

    config = _load(robots)
    try:
        asyncio.run(
            serve_agents(config, robot or (), lambda names: _say(f"Serving {', '.join(names)}"))
        )
    except KeyboardInterrupt:
        _say("Agents ended; robots that ran a protocol are paused.")


@fleet.command()
def pause(
    robots: Robots,
    robot: Annotated[list[str] | None, typer.Option(help="Only these; else all.")] = None,
    release: Annotated[bool, typer.Option("--release", help="Let them go on.")] = False,
) -> None:
    """Hold the robots of a running fleet before their next move; needs redis or http."""
    from ..fleet import hold_robots

    asyncio.run(hold_robots(_load(robots), robot or (), not release))
    _say("Released." if release else "Held; --release lets them go on.")


@fleet.command()
def exchange(
    host: Annotated[str, typer.Option(help="Address to listen at.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(help="Port to listen at.")] = 8700,
) -> None:
    """Run a self-hosted HTTP exchange. It asks for no password: a trusted network only."""
    _load_library()
    from ..fleet.exchange import serve_exchange

    _say(f"Exchange at http://{host}:{port}; whoever reaches it can run protocols.")
    serve_exchange(host, port)


def _load_library() -> None:
    try:
        import academy  # noqa: F401
    except ModuleNotFoundError:
        raise ConfigurationError(
            "A fleet needs Academy, which is not installed: pip install 'aegis-ot[fleet]'"
        ) from None
    # A lost agent is told once, by the fleet; Academy would log a traceback besides.
    logging.getLogger("academy").setLevel(logging.CRITICAL + 1)


def _load(path: Path) -> FleetConfig:
    _load_library()
    from ..fleet import FleetConfig

    return FleetConfig.load(path)


def _read(
    protocols: Sequence[Path], labware: Sequence[Path], parameters: Sequence[str]
) -> list[Job]:
    """Rehearse all before any robot moves."""
    from ..fleet import read_job

    jobs = []
    for path in protocols:
        try:
            jobs.append(read_job(path, labware, parameters))
        except AegisError as error:
            raise ConfigurationError(f"{path}: {error} Nothing was started.") from None
    return jobs


async def _interruptible(run: Coroutine[Any, Any, FleetReport]) -> FleetReport:
    """Ctrl-C breaks the run off, which still reports; a second one ends the program."""
    loop, task = asyncio.get_running_loop(), asyncio.ensure_future(run)

    def interrupt() -> None:
        loop.remove_signal_handler(signal.SIGINT)
        _say("Breaking off; the robots are stopped or paused.", "bold yellow")
        task.cancel()

    with contextlib.suppress(NotImplementedError):  # Windows
        loop.add_signal_handler(signal.SIGINT, interrupt)
    return await task


class _FleetLines:
    """A :class:`aegis_ot.fleet.FleetScreen`: a line a robot, rewritten, and what is over above."""

    def __init__(self, names: Sequence[str], yes: bool) -> None:
        self._yes = yes
        self._asking = asyncio.Lock()
        self._given: set[str] = set()
        self._rows: dict[str, Mapping[str, Any]] = {name: {} for name in names}
        self._live = Live(console=console, transient=True, refresh_per_second=4)

    def __enter__(self) -> Any:
        self._live.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._live.stop()

    async def is_ready(self, robot: str, job: Job) -> bool:
        """Ask, one robot at a time, while the others go on."""
        if self._yes and robot not in self._given:
            self._given.add(robot)
            return True
        if not sys.stdin.isatty():  # nobody has put a fresh deck in place either
            return False
        question = f"{job.name} goes to {robot}. Deck, tips and liquids are in place?"
        async with self._asking:
            self._live.stop()
            try:
                return await asyncio.to_thread(typer.confirm, question)
            finally:
                self._live.start()

    def stands(self, robot: str, status: Mapping[str, Any]) -> None:
        self._rows[robot] = status
        self._live.update(self._table())

    def ended(self, entry: FleetEntry) -> None:
        flagged = f", {counted(len(entry.flagged), 'well')} flagged" if entry.flagged else ""
        where = f" on {entry.robot}" if entry.robot else ""
        _say(
            f"{entry.job.name}{where}: {entry.outcome}{flagged}", _STYLES.get(entry.outcome, "red")
        )
        if entry.detail:
            _say(f"  {entry.detail}")

    def lost(self, robot: str, why: str) -> None:
        _say(f"{robot} is out: {why}", "bold red")
        self._rows[robot] = {"state": "out"}

    def _table(self) -> Table:
        table = Table(box=None, pad_edge=False)
        for robot, row in self._rows.items():
            wells = f"{row.get('judged', 0)}/{row['wells']} wells" if row.get("wells") else ""
            flagged = f"{row['flagged']} flagged" if row.get("flagged") else ""
            state = "held" if row.get("held") else str(row.get("state", ""))
            texts = (
                robot,
                state,
                str(row.get("job") or ""),
                wells,
                flagged,
                str(row.get("text", "")),
            )
            table.add_row(*(Text(text) for text in texts))
        return table


def _write(path: Path, result: FleetReport) -> None:
    from ..reports.fleet_html import fleet_report_html

    text = json.dumps(result.to_json(), indent=2, ensure_ascii=False)
    write_text(path.with_suffix(".json"), text + "\n")
    if path.suffix == ".html":
        write_text(path, fleet_report_html(result.to_json(pictures=True)))
    _say(f"Report: {path}")


def _conclude(result: FleetReport) -> int:
    clean = sum(entry.is_clean for entry in result.entries)
    total = len(result.entries)
    _say(f"{clean} of {counted(total, 'protocol')} clean; {result.seconds:.1f} s.")
    if result.broken_off:
        _say("Broken off: look at every robot before anything else runs there.", "bold red")
        return INTERRUPTED
    outcomes = {entry.outcome for entry in result.entries}
    if result.lost or outcomes & {"failed", "lost", "not run"}:
        return BROKEN
    return CLEAN if clean == total else FINDINGS


def _say(text: str, style: str = "") -> None:
    console.print(Text(text, style=style), soft_wrap=True)
