"""``aegis-ot corpus``: Layer 1 over a shelf of protocols, and what changed since last time."""

from __future__ import annotations

import statistics
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from ..checking.corpus import CorpusSettings, check_corpus
from ..checking.corpus_changes import Change, changes
from ..checking.corpus_table import Results, Row, Told, findings_path, read_results
from ..checking.shelf import find_protocols
from ..checking.shelf import sample as drawn
from ..checking.side_by_side import processors
from ..errors import ConfigurationError
from ..preflight import load_database
from ..vocabulary import counted
from .exit_codes import CLEAN, FINDINGS
from .options import Rules
from .plain_text import echo
from .printing import PlainConsole

_TELLING = ("fail", "crash")
"""Verdicts that are told at once, while the others are counted."""


app = typer.Typer()


@app.command()
def corpus(
    folders: Annotated[list[Path], typer.Argument(help="Folders with protocols.")],
    out: Annotated[
        Path,
        typer.Option("--out", "-o", help="CSV table; its findings lie beside it as JSON lines."),
    ],
    against: Annotated[
        Path | None, typer.Option(help="An older table: say what changed, protocol by protocol.")
    ] = None,
    sample: Annotated[
        int | None,
        typer.Option(
            min=1, help="Only so many, drawn evenly over the folders; the same each time."
        ),
    ] = None,
    rules: Rules = None,
    timeout: Annotated[
        float, typer.Option(min=0.1, help="Longest rehearsal of one protocol, s.")
    ] = 60.0,
    jobs: Annotated[
        int | None,
        typer.Option("--jobs", "-j", min=1, help="Protocols at a time (one per processor)."),
    ] = None,
) -> None:
    """Judge every protocol below some folders, and keep what came of each in a table.

    Custom labware definitions are found below the same folders, and get_values of Opentrons'
    protocol library reads the fields.json beside the protocol. An interrupted run goes on where it
    was; a rerun judges what has changed. Settings of projects are not heard.

    Exit codes: 0 done, 1 something changed since --against, 2 the call is wrong.
    """
    load_database(rules or [])  # a faulty rule file is told before anything is done
    before = read_results(_there(against)) if against else {}
    protocols = find_protocols(folders)
    if not protocols:
        raise ConfigurationError("There is no protocol below these folders.")
    if sample is not None:
        protocols = drawn(protocols, folders, sample)
    settings = CorpusSettings(
        tuple(str(path.resolve()) for path in rules or ()), timeout, jobs or processors()
    )
    with _Shown(len(protocols)) as shown:
        after = check_corpus(protocols, folders, out, settings, shown.done)
    echo(summary([row for row, _ in after.values()]))
    echo(f"{out}; findings: {findings_path(out)}")
    if against:
        changed = list(changes(before, after))
        echo(_compared(before, after, changed, against))
        raise typer.Exit(FINDINGS if changed else CLEAN)


def _there(path: Path) -> Path:
    if not path.is_file():
        raise ConfigurationError(f"--against: there is no file {path}.")
    return path


class _Shown:
    """Progress on stderr: a bar with counts, and a line for each protocol that fails."""

    def __init__(self, total: int) -> None:
        console = PlainConsole(stderr=True, highlight=False, soft_wrap=True)
        self._counts: Counter[str] = Counter()
        self._bar = Progress(
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            TimeRemainingColumn(),
            console=console,
            transient=True,
        )
        self._task = self._bar.add_task("", total=total)

    def __enter__(self) -> _Shown:
        self._bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.stop()

    def done(self, row: Row, kept: bool) -> None:
        """Count a row; ``kept``: it stood in the table already."""
        self._counts["kept" if kept else row.verdict] += 1
        self._bar.update(self._task, description=_numbers(self._counts), advance=1)
        if row.verdict in _TELLING and not kept:
            line = f"{row.verdict:5}  {row.file}  {row.rules or row.reason}"
            self._bar.console.print(line, markup=False)


def summary(rows: Sequence[Row]) -> str:
    """Verdicts, broken rules, reasons and times of a corpus, in a few lines."""
    counts = Counter(row.verdict for row in rows)
    judged = [row for row in rows if row.verdict in ("pass", "warn", "fail")]
    lines = [f"{counted(len(rows), 'protocol')}: {_numbers(counts)}."]
    if judged:
        refused = counts["fail"] / len(judged)
        lines.append(f"Refused: {counts['fail']} of {len(judged)} judged ({refused:.1%}).")
        broken = Counter(part.partition("*")[0] for row in judged for part in row.rules.split())
        if broken:
            lines.append(f"Protocols by broken rule: {_numbers(broken)}.")
        lines += [
            _times("Rehearsal", [row.rehearsal_s for row in judged]),
            _times("Verdict", [row.verdict_s for row in judged]),
        ]
    reasons = Counter(row.reason for row in rows if row.reason)
    lines += [f"  {n} x {reason}" for reason, n in reasons.most_common(5) if n > 1]
    return "\n".join(lines)


def _numbers(counts: Counter[str]) -> str:
    return ", ".join(f"{name} {n}" for name, n in sorted(counts.items()))


def _times(what: str, seconds: Sequence[float]) -> str:
    ordered = sorted(seconds)
    late = ordered[min(len(ordered) - 1, int(0.95 * len(ordered)))]
    middle = statistics.median(ordered)
    return f"{what}: median {middle:.3f} s, 95th percentile {late:.3f} s, sum {sum(ordered):.0f} s."


def _compared(before: Results, after: Results, changed: Sequence[Change], against: Path) -> str:
    both = len(before.keys() & after.keys())
    lines = [f"Against {against}: {len(changed)} of {both} protocols changed."]
    if new := [file for file in after if file not in before]:
        lines.append(f"{counted(len(new), 'protocol is', 'protocols are')} new:")
        lines += [f"    {after[file][0].verdict} {file}" for file in new]
    if len(before) > both:
        lines.append(f"Not in this call, of those then: {counted(len(before) - both, 'protocol')}.")
    for change in changed:
        lines.append(_headline(change))
        lines += [f"    - {_in_words(told)}" for told in change.gone]
        lines += [f"    + {_in_words(told)}" for told in change.come]
    return "\n".join(lines)


def _headline(change: Change) -> str:
    before, after = change.before, change.after
    parts = [after.verdict]
    if before.verdict != after.verdict:
        parts = [f"{before.verdict} -> {after.verdict}"]
    if before.family != after.family:
        parts.append(f"family {before.family or 'none'} -> {after.family or 'none'}")
    if before.rules != after.rules:
        parts.append(f"{before.rules or 'no rule'} -> {after.rules or 'no rule'}")
    if before.undecided != after.undecided:
        parts.append(f"undecided {before.undecided or 'nothing'} -> {after.undecided or 'nothing'}")
    if before.reason != after.reason and after.reason:
        parts.append(after.reason)
    return f"{after.file}: {'; '.join(parts)}"


def _in_words(told: Told) -> str:
    wells = ", ".join(told.wells[:6]) + (" ..." if len(told.wells) > 6 else "")
    lines = ", ".join(map(str, told.lines))
    where = f" [{wells}; lines {lines}]" if wells or lines else ""
    return f"{told.rule} {told.severity}{where} {told.message}"
