"""What a person gets to see of each well, wherever it comes from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from ..vision.signs import Sign
from ..vocabulary import KeyframeKind

Box = tuple[float, float, float, float]
Point = tuple[float, float]
Axis = tuple[Point, Point]


@dataclass(frozen=True)
class Picture:
    """A part of a frame as JPEG.

    Attributes:
        jpeg: The image.
        x, y, w, h: The part of the frame that it shows, px of the whole frame.
    """

    jpeg: bytes
    x: float
    y: float
    w: float
    h: float


@dataclass(frozen=True)
class Level:
    """Liquid in the tip, as measured or as expected.

    Attributes:
        volume_ul: µL.
        sigma_ul: Standard uncertainty, µL; 0 for an expectation.
        air_ul: Air enclosed in it, µL.
        mark: Ends (x, y) of a line across the tip where the column ends, px of the whole frame;
            ``None`` where there is no column, or no tip.
    """

    volume_ul: float
    sigma_ul: float = 0.0
    air_ul: float = 0.0
    mark: tuple[Point, Point] | None = None


@dataclass(frozen=True)
class SeenFrame:
    """One keyframe of one well.

    Attributes:
        whole: The whole frame, small; ``None`` where pictures are left out.
        tip: The tip close up; ``None`` without a tip.
        box: Found box, x, y, w, h, px of the whole frame.
        confidence: Of the detection, 0 to 1.
        labelled: Labelled box, where the data set has one.
        axis: Orifice and collar, px.
        expected: What the protocol expects in the tip.
        measured: What was measured; ``None`` where it could not be.
        missing: Why there is no picture at all; empty if there is one.
    """

    whole: Picture | None = None
    tip: Picture | None = None
    box: Box | None = None
    confidence: float | None = None
    labelled: Box | None = None
    axis: tuple[Point, Point] | None = None
    expected: Level | None = None
    measured: Level | None = None
    missing: str = ""


@dataclass(frozen=True)
class SeenWell:
    """One well.

    Attributes:
        id: Unique on the page.
        group: The plate, or the run's pipette and liquid.
        well: ``"A1"``.
        title: Pipette, volume and reagent.
        outcome: ``"pass"``, ``"fail"``, ``"undecided"``, ``"calibration"`` or ``""``.
        route, gate: Where it was sent, and who settled it.
        failure: What the verdict says went wrong.
        reason: One sentence.
        truth: The label, ``"normal"`` or ``"partial_50, 48 % retained"``; empty where unknown.
        agreement: ``"caught"``, ``"missed"``, ``"false alarm"``, ``"passed"``, or empty.
        score: Anomaly score; ``None`` without.
        band: From where to where its score could pass silently; ``None`` without.
        signs: What speaks against the well, nats, the strongest first; empty for a scorer that
            names none.
        frames: By keyframe.
    """

    id: str
    group: str
    well: str
    title: str
    outcome: str
    route: str
    gate: str
    failure: str
    reason: str
    truth: str
    agreement: str
    score: float | None
    frames: Mapping[KeyframeKind, SeenFrame]
    signs: Sequence[tuple[Sign, float]] = ()
    band: tuple[float, float] | None = None

    @property
    def flagged(self) -> bool:
        return self.outcome in ("fail", "undecided")

    @property
    def pictured(self) -> bool:
        return any(frame.whole is not None for frame in self.frames.values())


@dataclass(frozen=True)
class Inspection:
    """A page's worth of wells.

    Attributes:
        title: Name of the data set, or of the run.
        source: ``"rendered"``, ``"synthetic"``, ``"real"``: on every result.
        facts: Name and value of what a reader should know.
        wells: In the order in which they were pipetted.
        scorer: Whose scores these are; empty without.
        notes: What else must be said.
    """

    title: str
    source: str
    facts: Sequence[tuple[str, str]]
    wells: Sequence[SeenWell]
    scorer: str = ""
    notes: Sequence[str] = field(default_factory=tuple)
