"""Judges every protocol of a shelf, and keeps what came of each as soon as it is known."""

from __future__ import annotations

import contextlib
import hashlib
import json
import threading
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from ..errors import ConfigurationError
from ..preflight import Options, Report
from ..preflight.database import shipped_rules
from ..preflight.rehearsal import Script
from ..vocabulary import one_line
from .corpus_table import CRASHED, SKIPPED, Results, Row, Table, Told, read_results
from .guard_arguments import guard_arguments
from .problems import with_helper
from .rehearser import Rehearser, TaskFailed
from .result import Problem
from .run import options_for
from .shelf import Shelved
from .side_by_side import LazyRehearser, check_each
from .tasks import Timed, TimedCheck

_LONGEST_REASON = 500


@dataclass(frozen=True)
class CorpusSettings:
    """How to judge a corpus.

    Attributes:
        rules: Files or folders of further rules.
        timeout_s: Longest rehearsal of one protocol, s.
        jobs: How many to judge at a time.
    """

    rules: tuple[str, ...] = ()
    timeout_s: float = 60.0
    jobs: int = 1


def check_corpus(
    protocols: Sequence[Shelved],
    folders: Sequence[Path],
    table: Path,
    settings: CorpusSettings,
    done: Callable[[Row, bool], None] = lambda row, kept: None,
) -> Results:
    """Judge protocols, each in a process of its own, and add a row of each to a table.

    A protocol whose row is there already is not judged again, as long as neither it, nor what
    lies beside it, nor what judges it has changed. Rows of other protocols stay as they are, but
    for those of files that are gone from these folders.

    Args:
        protocols: Of the shelf.
        folders: Where the shelf was looked for.
        table: The CSV file; see :mod:`.corpus_table`.
        settings: How to judge.
        done: Told of each row, and whether it stood there already; from any thread, one at a time.

    Returns:
        What came of these protocols, in their order.

    Raises:
        ConfigurationError: The table cannot be read or written, or is something else.
        RehearsalError: The rehearsing process cannot be started.
    """
    keys = dict(
        zip((p.path.as_posix() for p in protocols), _keys(protocols, settings), strict=True)
    )
    old = read_results(table) if table.exists() else {}
    results = {f: old[f] for f, key in keys.items() if f in old and old[f][0].key == key}
    others = [
        result
        for file, result in old.items()
        if file not in keys and (Path(file).exists() or not _is_below(file, folders))
    ]
    lock = threading.Lock()
    with Table(table, [*others, *results.values()]) as kept:
        for row, _ in results.values():
            done(row, True)

        def check(shelved: Shelved, lazy: LazyRehearser) -> None:
            file = shelved.path.as_posix()
            row, told = _judged(shelved, keys[file], settings, lazy)
            with lock:
                if not lazy.cancelled.is_set():  # else it says nothing of the protocol
                    kept.append(row, told)
                    results[file] = row, told
                    done(row, False)

        left = [p for p in protocols if p.path.as_posix() not in results]
        check_each(left, settings.jobs, settings.rules, check)
    return {file: results[file] for file in keys}


def _is_below(file: str, folders: Sequence[Path]) -> bool:
    return any(Path(file).is_relative_to(folder) for folder in folders)


def _judged(
    shelved: Shelved, key: str, settings: CorpusSettings, lazy: LazyRehearser
) -> tuple[Row, tuple[Told, ...]]:
    file = shelved.path.as_posix()
    if shelved.skipped is not None:
        return _unjudged(file, SKIPPED, shelved.skipped, key), ()
    script = Script(shelved.text, shelved.path.name, extra_labware=shelved.labware)
    try:
        options = options_for(guard_arguments(shelved.text), Options())
    except ConfigurationError as error:
        return _unjudged(file, "error", Problem(str(error)), key), ()
    rehearser: Rehearser = lazy.get()
    try:
        timed: Timed = rehearser.perform(
            TimedCheck(script, options, settings.rules, settings.timeout_s)
        )
    except TaskFailed as failed:
        problem = with_helper(failed.problem, shelved.path.parent)
        return _unjudged(file, CRASHED if problem.bug else "error", problem, key), ()
    told = tuple(_told(file, timed.report))
    return _row(file, timed, key), told


def _row(file: str, timed: Timed, key: str) -> Row:
    report = timed.report
    broken = Counter((finding.rule, finding.severity.value) for finding in report.findings)
    return Row(
        file,
        report.verdict.value,
        report.family,
        " ".join(f"{rule}:{severity}*{n}" for (rule, severity), n in sorted(broken.items())),
        len(report.findings),
        " ".join(dict.fromkeys(undecided.rule for undecided in report.undecided)),
        round(timed.rehearsal_s, 4),
        round(timed.verdict_s, 4),
        key=key,
    )


def _unjudged(file: str, verdict: str, problem: Problem, key: str) -> Row:
    line = "" if problem.line is None else str(problem.line)
    reason = one_line(problem.message, _LONGEST_REASON)
    return Row(file, verdict, reason=reason, line=line, key=key)


def _told(file: str, report: Report) -> Iterator[Told]:
    for finding in report.findings:
        yield Told(
            file,
            finding.rule,
            finding.severity.value,
            tuple(well.address for well in finding.wells),
            finding.lines,
            finding.message,
            finding.fix,
        )
    for undecided in report.undecided:
        yield Told(file, undecided.rule, "undecided", (), (), undecided.reason)


def _keys(protocols: Sequence[Shelved], settings: CorpusSettings) -> Iterator[str]:
    judge = _judge_digest(settings)
    for shelved in protocols:
        digest = judge.copy()
        digest.update(shelved.text.encode("utf-8", "backslashreplace"))
        digest.update(json.dumps(shelved.labware, sort_keys=True).encode())
        digest.update(str(shelved.skipped).encode("utf-8", "backslashreplace"))
        yield digest.hexdigest()[:12]


def _judge_digest(settings: CorpusSettings) -> hashlib._Hash:
    """Of all that a verdict depends on, the protocol apart."""
    digest = hashlib.sha256(str(settings.timeout_s).encode())
    package = Path(__file__).resolve().parents[1]
    sources = [package / room for room in ("instrumentation", "preflight")]
    for place in [*sources, shipped_rules(), *map(Path, settings.rules)]:
        files = [place] if place.is_file() else sorted(place.rglob("*.py"))
        for file in files or sorted(place.glob("*.json")):
            digest.update(file.read_bytes())
    with contextlib.suppress(PackageNotFoundError):
        digest.update(version("opentrons").encode())
    return digest
