"""From the verdicts on single tips to the one on their row."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ...vocabulary import (
    ChannelOutcome,
    ChannelVerdict,
    Gate,
    Keyframe,
    Outcome,
    Route,
    Verdict,
    WellRef,
    named_wells,
)
from ..gates import GateDecision
from ..pressure import weighed
from .finder import channel_keyframe

Judged = tuple[Verdict, Mapping[str, Any]]
_GRAVITY = (Outcome.FAIL, Outcome.UNDECIDED, Outcome.PASS)
_TOLD = 3
"""Channels whose own reasons are told; of more, the wells."""


@dataclass(frozen=True)
class Channel:
    """One nozzle of a judged row: its verdict, or why there is none.

    Attributes:
        nozzle, well: Which.
        judged: Of its tip alone; ``None`` without.
        hidden: Whether the camera cannot see it.
    """

    nozzle: str
    well: WellRef | None
    judged: Judged | None = None
    hidden: bool = False

    def verdict(self, trouble: str) -> ChannelVerdict:
        """What the row's verdict says of it."""
        if self.judged is None:
            outcome = ChannelOutcome.UNOBSERVED if self.hidden else ChannelOutcome.UNDECIDED
            reason = "Other tips hide this one." if self.hidden else trouble
            return ChannelVerdict(self.nozzle, self.well, outcome, reason=reason)
        one = self.judged[0]
        return ChannelVerdict(
            self.nozzle, self.well, ChannelOutcome(one.outcome.value), one.failure, one.reason,
            one.measured_ul, one.expected_ul,
        )  # fmt: skip


def row_verdict(
    keyframe: Keyframe, channels: Sequence[Channel], trouble: str, assumed: bool
) -> Judged:
    """The verdict on a row: the gravest tip's, with a word on every channel.

    Args:
        keyframe: Its last one.
        channels: In the order of the nozzles.
        trouble: Why the tips cannot be told apart; empty if they can.
        assumed: Whether nothing told which end of the row is the first channel.
    """
    each = tuple(
        _sensed(channel.verdict(trouble), channel_keyframe(keyframe, number))
        for number, channel in enumerate(channels)
    )
    judged = [channel.judged for channel in channels if channel.judged is not None]
    if all(channel.hidden for channel in channels):
        return _unseen(keyframe, each), {"channels": len(each), "tips_judged": 0}
    if not judged:
        reason = trouble or "No tip of this row is seen; please look at the tips."
        verdict = Verdict(
            keyframe.run, keyframe.trajectory, Outcome.UNDECIDED, Route.UNCALIBRATED,
            gate=Gate.OPERATOR, reason=reason, channels=each,
        )  # fmt: skip
        return verdict, {"channels": len(each), "tips_judged": 0}
    gravest, evidence = min(judged, key=lambda one: _rank(one[0]))
    if gravest.outcome is Outcome.PASS and _doubted(each):
        gravest = replace(gravest, outcome=Outcome.UNDECIDED, gate=Gate.OPERATOR)
    reason = _reason(each)
    if assumed and gravest.outcome is not Outcome.PASS:
        reason += (
            f" The row is seen squarely: {each[0].name} is taken to be on the left (set "
            "cascade.first_channel if it is not)."
        )
    route = gravest.route
    if gravest.outcome is Outcome.PASS and any(one.route is Route.CALIBRATION for one, _ in judged):
        route = Route.CALIBRATION
    lanes = {
        channel.nozzle: dict(channel.judged[1])
        for channel in channels
        if channel.judged is not None
    }
    verdict = replace(gravest, route=route, reason=reason, channels=each)
    return verdict, {
        **evidence, "channels": len(each), "tips_judged": len(judged), "lanes": lanes,
    }  # fmt: skip


def _unseen(keyframe: Keyframe, each: tuple[ChannelVerdict, ...]) -> Verdict:
    """On tips of which none is seen: the robot's own sensor may still have a word."""
    outcome, gate = Outcome.PASS, Gate.NONE
    reason = f"None of {len(each)} tips is seen apart from the others: nothing was judged."
    if _doubted(each):
        outcome, gate = Outcome.UNDECIDED, Gate.OPERATOR
        same = len({one.reason for one in each}) == 1
        reason = each[0].reason if same else " ".join([*_troubles(each), reason])
    return Verdict(
        keyframe.run, keyframe.trajectory, outcome, Route.UNCALIBRATED, gate=gate,
        reason=reason, channels=each,
    )  # fmt: skip


def _sensed(verdict: ChannelVerdict, keyframe: Keyframe) -> ChannelVerdict:
    """Of a tip that is not seen the robot's own sensor is the only witness."""
    if verdict.outcome is not ChannelOutcome.UNOBSERVED:
        return verdict
    said = weighed(GateDecision(Outcome.PASS, Gate.NONE, verdict.reason), keyframe, None)
    if said.outcome is Outcome.PASS:
        return verdict
    return replace(verdict, outcome=ChannelOutcome.UNDECIDED, reason=said.reason)


def _doubted(each: Sequence[ChannelVerdict]) -> bool:
    return any(one.outcome is ChannelOutcome.UNDECIDED for one in each)


def _rank(verdict: Verdict) -> tuple[int, float]:
    return _GRAVITY.index(verdict.outcome), -(verdict.score or 0.0)


def _reason(channels: Sequence[ChannelVerdict]) -> str:
    """``"B3: nothing left the tip. Not seen: C3 to H3 ..."``."""
    said = _troubles(channels)
    passed = [one for one in channels if one.outcome is ChannelOutcome.PASS]
    said.append(f"{len(passed)} of {len(channels)} tips passed.")
    unseen = [one for one in channels if one.outcome is ChannelOutcome.UNOBSERVED]
    if unseen:
        said.append(f"Not seen by the camera: {named_wells(unseen)}.")
    return " ".join(said)


def _troubles(channels: Sequence[ChannelVerdict]) -> list[str]:
    said = []
    for outcome in (ChannelOutcome.FAIL, ChannelOutcome.UNDECIDED):
        those = [one for one in channels if one.outcome is outcome]
        same: dict[str, list[ChannelVerdict]] = {}
        for one in those:
            same.setdefault(one.reason, []).append(one)
        for reason, ones in list(same.items())[:_TOLD]:
            said.append(f"{named_wells(ones)}: {reason or outcome.value}")
        rest = [one for ones in list(same.values())[_TOLD:] for one in ones]
        if rest:
            said.append(f"Likewise {outcome.value}: {named_wells(rest)}.")
    return said
