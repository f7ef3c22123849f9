"""What the operator's decisions make of a verdict."""

from __future__ import annotations

from typing import Any

from ..vocabulary import Gate, Outcome, Verdict


def effective(verdict: Verdict, decisions: list[dict[str, Any]]) -> Verdict:
    """The verdict as it stands after the operator's last decision."""
    if not decisions:
        return verdict
    last = decisions[-1]
    outcome = Outcome(last["outcome"])
    note = f": {last['note']}" if last["note"] else ""
    return Verdict(
        run=verdict.run,
        trajectory=verdict.trajectory,
        outcome=outcome,
        route=verdict.route,
        score=verdict.score,
        gate=Gate.OPERATOR,
        failure=verdict.failure if outcome is Outcome.FAIL else None,
        reason=f"{last['by']} decided {outcome.value}{note}. Before: {verdict.reason}".rstrip(),
        measured_ul=verdict.measured_ul,
        expected_ul=verdict.expected_ul,
        left_ul=verdict.left_ul,
        left_sigma_ul=verdict.left_sigma_ul,
    )
