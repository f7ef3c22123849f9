"""``check --fix``: mends a protocol, and judges it again before a word of it is written."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..preflight import Report
from .mending import Mend, applied, mends_of
from .result import CheckedProtocol

_MOST = 20
"""Mends of one protocol; each costs a rehearsal."""


@dataclass(frozen=True)
class Fixed:
    """What came of mending one protocol.

    Attributes:
        text: The protocol's text with all that held.
        done: Mends that hold: judged again, the trouble is gone and no other has come.
        left: Mends that are the author's to choose.
        checked: The last verdict, on ``text``.
    """

    text: str
    done: tuple[Mend, ...]
    left: tuple[Mend, ...]
    checked: CheckedProtocol


def fix(text: str, checked: CheckedProtocol, judge: Callable[[str], CheckedProtocol]) -> Fixed:
    """Try every sure mend, one after another, and keep what mends.

    Args:
        text: The protocol's text.
        checked: The verdict on it.
        judge: Judges another text of the same protocol.
    """
    done: list[Mend] = []
    tried: set[tuple[str, str, int | None]] = set()
    while len(tried) < _MOST and checked.report is not None:
        mend = next(
            (m for m in mends_of(text, checked.report) if m.sure and _key(m) not in tried), None
        )
        if mend is None:
            break
        tried.add(_key(mend))
        mended = applied(text, mend.edits)
        again = judge(mended)
        if again.report is not None and _is_better(checked.report, again.report, mend):
            text, checked = mended, again
            done.append(mend)
    left: tuple[Mend, ...] = ()
    if checked.report is not None:
        left = tuple(m for m in mends_of(text, checked.report) if m.kind == "role")
    return Fixed(text, tuple(done), left, checked)


def _key(mend: Mend) -> tuple[str, str, int | None]:
    return mend.kind, mend.title, mend.line


def _is_better(before: Report, after: Report, mend: Mend) -> bool:
    """Whether less is found, nothing new is, and all that was decided still is."""
    if not set(_open(after)) <= set(_open(before)):
        return False
    if mend.kind == "role":
        gone = set(_open(before)) - set(_open(after))
        return gone.issuperset(mend.rules) and _findings(after) <= _findings(before)
    return _findings(after) < _findings(before)


def _open(report: Report) -> list[str]:
    return [one.rule for one in report.undecided]


def _findings(report: Report) -> set[tuple[str, frozenset[str]]]:
    """Each finding by its rule and wells: lines move with an edit."""
    return {(one.rule, frozenset(well.address for well in one.wells)) for one in report.findings}
