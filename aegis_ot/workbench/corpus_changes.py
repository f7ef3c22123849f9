"""What changed from one run over a corpus to the next, protocol by protocol."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

from .corpus_table import CorpusRow, Results, Told


@dataclass(frozen=True)
class VerdictChange:
    """A protocol that is judged in another way than before.

    Attributes:
        before: Its row then.
        after: Its row now.
        gone: Findings and undecided rules of then that are no more.
        come: Those that are new.
    """

    before: CorpusRow
    after: CorpusRow
    gone: tuple[Told, ...]
    come: tuple[Told, ...]


def changes(before: Results, after: Results) -> Iterator[VerdictChange]:
    """Protocols of both runs that differ in verdict, family, rules or findings; not in time."""
    for file, (row, told) in after.items():
        if file not in before:
            continue
        old_row, old_told = before[file]
        gone: tuple[Told, ...] = ()
        come: tuple[Told, ...] = ()
        if _on_file(old_row, old_told) and _on_file(row, told):
            gone, come = _without(old_told, told), _without(told, old_told)
        if gone or come or _essence(old_row) != _essence(row):
            yield VerdictChange(old_row, row, gone, come)


def _essence(row: CorpusRow) -> tuple[object, ...]:
    return row.verdict, row.family, row.rules, row.undecided, row.reason


def _on_file(row: CorpusRow, told: tuple[Told, ...]) -> bool:
    """Whether the findings that a row counts were kept beside it."""
    return bool(told) or not (row.findings or row.undecided)


def _without(these: tuple[Told, ...], those: tuple[Told, ...]) -> tuple[Told, ...]:
    left = Counter(map(_identity, those))
    rest = []
    for told in these:
        if left[_identity(told)] > 0:
            left[_identity(told)] -= 1
        else:
            rest.append(told)
    return tuple(rest)


def _identity(told: Told) -> tuple[object, ...]:
    """Of a finding all but its words; of an undecided rule also the reason."""
    reason = told.message if told.severity == "undecided" else ""
    return told.rule, told.severity, tuple(sorted(told.wells)), tuple(sorted(told.lines)), reason
