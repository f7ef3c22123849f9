"""What Layer 2 sees and says: keyframes of a trajectory, and the verdict on it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Final, NamedTuple

from .failures import FailureType
from .wells import WellRef


class KeyframeKind(str, Enum):
    """The four moments of a pipetting cycle at which the robot stands still for the camera."""

    ASPIRATE = "aspirate"
    TRANSIT = "transit"
    DISPENSE = "dispense"
    POST_DISPENSE = "post_dispense"


class Outcome(str, Enum):
    """The verdict on a trajectory. ``UNDECIDED``: flagged, and no gate could settle it."""

    PASS = "pass"
    FAIL = "fail"
    UNDECIDED = "undecided"


class Route(str, Enum):
    """Where triage sent a well (paper, "Real-time deployment")."""

    CALIBRATION = "calibration"
    SILENT_PASS = "silent_pass"
    GREY_ZONE = "grey_zone"
    BLANK_FLOOR = "blank_floor"
    UNCALIBRATED = "uncalibrated"
    ALWAYS_GATE = "always_gate"


class Gate(str, Enum):
    """Who confirmed or rejected a flagged well. What each is stands in :data:`GATE_TRAITS`."""

    NONE = "none"
    VOLUMETRIC = "volumetric"
    VLM = "vlm"
    OPERATOR = "operator"

    @property
    def traits(self) -> GateTraits:
        """What a gate of this kind is."""
        return GATE_TRAITS[self]


class GateTraits(NamedTuple):
    """What is to be known of a gate by whoever does not ask it.

    Attributes:
        does: What it did, in a sentence for a report.
        may_be_asked_for: Whether the settings may name it.
        measures: Whether its decision rests on a measured volume.
        is_model: Whether a model looked at the frames.
        is_person: Whether a person decided.
    """

    does: str
    may_be_asked_for: bool = False
    measures: bool = False
    is_model: bool = False
    is_person: bool = False


GATE_TRAITS: Final = {
    Gate.NONE: GateTraits(""),
    Gate.VOLUMETRIC: GateTraits(
        "The liquid column was measured against the volume that was drawn.",
        may_be_asked_for=True,
        measures=True,
    ),
    Gate.VLM: GateTraits(
        "A vision model looked at the frames.", may_be_asked_for=True, is_model=True
    ),
    Gate.OPERATOR: GateTraits("A person decided.", is_person=True),
}


@dataclass(frozen=True)
class Keyframe:
    """A trigger from the robot: it stands still now; grab a frame exposed after this.

    Attributes:
        run: Identifier of the run, chosen by the robot.
        sequence: Counts the keyframes of a run from 0; a resent one keeps its number.
        trajectory: Counts the trajectories of a run from 0.
        kind: Which of the four moments.
        pipette: Opentrons pipette name, ``"p1000_single_gen2"``.
        mount: ``"left"`` or ``"right"``.
        channels: Number of tips that take part.
        tip: Tip rack and tip, ``"1:A1"``; of the first channel.
        sources: Wells drawn from, one per channel (fewer where channels share a well).
        destinations: Wells delivered to, likewise; empty until known.
        commanded_ul: Volume per channel that this trajectory moves, µL.
        expected_ul: Liquid that should be in each tip now, µL, air left out.
        capacity_ul: Working volume of the tip, µL.
        reagent: What the liquid is called, if anything is known.
        position: Tip end on the deck (x, y, z), mm; ``None`` if unknown.
        robot_time: Seconds since the epoch on the robot's clock.
        robot_uptime: The same moment on the robot's clock that nobody can set, s; 0 if not told.
        line: Source line of the protocol that caused it.
        recovers: The failed trajectory of which this one is a recovery; ``None`` for the
            protocol's own.
        late: Sent after the robot had moved on (the link was down): the frame does not show the
            moment, and must not be judged as if it did.
        nozzles: The active nozzles in order, ``("A1", ..., "H1")``; empty for a single tip.
        targets: The well under each of them, ``None`` over no well; empty until known, and for a
            single tip.
        liquid_found: Whether the pipette's own pressure sensor found liquid in the one source well,
            with this tip, just before the draw; ``None`` where it was not asked.
        channels_found: Likewise for each nozzle, where they drew from several wells; ``None`` where
            nothing is known of its well. Empty for one source well, and where nothing is known.
    """

    run: str
    sequence: int
    trajectory: int
    kind: KeyframeKind
    pipette: str
    mount: str
    channels: int
    tip: str
    sources: tuple[WellRef, ...]
    destinations: tuple[WellRef, ...]
    commanded_ul: float
    expected_ul: float
    capacity_ul: float
    reagent: str | None = None
    position: tuple[float, float, float] | None = None
    robot_time: float = 0.0
    line: int | None = None
    late: bool = False
    recovers: int | None = None
    nozzles: tuple[str, ...] = ()
    targets: tuple[WellRef | None, ...] = ()
    liquid_found: bool | None = None
    channels_found: tuple[bool | None, ...] = ()
    robot_uptime: float = 0.0


class ChannelOutcome(str, Enum):
    """The verdict on one channel. ``UNOBSERVED``: the camera cannot see its tip: no pass."""

    PASS = "pass"
    FAIL = "fail"
    UNDECIDED = "undecided"
    UNOBSERVED = "unobserved"


@dataclass(frozen=True)
class ChannelVerdict:
    """The judgement on one channel of one trajectory.

    Attributes:
        nozzle: ``"A1"``, of the active nozzles.
        well: What it delivers into; ``None`` over no well.
        outcome: See :class:`ChannelOutcome`.
        failure: What went wrong, for a fail.
        reason: One sentence.
        measured_ul, expected_ul: Left in the tip after the dispense, µL, where it was measured.
    """

    nozzle: str
    well: WellRef | None
    outcome: ChannelOutcome
    failure: FailureType | None = None
    reason: str = ""
    measured_ul: float | None = None
    expected_ul: float | None = None

    @property
    def name(self) -> str:
        """The well's name, or the nozzle's where there is none."""
        return self.well.name if self.well is not None else f"nozzle {self.nozzle}"


@dataclass(frozen=True)
class Verdict:
    """The judgement on one trajectory.

    Attributes:
        run: Identifier of the run.
        trajectory: Number of the trajectory in the run.
        outcome: Pass, fail or undecided.
        route: Where triage sent it.
        score: The scorer's anomaly score (the scorer's own unit); ``None`` without frames.
        gate: Who settled it.
        failure: What went wrong, for a fail.
        reason: One sentence for the operator.
        measured_ul: What the volumetric gate read after the dispense, µL.
        expected_ul: What should have been left after the dispense, µL.
        left_ul: What the column in the emptied tip (POST_DISPENSE) measures, µL; ``None`` where it
            cannot be read.
        left_sigma_ul: Standard uncertainty of that, µL.
        channels: Of a multi-channel pipette, what each tip did, in the order of the nozzles; the
            rest of this verdict is that of the gravest one. Empty for a single tip.
    """

    run: str
    trajectory: int
    outcome: Outcome
    route: Route
    score: float | None = None
    gate: Gate = Gate.NONE
    failure: FailureType | None = None
    reason: str = ""
    measured_ul: float | None = None
    expected_ul: float | None = None
    left_ul: float | None = None
    left_sigma_ul: float | None = None
    channels: tuple[ChannelVerdict, ...] = ()

    @property
    def unobserved(self) -> bool:
        """Whether nobody saw any of the tips: then a pass says only that nothing holds."""
        if self.outcome is not Outcome.PASS or self.gate.traits.is_person:
            return False
        unseen = [one.outcome is ChannelOutcome.UNOBSERVED for one in self.channels]
        return bool(unseen) and all(unseen)
