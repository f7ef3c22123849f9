"""What a gate gets to see of a well, and what it says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

from ...vocabulary import FailureType, Gate, KeyframeKind, Outcome, Route
from ..delivery import Delivery
from ..measuring import ColumnReading
from ..types import TrajectorySample

ALARM_P = 3e-4
"""A well that looks more unusual than this is not passed for want of proof. In a run of a hundred
wells it has to be small: three in a hundred runs have such a normal well."""

UNUSUAL_P, SEEMS_LEFT = 0.05, 2.0
"""Two weak signs of one thing are an alarm too: a well as unusual as one normal one in twenty, and
rows that speak so far for liquid left after the dispense, log-likelihood ratio. Of 480 normal
simulated wells and 67 rendered ones none had both."""


@dataclass(frozen=True)
class GateInput:
    """What a gate gets to see of one well.

    Attributes:
        sample: Frames, detections and expected volumes.
        route: Why it is asked.
        score: Anomaly score; ``None`` if none could be computed.
        readings: Liquid columns by keyframe; a keyframe that could not be read is left out.
        missing: Keyframes in which no tip was found.
        calibrated: Whether readings rest on this run's own normal wells.
        p_value: How often a normal well of this run looks this unusual, if the scorer can tell.
        clearly_absent: Whether nothing like this run's tips is in the frames without one.
        delivery: What the trajectory shows by itself of its delivery, in the light of the run's
            earlier wells; ``None`` if it was not looked at.
        signs: What the scorer found, by sign, nats; empty if it cannot say.
        normal: A normal well of this run, to compare with.
        tip_doubted: Whether the operator was asked before about liquid left in this very tip.
        near_band: Whether it is asked about because its score, inside the band, is near the end.
        beyond_lab: How far its readings are beyond the laboratory's own limit, log odds; 0 or less:
            they are not, or it has none. See :mod:`..lab_limits`.
    """

    sample: TrajectorySample
    route: Route
    score: float | None = None
    readings: Mapping[KeyframeKind, ColumnReading] = field(default_factory=dict)
    missing: tuple[KeyframeKind, ...] = ()
    calibrated: bool = True
    p_value: float | None = None
    clearly_absent: bool = True
    delivery: Delivery | None = None
    signs: Mapping[str, float] = field(default_factory=dict)
    normal: TrajectorySample | None = None
    tip_doubted: bool = False
    near_band: bool = False
    beyond_lab: float = 0.0

    @property
    def alarming(self) -> bool:
        """Whether the well looks too unusual to pass without proof."""
        unusual = self.p_value is not None and self.p_value < ALARM_P
        return self.seems_left or unusual or self.beyond_lab > 0

    @property
    def seems_left(self) -> bool:
        """Whether it looks unusual, and as if liquid were left, though not surely either."""
        after = self.readings.get(KeyframeKind.POST_DISPENSE)
        unusual = self.p_value is not None and self.p_value < UNUSUAL_P
        if after is None or not unusual or self.tip_doubted:
            return False
        return after.excess >= SEEMS_LEFT


@dataclass(frozen=True)
class Cost:
    """What asking took.

    Attributes:
        model: Who was asked.
        calls: How often.
        tokens_in, tokens_out: Read and written.
        amount: In ``currency``; ``None`` if the model has no price here.
        currency: ``"USD"``.
        seconds: From question to answer.
    """

    model: str
    calls: int = 1
    tokens_in: int = 0
    tokens_out: int = 0
    amount: float | None = None
    currency: str = "USD"
    seconds: float = 0.0


@dataclass(frozen=True)
class GateDecision:
    """What a gate says. ``UNDECIDED`` passes the case on to the next gate.

    Attributes:
        outcome: Its word.
        gate: Which gate it was.
        reason: One sentence for the operator.
        failure: What went wrong, for a fail.
        measured_ul, expected_ul: Left in the tip, µL, where it was measured.
        costs: Of all that was asked, one entry for each model.
        trouble: Why a model gave no answer at all, where it should have.
    """

    outcome: Outcome
    gate: Gate
    reason: str
    failure: FailureType | None = None
    measured_ul: float | None = None
    expected_ul: float | None = None
    costs: tuple[Cost, ...] = ()
    trouble: str = ""


class ConfirmingGate(Protocol):
    """Anything that can confirm or reject a flagged well: volumes, a VLM, a person.

    Attributes:
        gate: Its name.
        screens: Whether it costs nothing and takes no time, so that it is asked about every well,
            before anybody knows whether it is to be flagged.
    """

    gate: Gate
    screens: bool

    def examine(self, case: GateInput) -> GateDecision:
        """Judge one case. Must not raise for a case that it cannot judge: ``UNDECIDED``."""
