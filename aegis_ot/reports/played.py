"""A rehearsal as a page plays it, with what was found marked at its steps."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from ..vocabulary import Finding, Site
from ..workbench.playback import marks_of


class Mark(NamedTuple):
    """What is marked: who found it, how bad it is, what it is, and where it happened."""

    rule: str
    severity: str
    text: str
    sites: Sequence[Site]


def mark_of(finding: Finding) -> Mark:
    """A finding of Layer 1."""
    return Mark(finding.rule, finding.severity.value, finding.message, finding.sites)


def played(
    playback: Mapping[str, Any] | None, marks: Iterable[Mark], lines: Sequence[str], unit: str
) -> dict[str, Any] | None:
    """All that the page's player takes, ``None`` where there is no rehearsal to play.

    Args:
        playback: See :func:`~aegis_ot.workbench.playback.playback_of`.
        marks: Those that fit no step are left out: the page tells of them elsewhere.
        lines: Of the protocol; those that steps name go along.
        unit: What their numbers count.
    """
    if playback is None or not playback["steps"]:
        return None
    found = [(mark, marks_of(playback, mark.sites)) for mark in marks]
    cited = {step[1] for step in playback["steps"] if step[1] is not None}
    return {
        **{key: value for key, value in playback.items() if key not in ("numbers", "places")},
        "marks": [
            {"rule": mark.rule, "severity": mark.severity, "text": mark.text, "steps": steps}
            for mark, steps in found
            if steps
        ],
        "lines": {n: lines[n - 1].strip()[:200] for n in sorted(cited) if 0 < n <= len(lines)},
        "unit": unit,
    }
