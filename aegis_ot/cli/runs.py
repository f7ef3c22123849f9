"""``aegis-ot runs``: what a sidecar has kept."""

from __future__ import annotations

import json
import re
import sys
import time
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.table import Table
from rich.text import Text

from ..errors import ConfigurationError, StoreError
from ..vocabulary import counted, one_line
from .paths import empty_folder, tip_finder, write_text
from .plain_text import echo
from .printing import PlainConsole

if TYPE_CHECKING:
    from ..sidecar.store import Store
    from ..sidecar.store.verifying import VerifiedRun

app = typer.Typer()
runs = typer.Typer(
    help="What a sidecar has kept: list, show, export, verify, trends, remove.",
    no_args_is_help=True,
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
    from ..sidecar.overview import runs_overview

    rows = runs_overview(store, search, most)
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
    from ..reports.run_html import report_run, run_report_html
    from ..run_view import run_account
    from ..sidecar.overview import run_overview

    store = open_data(data)
    name = known_run(store, run)
    overview = run_overview(store, name)
    account = run_account(overview)
    for line in _told(account):
        echo(line)
    if html is not None:
        reported = report_run(
            overview, store.frames_of(name), clip=lambda number: store.clip(name, number)
        )
        write_text(html, run_report_html([reported]))
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
    lineage: Annotated[
        bool, typer.Option("--lineage", help="What happened in each well, to file or send on.")
    ] = False,
) -> None:
    """Write runs as a data set, so that a lab's own normal wells feed aegis-ot fit.

    Labels are the verdicts as they stand after the operator: correct them by hand where they are
    wrong before anything is measured against them. Trajectories that nobody decided are left
    out, and so is a run without one that passed.

    With --lineage: a folder for each run with lineage.csv, lineage.json and the frames, described
    as a research object (RO-Crate 1.1). Per well what was meant and what happened: sources,
    volumes, tips, verdict, who decided. All runs, if none is named.
    """
    if lineage:
        _export_lineage(out, run or [], data)
        return
    from ..worldmodel.exporting import export_runs
    from .progress import StageBar

    empty_folder(out)
    with StageBar() as shown:
        told = export_runs(_folder(data), out, run or (), tip_finder(boxes), shown)
    written = counted(told.written, "trajectory", "trajectories")
    echo(
        f"{out}: {written} of {counted(told.runs, 'run')}, {told.failures} of them failures, "
        f"{told.left_out} left out. The labels are verdicts, not truth."
    )


@runs.command()
def verify(
    run: Annotated[str, typer.Argument(help="Which run; all, and their list, if left out.")] = "",
    data: DataFolder = None,
    key: Annotated[
        list[str] | None,
        typer.Option(help="Public key that may have signed, beside the folder's own. Repeatable."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON array.")] = False,
) -> None:
    """Say whether a record was changed after the sidecar wrote it. Offline; nothing is written.

    Exit code 0: each run is as it was written, or was removed by retention. 1: something was
    changed, added, removed or reordered, or nothing can be said of the run, as it is older than
    the chains. Who holds the sidecar's key can sign anew: note the last hash elsewhere.
    """
    from ..sidecar.store.signing import public_key
    from ..sidecar.store.verifying import verify_runs

    store = open_data(data)
    try:
        own = public_key(store.folder)
    except StoreError as error:
        if not key:
            raise
        own = None
        echo(f"Only the keys named by --key count: {one_line(error)}", err=True)
    named = {one.strip().lower() for one in key or ()}
    if garbled := [one for one in named if not re.fullmatch("[0-9a-f]{64}", one)]:
        raise ConfigurationError(f"--key {garbled[0]}: a public key has 64 hexadecimal digits.")
    keys = named | ({own} if own else set())
    found = verify_runs(store, keys, [run] if run else [])
    if run and found[-1].state == "unchained":
        known_run(store, run)
    if as_json:
        echo(json.dumps([asdict(one) for one in found], ensure_ascii=False, indent=1))
    else:
        for line in _verified(found, store):
            echo(line)
    judged = found[-1:] if run else [one for one in found if one.state != "unchained"]
    sound = bool(judged) and all(one.state in ("sound", "removed") for one in judged)
    own_list = all(one.state != "tampered" for one in found)
    raise typer.Exit(0 if sound and own_list else 1)


@runs.command()
def trends(
    data: DataFolder = None,
    most: Annotated[int, typer.Option(min=1, help="How many of the newest runs.")] = 40,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON array.")] = False,
) -> None:
    """Say how failures, waits, leftovers and sharpness went over the runs, and what has changed.

    Per robot, pipette, liquid, and label of the tip rack (its lot, if the protocol says so).
    Nothing is said of a group with fewer than five runs.
    """
    from ..sidecar.trends import trends_of

    store = open_data(data)
    known_run(store, "")
    found = trends_of(store, most)
    if as_json:
        told = [{**asdict(one), "group": one.group._asdict()} for one in found]
        echo(json.dumps(told, ensure_ascii=False, indent=1))
        return
    for one in found:
        echo(one_line(", ".join(name for name in one.group if name not in ("", "-"))))
        for point in one.points:
            left = "-" if point.left_percent is None else f"{point.left_percent:.1f} %"
            begun = time.strftime("%Y-%m-%d %H:%M", time.localtime(point.at))
            echo(
                f"  {begun}  {point.failed} of {point.wells} failed, {point.undecided} undecided, "
                f"wait {point.hold_s:.1f} s, left {left}, sharpness {point.sharpness or '-'}  "
                f"{one_line(point.run)}"
            )
        for drift in one.drifts:
            echo(f"  CHANGED: {drift}")
    if not found:
        echo(f"{store.folder}: no well was judged yet.")


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
    sums = ("wells", "deliveries")
    states = ", ".join(f"{n} {state}" for state, n in counts.items() if state not in sums)
    several = counts["deliveries"] != counts["wells"]
    by = f" by {counted(counts['deliveries'], 'delivery', 'deliveries')}" if several else ""
    lines = [first, f"{counted(counts['wells'], 'well')}{by} on {account['frames']} "
             f"frames: {states or 'none judged'}"]  # fmt: skip
    if ended and ended["detail"]:
        lines.append(str(ended["detail"]))
    for well in account["wells"]:
        if well["trajectory"] in account["flagged"]:
            lines.append(f"  {well['well']}: {well['state']}. {well['reason'] or ''}".rstrip())
    for one in account["incidents"]:
        lines.append(f"  {one['kind']}: {one['text']}")
    return lines


def _export_lineage(out: Path, runs: list[str], data: Path | None) -> None:
    from ..sidecar.lineage import write_lineage
    from ..sidecar.store.frames import folder_name

    store = open_data(data)
    names = [known_run(store, name) for name in runs]
    known_run(store, "")  # an empty store is said to be empty
    empty_folder(out)
    for name in names or [str(row["run"]) for row in store.runs()]:
        folder = out / folder_name(name)
        try:
            wells = write_lineage(store, name, folder)
        except OSError as error:
            raise ConfigurationError(f"{folder} cannot be written: {error.strerror}.") from None
        echo(f"{folder}: {counted(wells, 'well')} of run {one_line(name)}.")


def _verified(found: list[VerifiedRun], store: Store) -> Iterator[str]:
    if not found:
        yield f"{store.folder}: no run was kept yet."
    for one in found:
        name = one_line(repr(one.run) if one.run else "The list of runs")
        if one.state == "unchained":
            yield f"{name}: has no chain. It is older than the chains, so nothing can be said."
        elif one.state == "removed":
            yield f"{name}: {one.notes[0]}; nothing of it is left."
        elif one.state == "tampered":
            yield f"{name}: NOT as it was written."
        else:
            ended = "" if one.closed or not one.run else "; the run has not ended"
            yield f"{name}: as it was written ({counted(one.entries, 'entry', 'entries')}{ended})."
        for tampering in one.found:
            yield f"  {tampering.what}: {one_line(tampering.where)}"
        for note in one.notes if one.state != "removed" else ():
            yield f"  note: {one_line(note)}"
        if one.head:
            yield f"  last hash {one.head}, signed by key {one.key or '(none)'}"


def _folder(data: Path | None) -> Path:
    from ..sidecar import SidecarConfig
    from ..sidecar.token_file import known_token

    return SidecarConfig.load(find_token=known_token).data if data is None else data


def open_data(data: Path | None, alone: bool = False) -> Store:
    """The store in a folder, or in the sidecar's usual one."""
    from ..sidecar.store.opening import open_store

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
