"""Gates: the second look that confirms or rejects a flagged well."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from ..vocabulary import FailureType, Gate, KeyframeKind, Outcome, Route
from .measuring import ColumnReading
from .types import TrajectorySample

RUN_ALARM = 3e-4
"""Of a hundred normal wells, three in a hundred runs have one that looks more unusual."""


@dataclass(frozen=True)
class Case:
    """What a gate gets to see of one well.

    Attributes:
        sample: Frames, detections and expected volumes.
        route: Why it is asked.
        score: Anomaly score; ``None`` if none could be computed.
        readings: Liquid columns by keyframe; a keyframe that could not be read is left out.
        missing: Keyframes in which no tip was found.
        calibrated: Whether readings rest on this run's own normal wells.
        p_value: How often a normal well of this run looks this unusual, if the scorer can tell.
        alarm_p: A well that looks more unusual than this is not passed for want of proof: it is
            left to the operator. In a run of a hundred wells it has to be small; on a plate of
            few wells, of which one is known to be normal, the scorer's own threshold serves.
        clearly_absent: Whether nothing like this run's tips is in the frames without one.
        signs: What the scorer found, by sign, nats; empty if it cannot say.
        normal: A normal well of this run, to compare with.
    """

    sample: TrajectorySample
    route: Route
    score: float | None = None
    readings: Mapping[KeyframeKind, ColumnReading] = field(default_factory=dict)
    missing: tuple[KeyframeKind, ...] = ()
    calibrated: bool = True
    p_value: float | None = None
    alarm_p: float = RUN_ALARM
    clearly_absent: bool = True
    signs: Mapping[str, float] = field(default_factory=dict)
    normal: TrajectorySample | None = None

    @property
    def alarming(self) -> bool:
        """Whether the well looks too unusual to pass without proof."""
        return self.p_value is not None and self.p_value < self.alarm_p


@dataclass(frozen=True)
class GateDecision:
    """What a gate says. ``UNDECIDED`` passes the case on to the next gate."""

    outcome: Outcome
    gate: Gate
    reason: str
    failure: FailureType | None = None
    measured_ul: float | None = None
    expected_ul: float | None = None


class ConfirmingGate(Protocol):
    """Anything that can confirm or reject a flagged well: volumes, a VLM, a person."""

    gate: Gate

    def examine(self, case: Case) -> GateDecision:
        """Judge one case. Must not raise for a case that it cannot judge: ``UNDECIDED``."""


class OperatorGate:
    """A person decides: the robot pauses, and the page shows the frames."""

    gate = Gate.OPERATOR

    def examine(self, case: Case) -> GateDecision:
        return GateDecision(
            Outcome.UNDECIDED, self.gate, "No gate could settle this well; please look at it."
        )


def examine_in_turn(gates: Sequence[ConfirmingGate], case: Case) -> GateDecision:
    """Ask the gates one after another until one decides.

    If none does, the last one's answer stands, with the first one's reason and readings.
    """
    decisions: list[GateDecision] = []
    for gate in gates:
        decision = gate.examine(case)
        if decision.outcome is not Outcome.UNDECIDED:
            return decision
        decisions.append(decision)
    if not decisions:
        return GateDecision(Outcome.UNDECIDED, Gate.NONE, "No gate is configured.")
    first, last = decisions[0], decisions[-1]
    reason = in_sentences(first.reason, last.reason)
    return GateDecision(
        Outcome.UNDECIDED, last.gate, reason, None, first.measured_ul, first.expected_ul
    )


def in_sentences(*reasons: str) -> str:
    """Reasons one after another; what a later one says again is said once."""
    later = [" ".join(reasons[number + 1 :]) for number in range(len(reasons))]
    return " ".join(
        said for said, rest in zip(reasons, later, strict=True) if said and said not in rest
    )
