"""``aegis-ot runs``: what a sidecar has kept."""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.table import Table
from rich.text import Text

from ..errors import ConfigurationError
from ..vocabulary import counted, one_line
from .paths import empty_folder, tip_finder, write_text
from .plain_text import echo
from .printing import PlainConsole

if TYPE_CHECKING:
    from ..sidecar.store import Store

app = typer.Typer()
runs = typer.Typer(
    help="What a sidecar has kept: list, show, export, remove.", no_args_is_help=True
)
app.add_typer(runs, name="runs")

DataFolder = Annotated[
    Path | None, typer.Option(help="Data folder of the sidecar; its usual one if left out.")
]


@runs.command("list")
def list_runs(
    search: Annotated[
        str, typer.Argument(help="Words in the protocol, robot, outcome or run.")
    ] = "",
    data: DataFolder = None,
    most: Annotated[int, typer.Option(min=1, help="How many, newest first.")] = 50,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON array.")] = False,
) -> None:
    """List runs, newest first."""
    store = open_data(data)
    rows = store.runs(search, most)
    if as_json:
        echo(json.dumps(rows, ensure_ascii=False, indent=1))
        return
    if not rows:
        echo(f"{store.folder}: no run is like that.")
        return
    table = Table(box=None, pad_edge=False, header_style="bold")
    for name in ("begun", "run", "protocol", "robot", "outcome", "wells"):
        table.add_column(name, overflow="fold")
    for row in rows:
        ended = row["finished"]
        wells = ", ".join(f"{count} {outcome}" for outcome, count in sorted(row["wells"].items()))
        cells = (
            time.strftime("%Y-%m-%d %H:%M", time.localtime(row["registered"])),
            row["run"],
            row["protocol"] + (" (simulated)" if row["simulated"] else ""),
            row.get("robot_name") or row["robot"],
            ended["outcome"] if ended else "running",
            wells,
        )
        table.add_row(*(Text(one_line(cell)) for cell in cells))
    # What is piped is not folded.
    PlainConsole(highlight=False, width=None if sys.stdout.isatty() else 200).print(table)


@runs.command()
def show(
    run: Annotated[str, typer.Argument(help="Which run; the newest if left out.")] = "",
    data: DataFolder = None,
    html: Annotated[Path | None, typer.Option(help="Write the report here, as a page.")] = None,
    as_json: Annotated[Path | None, typer.Option("--json", help="Write it here, as JSON.")] = None,
) -> None:
    """Tell what came of a run, and write its report."""
    from ..account import run_account
    from ..reports.run_html import report_run, run_report_html
    from ..sidecar.overview import run_overview

    store = open_data(data)
    name = known_run(store, run)
    overview = run_overview(store, name)
    account = run_account(overview)
    for line in _told(account):
        echo(line)
    if html is not None:
        write_text(html, run_report_html([report_run(overview, store.frames_of(name))]))
        echo(f"Report: {html}", err=True)
    if as_json is not None:
        write_text(as_json, json.dumps(account, ensure_ascii=False, indent=1) + "\n")
        echo(f"JSON: {as_json}", err=True)


@runs.command()
def export(
    out: Annotated[Path, typer.Argument(help="New or empty folder.")],
    run: Annotated[list[str] | None, typer.Option(help="Only these runs. Repeatable.")] = None,
    data: DataFolder = None,
    boxes: Annotated[
        str, typer.Option(help="What finds the tips: detector, or an .onnx file.")
    ] = "detector",
) -> None:
    """Write runs as a data set, so that a lab's own normal wells feed aegis-ot fit.

    Labels are the verdicts as they stand after the operator: correct them by hand where they are
    wrong before anything is measured against them. Trajectories that nobody decided are left
    out, and so is a run without one that passed.
    """
    from ..worldmodel.exporting import export_runs
    from .progress import Shown

    empty_folder(out)
    with Shown() as shown:
        told = export_runs(_folder(data), out, run or (), tip_finder(boxes), shown)
    written = counted(told.written, "trajectory", "trajectories")
    echo(
        f"{out}: {written} of {counted(told.runs, 'run')}, {told.failures} of them failures, "
        f"{told.left_out} left out. The labels are verdicts, not truth."
    )


@runs.command()
def prune(
    data: DataFolder = None,
    days: Annotated[float | None, typer.Option(help="Runs that ended longer ago.")] = None,
    gigabytes: Annotated[
        float | None, typer.Option(help="The oldest, until all frames take less.")
    ] = None,
    yes: Annotated[bool, typer.Option("--yes", help="Remove; else only say what.")] = False,
) -> None:
    """Remove old runs with their frames. They cannot be brought back.

    A run that has not ended stays. A sidecar that is at work removes by its own settings
    (retention.days, retention.gigabytes).
    """
    from ..sidecar.config import RetentionSettings
    from ..sidecar.housekeeping import tidy

    if days is None and gigabytes is None:
        raise ConfigurationError("Say what to remove: --days, --gigabytes, or both.")
    if (days is not None and days <= 0) or (gigabytes is not None and gigabytes <= 0):
        raise ConfigurationError("--days and --gigabytes must be above 0.")
    store = open_data(data, alone=yes)
    settings = RetentionSettings(days=days, gigabytes=gigabytes)
    done = tidy(store, settings, store.ages_by_clock(time.time()), pretend=not yes)
    store.close()
    for name in done.removed:
        echo(name)
    said = "removed" if yes else "would be removed; add --yes"
    echo(f"{counted(len(done.removed), 'run')}, {done.freed / 1e6:.1f} MB: {said}.")


def _told(account: dict[str, Any]) -> list[str]:
    counts, ended = account["counts"], account["finished"]
    first = (
        f"{account['protocol'] or account['run']} on "
        f"{account['robot_name'] or account['robot'] or 'an unknown robot'}: "
        f"{ended['outcome'] if ended else 'not finished'}"
    )
    states = ", ".join(f"{n} {state}" for state, n in counts.items() if state != "wells")
    lines = [first, f"{counted(counts['wells'], 'delivery', 'deliveries')} on {account['frames']} "
             f"frames: {states or 'none judged'}"]  # fmt: skip
    if ended and ended["detail"]:
        lines.append(str(ended["detail"]))
    for well in account["wells"]:
        if well["trajectory"] in account["flagged"]:
            lines.append(f"  {well['well']}: {well['state']}. {well['reason'] or ''}".rstrip())
    for one in account["incidents"]:
        lines.append(f"  {one['kind']}: {one['text']}")
    return lines


def _folder(data: Path | None) -> Path:
    from ..sidecar import SidecarConfig
    from ..sidecar.token_file import known_token

    return SidecarConfig.load(find_token=known_token).data if data is None else data


def open_data(data: Path | None, alone: bool = False) -> Store:
    """The store in a folder, or in the sidecar's usual one."""
    from ..sidecar.opening import open_store

    return open_store(_folder(data), alone)


def known_run(store: Store, run: str) -> str:
    """A run of the store, the newest if none is named. Raises ConfigurationError."""
    known = [str(row["run"]) for row in store.runs()]
    if not known:
        raise ConfigurationError(f"{store.folder} holds no run yet.")
    if run and run not in known:
        raise ConfigurationError(
            f"{store.folder} holds no run {run!r}; its newest are {', '.join(known[:10])}."
        )
    return run or known[0]
