"""How a dry run is shown: a progress bar, the table of wells, the report."""

from __future__ import annotations

import contextlib
import threading
import webbrowser
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from rich.progress import Progress as Bar
from rich.table import Table
from rich.text import Text

from ..dryrun import DryRun, DryRunProgress, DryRunSettings, WellRow, dry_run
from ..preflight import Interpretation, load_rules
from ..preflight.check_protocol import summary
from ..preflight.source import source_lines
from ..reports.played import Mark, mark_of, played
from ..reports.run_html import run_report_html
from ..sidecar import Judged, make_analyser
from ..vocabulary import Outcome, Site, counted
from ..workbench.playback import playback_of
from .exit_codes import BROKEN, CLEAN, FINDINGS
from .paths import write_text
from .printing import PlainConsole
from .progress import progress_bar

console = PlainConsole(highlight=False)

_WIDE = 100
"""What the table of wells needs at most, columns."""

_MANY = 24
"""So many wells have a line each."""

_COLOURS = {Outcome.PASS: "green", Outcome.FAIL: "bold red", Outcome.UNDECIDED: "yellow"}


def run_and_show(script: Any, settings: DryRunSettings) -> DryRun:
    """Run with a progress bar and print the table of wells."""
    with progress_bar(console) as bar:
        analyser = make_analyser(settings.cascade)
        result = dry_run(script, settings, analyser, _CheckProgress(bar, script.file_name))
    show(result)
    return result


class _CheckProgress(DryRunProgress):
    def __init__(self, bar: Bar, name: str) -> None:
        self._bar = bar
        self._task = bar.add_task(f"Layer 1 checks {name}", total=None)

    def checked(self, report: Any) -> None:
        self._bar.update(self._task, description="Layer 1 done")

    def begin(self, wells: int) -> None:
        self._bar.update(self._task, description="Running, wells judged", total=wells)

    def judged(self, judged: Judged) -> None:
        self._bar.advance(self._task)

    def serves(self, address: str) -> None:
        console.print(f"Live page: {address}", markup=False, soft_wrap=True)
        webbrowser.open(address)

    def ended(self) -> None:
        self._bar.stop()
        console.print("The run is over; its page stays open until you press Ctrl-C.")
        with contextlib.suppress(KeyboardInterrupt):
            threading.Event().wait()


def show(result: DryRun) -> None:
    """Print a finished dry run."""
    if result.report is not None:
        console.print(Text(summary(result.report)))
    if result.outcome == "rejected":
        console.print(Text(result.detail, style="red"))
        console.print(f"{result.protocol}: rejected before anything moved.")
        return
    if result.wells:
        # Cells of a squeezed table say nothing: a narrow terminal wraps its lines instead.
        width = _WIDE if console.width < _WIDE else None
        console.print(_table(_worth_a_line(result), width), crop=False)
    else:
        console.print("It delivers no liquid: there is nothing to watch.", style="yellow")
    passed = sum(row.passed for row in result.wells)
    unseen = sum(row.unobserved for row in result.wells)
    recovered = sum(row.recovered for row in result.wells)
    right = f"{recovered} failed and put right, " if recovered else ""
    right += f"{unseen} not seen by the camera, " if unseen else ""
    console.print(
        f"{result.protocol}: {counted(len(result.wells), 'well')} watched on simulated frames, "
        f"{passed} passed, {right}{len(result.flagged)} flagged; run {result.outcome} "
        f"({result.seconds:.1f} s)."
    )
    for row in result.flagged:
        if row.outcome is Outcome.FAIL:
            console.print(Text(f"  {row.well}: {row.reason}", style=_COLOURS[Outcome.FAIL]))
    # One question is asked of many wells: it is told once.
    undecided: dict[str, list[str]] = {}
    for row in result.flagged:
        if row.outcome is not Outcome.FAIL:
            undecided.setdefault(row.reason or "No verdict came.", []).append(row.address)
    for reason, wells in undecided.items():
        console.print(Text(f"  {', '.join(wells)}: {reason}", style=_COLOURS[Outcome.UNDECIDED]))
    if result.outcome == "stopped":
        console.print(f"Paused: {result.detail}", style="bold", markup=False)
    elif result.detail:
        console.print(result.detail, style="red", markup=False)
    for note in result.notes:
        console.print(Text(note, style="yellow"))


def _worth_a_line(result: DryRun) -> Sequence[WellRow]:
    """All wells of a short run; of a long one those that did not simply pass, and its first."""
    if len(result.wells) <= _MANY:
        return result.wells
    return [row for row in result.wells if not row.passed or row is result.wells[0]]


def _table(rows: Sequence[WellRow], width: int | None = None) -> Table:
    table = Table(
        box=None,
        pad_edge=False,
        header_style="bold",
        width=width,
        caption="score: surprise, nats; wells of which no sign speaks share the lowest",
        caption_justify="left",
    )
    for heading, side in (
        ("#", "right"), ("well", "left"), ("µL", "right"), ("score", "right"),
        ("limit", "right"), ("p", "right"),
        ("route", "left"), ("gate", "left"),
        ("verdict", "left"), ("hold s", "right"),
    ):  # fmt: skip
        table.add_column(heading, justify=side, no_wrap=True)  # type: ignore[arg-type]
    for row in rows:
        verdict = row.outcome.value if row.outcome else "none"
        verdict = "unobserved" if row.unobserved else verdict
        failure = f" ({row.failure.value})" if row.failure else ""
        failure += ", put right" if row.recovered else ""
        table.add_row(
            str(row.trajectory),
            Text(row.address),
            f"{row.volume_ul:g}",
            *("-" if n is None else f"{n:.2g}" for n in (row.score, row.limit, row.p_value)),
            row.route.value if row.route else "-",
            row.gate.value,
            Text(verdict + failure, style=_COLOURS.get(row.outcome or Outcome.UNDECIDED, "")),
            f"{row.hold_s:.2f}",
        )
    return table


def write_report(path: Path, results: Sequence[DryRun]) -> None:
    """Write the HTML report, making its folder."""
    reported = [replace(one.reported, played=_played(one)) for one in results]
    page = run_report_html(reported, "aegis_ot, simulated")
    write_text(path, page)
    console.print(f"Report: {path}", markup=False, soft_wrap=True)


def _played(result: DryRun) -> dict[str, Any] | None:
    """Its rehearsal, with what Layer 1 found, and the wells that Layer 2 flagged."""
    if result.recording is None:
        return None
    reading = Interpretation(result.recording, load_rules())
    flagged = [
        Mark(
            "Layer 2",
            "error" if row.outcome is Outcome.FAIL else "warning",
            f"{row.address}: {row.reason or 'no verdict'}",
            [Site(row.line, ref) for ref in row.refs],
        )
        for row in result.flagged
    ]
    found = [mark_of(one) for one in result.report.findings] if result.report else []
    lines = source_lines(result.recording.text)
    return played(playback_of(reading, result.report), [*found, *flagged], lines, "line")


def exit_code(result: DryRun) -> int:
    """0 clean, 1 findings or flagged wells, 2 the run itself failed."""
    if result.outcome == "failed":
        return BROKEN
    if result.outcome != "succeeded" or result.flagged:
        return FINDINGS
    return CLEAN
