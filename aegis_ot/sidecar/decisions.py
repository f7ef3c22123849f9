"""What the operator's decisions make of a verdict."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..run_view.overview import DecisionEntry
from ..vocabulary import ChannelOutcome, ChannelVerdict, Gate, Outcome, Verdict

_FLAGGED = (ChannelOutcome.FAIL, ChannelOutcome.UNDECIDED)


def effective(verdict: Verdict, decisions: Sequence[DecisionEntry]) -> Verdict:
    """The verdict as it stands after the operator's last decision."""
    if not decisions:
        return verdict
    last = decisions[-1]
    outcome = Outcome(last["outcome"])
    note = f": {last['note']}" if last["note"] else ""
    return replace(
        verdict,
        outcome=outcome,
        gate=Gate.OPERATOR,
        failure=verdict.failure if outcome is Outcome.FAIL else None,
        reason=f"{last['by']} decided {outcome.value}{note}. Before: {verdict.reason}".rstrip(),
        channels=_channels(verdict, outcome),
    )


def _channels(verdict: Verdict, outcome: Outcome) -> tuple[ChannelVerdict, ...]:
    """A decision is on the whole row: a pass on what was flagged, a fail on what was in doubt.

    Of a row that had passed, a fail is one of every tip that was seen; of all, where none was.
    """
    flagged = [c for c in verdict.channels if c.outcome in _FLAGGED]
    seen = [c for c in verdict.channels if c.outcome is ChannelOutcome.PASS]
    doubtful = [c for c in flagged if c.outcome is ChannelOutcome.UNDECIDED] or (
        [] if flagged else seen or list(verdict.channels)
    )
    changed = flagged if outcome is Outcome.PASS else doubtful
    decided = ChannelOutcome(outcome.value)
    return tuple(
        replace(
            channel, outcome=decided, failure=channel.failure if outcome is Outcome.FAIL else None
        )
        if channel in changed
        else channel
        for channel in verdict.channels
    )
