"""Judges every protocol of a shelf, and keeps what came of each as soon as it is known."""

from __future__ import annotations

import contextlib
import dataclasses
import hashlib
import json
import threading
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from ..preflight import RuleSet
from ..preflight.rule_set import shipped_rules
from ..vocabulary import one_line
from .corpus_table import CRASHED, SKIPPED, CorpusRow, CorpusTable, Results, Told, read_results
from .engines import EngineMissing, engine_for, need_of
from .projects import Project
from .result import CheckedProtocol, Problem
from .run import check_file
from .shelf import Shelved
from .side_by_side import LazyRehearser, check_each
from .surroundings import data_named

_LONGEST_REASON = 500


def check_corpus(
    protocols: Sequence[Shelved],
    folders: Sequence[Path],
    table: Path,
    projects: Sequence[Project],
    jobs: int = 1,
    done: Callable[[CorpusRow, bool], None] = lambda row, kept: None,
) -> Results:
    """Judge protocols, each in a process of its own, and add a row of each to a table.

    A protocol whose row is there already is not judged again, as long as neither it, nor what
    lies beside it, nor what judges it has changed. Rows of other protocols stay as they are, but
    for those of files that are gone from these folders.

    Args:
        protocols: Of the shelf.
        folders: Where the shelf was looked for.
        table: The CSV file; see :mod:`.corpus_table`.
        projects: How to judge: each of its own protocols, which together are all.
        jobs: How many to judge at a time.
        done: Told of each row, and whether it stood there already; from any thread, one at a time.

    Returns:
        What came of these protocols, in their order.

    Raises:
        ConfigurationError: The table cannot be read or written, or is something else.
        RehearsalError: The rehearsing process cannot be started.
    """
    by_file = {file: project for project in projects for file in project.files}
    digests = {id(project): _judge_digest(project) for project in projects}
    keys = {p.path.as_posix(): _key(p, digests[id(by_file[p.path])].copy()) for p in protocols}
    old = read_results(table) if table.exists() else {}
    results = {f: old[f] for f, key in keys.items() if f in old and old[f][0].key == key}
    others = [
        result
        for file, result in old.items()
        if file not in keys and (Path(file).exists() or not _is_below(file, folders))
    ]
    lock = threading.Lock()
    with CorpusTable(table, [*others, *results.values()]) as kept:
        for row, _ in results.values():
            done(row, True)

        def check(shelved: Shelved, lazy: LazyRehearser) -> None:
            file = shelved.path.as_posix()
            row, told = _judged(shelved, keys[file], by_file[shelved.path], lazy)
            with lock:
                if not lazy.cancelled.is_set():  # else it says nothing of the protocol
                    kept.append(row, told)
                    results[file] = row, told
                    done(row, False)

        left = [p for p in protocols if p.path.as_posix() not in results]
        check_each(left, jobs, projects[0].settings.rules, check)
    return {file: results[file] for file in keys}


def _is_below(file: str, folders: Sequence[Path]) -> bool:
    return any(Path(file).is_relative_to(folder) for folder in folders)


def _judged(
    shelved: Shelved, key: str, project: Project, lazy: LazyRehearser
) -> tuple[CorpusRow, tuple[Told, ...]]:
    file = shelved.path.as_posix()
    if shelved.skipped is not None:
        return _unjudged(file, SKIPPED, shelved.skipped, key), ()
    settings = dataclasses.replace(
        project.settings, labware={**shelved.labware, **project.settings.labware}
    )
    checked = check_file(shelved.path, settings, project.rule_set, lazy)
    if checked.problem is not None:
        return _unjudged(
            file, CRASHED if checked.problem.bug else "error", checked.problem, key
        ), ()
    return _row(checked, project.rule_set, key), tuple(_told(checked))


def _row(checked: CheckedProtocol, rule_set: RuleSet, key: str) -> CorpusRow:
    broken = Counter((finding.rule, finding.severity.value) for finding in checked.findings)
    states = checked.states(rule_set)
    listed = {
        word: " ".join(rule for rule, state in states.items() if state == word)
        for word in ("decided", "undecided", "not_applicable")
    }
    return CorpusRow(
        checked.file,
        checked.verdict.value,
        checked.family,
        " ".join(f"{rule}:{severity}*{n}" for (rule, severity), n in sorted(broken.items())),
        len(checked.findings),
        rehearsal_s=round(checked.rehearsal_s, 4),
        verdict_s=round(checked.verdict_s, 4),
        modules=" ".join(checked.modules.values()),
        key=key,
        **listed,
    )


def _unjudged(file: str, verdict: str, problem: Problem, key: str) -> CorpusRow:
    line = "" if problem.line is None else str(problem.line)
    reason = one_line(problem.message, _LONGEST_REASON)
    return CorpusRow(file, verdict, reason=reason, line=line, key=key)


def _told(checked: CheckedProtocol) -> Iterator[Told]:
    file = checked.file
    for finding in checked.findings:
        yield Told(
            file,
            finding.rule,
            finding.severity.value,
            tuple(well.address for well in finding.wells),
            finding.lines,
            finding.message,
            finding.fix,
        )
    for undecided in checked.undecided:
        yield Told(file, undecided.rule, "undecided", (), (), undecided.reason)


def _key(shelved: Shelved, digest: hashlib._Hash) -> str:
    """Changes with the protocol, what lies around it and what judges it (already in ``digest``)."""
    digest.update(shelved.text.encode("utf-8", "backslashreplace"))
    digest.update(json.dumps(shelved.labware, sort_keys=True).encode())
    digest.update(str(shelved.skipped).encode("utf-8", "backslashreplace"))
    with contextlib.suppress(EngineMissing):
        digest.update(engine_for(need_of(shelved.text)).version.encode())
    for file, text in sorted(shelved.around.texts.items()):
        digest.update(f"{file}\n{text}".encode("utf-8", "backslashreplace"))
    for file in data_named(shelved.path, shelved.text):
        with contextlib.suppress(OSError):
            digest.update(file.read_bytes())
    return digest.hexdigest()[:12]


def _judge_digest(project: Project) -> hashlib._Hash:
    """Of all that a verdict depends on, the protocol apart."""
    settings = project.settings
    told = (settings.options, settings.timeout_s, settings.waivers, str(settings.waiver_root))
    digest = hashlib.sha256(repr(told).encode("utf-8", "backslashreplace"))
    digest.update(json.dumps(settings.labware, sort_keys=True).encode())
    if settings.baseline is not None:
        digest.update(settings.baseline.path.read_bytes())
    package = Path(__file__).resolve().parents[1]
    sources = [package / room for room in ("adapters", "preflight")]
    for place in [*sources, shipped_rules(), *map(Path, settings.rules)]:
        files = [place] if place.is_file() else sorted(place.rglob("*.py"))
        for file in files or sorted(place.glob("*.json")):
            digest.update(file.read_bytes())
    return digest
