"""``aegis-ot corpus``: Layer 1 over a shelf of protocols, and what changed since last time."""

from __future__ import annotations

import statistics
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer
from rich.progress import TimeRemainingColumn

from ..errors import ConfigurationError
from ..vocabulary import counted
from ..workbench import Project, configurations_of
from ..workbench.baseline import read_baseline
from ..workbench.call_settings import settings_of
from ..workbench.corpus import check_corpus
from ..workbench.corpus_changes import VerdictChange, changes
from ..workbench.corpus_table import (
    CRASHED,
    CorpusRow,
    Results,
    Told,
    findings_path,
    read_results,
    summary_path,
    write_summary,
)
from ..workbench.shelf import Shelved, find_protocols
from ..workbench.shelf import sample as drawn
from ..workbench.side_by_side import processors
from .engines import InstallEngines, install_for_files
from .exit_codes import BROKEN, CLEAN, FINDINGS
from .options import Labware, Rules, Timeout, one_of
from .plain_text import echo
from .printing import PlainConsole
from .progress import progress_bar

_FAILING = {"error": {"fail"}, "warning": {"fail", "warn"}, "never": set[str]()}
"""Verdicts that end with exit code 1, by ``--fail-on``."""

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
    labware: Labware = None,
    timeout: Timeout = None,
    jobs: Annotated[
        int | None,
        typer.Option("--jobs", "-j", min=1, help="Protocols at a time (one per processor)."),
    ] = None,
    fail_on: Annotated[
        str, typer.Option("--fail-on", help="error, warning or never: what ends with exit code 1.")
    ] = "never",
    install_engines: InstallEngines = False,
) -> None:
    """Judge every protocol below some folders, and keep what came of each in a table.

    Each is judged where it lies, by its project's settings. Custom labware definitions are found
    in the same repository, and get_values of Opentrons' protocol library reads the fields.json
    beside the protocol. An interrupted run goes on where it was; a rerun judges what has changed.

    Exit codes: 0 done, 1 something changed since --against or is found that --fail-on names, 2 the
    call is wrong, or with --fail-on a protocol could not be judged.
    """
    one_of("--fail-on", fail_on, _FAILING)
    before = read_results(_there(against)) if against else {}
    protocols = find_protocols(folders)
    if not protocols:
        raise ConfigurationError("There is no protocol below these folders.")
    if sample is not None:
        protocols = drawn(protocols, folders, sample)
    if install_engines:
        install_for_files([shelved.path for shelved in protocols])
    projects = list(_projects(protocols, folders, rules, labware, timeout))
    with _CorpusProgress(len(protocols)) as shown:
        after = check_corpus(protocols, folders, out, projects, jobs or processors(), shown.done)
    rows = [row for row, _ in after.values()]
    write_summary(out, rows)
    echo(summary(rows))
    echo(f"{out}; findings: {findings_path(out)}; summary: {summary_path(out)}")
    if against:
        changed = list(changes(before, after))
        echo(_compared(before, after, changed, against))
        if changed:
            raise typer.Exit(max(FINDINGS, _exit_code(rows, fail_on)))
    raise typer.Exit(_exit_code(rows, fail_on))


def _projects(
    protocols: Sequence[Shelved],
    folders: Sequence[Path],
    rules: list[Path] | None,
    labware: list[Path] | None,
    timeout: float | None,
) -> Iterator[Project]:
    """The protocols by how their projects want them judged; a faulty file is told before any is."""
    for configured, own in configurations_of([one.path for one in protocols], Path.cwd()):
        settings, rule_set = settings_of(configured, rules=rules, labware=labware, timeout=timeout)
        settings = replace(
            settings,
            baseline=read_baseline(Path(configured.baseline)) if configured.baseline else None,
            shelves=tuple(folders),
            definitions=lambda _: (),  # found with the protocols
        )
        yield Project(own, settings, rule_set)


def _exit_code(rows: Sequence[CorpusRow], fail_on: str) -> int:
    verdicts = {row.verdict for row in rows}
    if fail_on == "never":
        return CLEAN
    if verdicts & {"error", CRASHED}:
        return BROKEN
    return FINDINGS if verdicts & _FAILING[fail_on] else CLEAN


def _there(path: Path) -> Path:
    if not path.is_file():
        raise ConfigurationError(f"--against: there is no file {path}.")
    return path


class _CorpusProgress:
    """Progress on stderr: a bar with counts, and a line for each protocol that fails."""

    def __init__(self, total: int) -> None:
        console = PlainConsole(stderr=True, highlight=False, soft_wrap=True)
        self._counts: Counter[str] = Counter()
        self._bar = progress_bar(console, TimeRemainingColumn())
        self._task = self._bar.add_task("", total=total)

    def __enter__(self) -> _CorpusProgress:
        self._bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.stop()

    def done(self, row: CorpusRow, kept: bool) -> None:
        """Count a row; ``kept``: it stood in the table already."""
        self._counts["kept" if kept else row.verdict] += 1
        self._bar.update(self._task, description=_numbers(self._counts), advance=1)
        if row.verdict in _TELLING and not kept:
            line = f"{row.verdict:5}  {row.file}  {row.rules or row.reason}"
            self._bar.console.print(line, markup=False)


def summary(rows: Sequence[CorpusRow]) -> str:
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


def _compared(
    before: Results, after: Results, changed: Sequence[VerdictChange], against: Path
) -> str:
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


def _headline(change: VerdictChange) -> str:
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
