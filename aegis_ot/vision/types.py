"""The values that pass between the parts of the vision room.

Images are ``uint8`` arrays of shape ``(height, width, 3)``, channel order BGR, whole camera
frames. Pixel coordinates have their origin in the top-left corner of the whole frame, x to the
right, y down, and are floats: the centre of the first pixel is ``(0.5, 0.5)``.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Hashable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol, TypeVar, cast, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from ..vocabulary import KeyframeKind
from .tips import TipGeometry, is_flex, pipette_class, tip_for

Image = NDArray[np.uint8]
T = TypeVar("T")
Position = tuple[float, float, float]
"""A place on the deck, mm: x to the right, y away from the front, z up."""

FREE = (KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE)
"""Keyframes in which the tip hangs free above its well; in the others labware may hide it."""


@dataclass(frozen=True)
class TipDetection:
    """Where the pipette tip is in a frame.

    Attributes:
        x, y, w, h: Box of the whole tip, orifice to collar, px.
        confidence: 0 to 1.
        orifice: Lower end of the tip axis (x, y), px.
        collar: Upper end of the tip axis (x, y), px.
        apart: How far from it the next tip of its row hangs, px; ``None`` for a single one.
    """

    x: float
    y: float
    w: float
    h: float
    confidence: float
    orifice: tuple[float, float]
    collar: tuple[float, float]
    apart: float | None = None

    @property
    def length(self) -> float:
        """Length of the tip axis, px."""
        return float(np.hypot(self.orifice[0] - self.collar[0], self.orifice[1] - self.collar[1]))


class Detector(Protocol):
    """Finds the tip in a frame; ``None`` where there is none."""

    def detect(self, image: Image) -> TipDetection | None: ...


@runtime_checkable
class GuessingDetector(Detector, Protocol):
    """A detector that also says what it is not sure of."""

    def best_guess(self, image: Image) -> TipDetection | None:
        """The likeliest tip in a frame, however unlikely; its confidence says how likely."""


@dataclass(frozen=True)
class End:
    """A place in a frame that looks like one end of a tip: x and y, px, and how much, 0 to 1."""

    x: float
    y: float
    heat: float


@dataclass(frozen=True)
class Ends:
    """All that looks like the collar, and like the orifice, of a tip around one place."""

    collars: tuple[End, ...] = ()
    orifices: tuple[End, ...] = ()


Axis = tuple[tuple[float, float], tuple[float, float]]
"""Collar and orifice of a tip, px."""


@runtime_checkable
class RowDetector(Protocol):
    """A detector that shows several tips beside each other."""

    def detect(self, image: Image) -> TipDetection | None:
        """The tip that shows best."""

    def ends(self, image: Image, tip: TipDetection, reach: float) -> Ends:
        """The ends of the tips that stand up to ``reach`` px beside ``tip``."""

    def ends_of_length(self, image: Image, length: float) -> Ends:
        """All in the frame that looks like an end of a tip of about ``length`` px."""

    def ends_of_each(self, image: Image, axes: Sequence[Axis]) -> list[Ends]:
        """What looks like an end in a close-up of each place where a tip may hang."""


class Frames(dict[KeyframeKind, Image]):
    """The frames of one trajectory, and what was measured in each: with them it goes."""

    def __init__(self, frames: Mapping[KeyframeKind, Image] | None = None) -> None:
        super().__init__(frames or {})
        self.measured: dict[Hashable, Any] = {}

    def clear(self) -> None:
        """The frames are not needed any more."""
        super().clear()
        self.measured.clear()


@runtime_checkable
class PairedDetector(RowDetector, Protocol):
    """One that has another detector beside it, which sees some tips of a row that it does not."""

    @property
    def of_rows(self) -> RowDetector | None: ...


@dataclass(frozen=True)
class TrajectorySample:
    """One pipetting cycle as the vision room sees it.

    Attributes:
        id: Unique within its data set or run.
        plate: Unit of calibration: one camera pose, lighting and reagent (or one run).
        well: ``"A1"``.
        pipette: Short class, ``"p20"``, ``"p1000"``, or a Flex pipette's whole name.
        reagent: What the liquid is called, if known.
        volume_ul: Volume that the protocol commanded, µL.
        expected_ul: Liquid that should be in the tip at each keyframe, µL.
        frames: The four images.
        detections: The tip in each; ``None`` where no tip was found.
        label: ``"normal"``, ``"failure"``, or ``""`` when unknown.
        failure_type: As in the data set format; empty for normals.
        retained_fraction: Fraction of the volume left in the tip, if known.
        capacity_ul: Working volume of its tip, µL; ``None`` for the pipette's own size.
        tip_used: Which tip, where one served several wells; empty: one that served no other.
        positions: End of the tip on the deck (x, y, z) at each keyframe, mm, where it is known.
    """

    id: str
    plate: str
    well: str
    pipette: str
    volume_ul: float
    frames: Mapping[KeyframeKind, Image]
    detections: Mapping[KeyframeKind, TipDetection | None]
    expected_ul: Mapping[KeyframeKind, float]
    reagent: str = ""
    label: str = ""
    failure_type: str = ""
    retained_fraction: float | None = None
    capacity_ul: float | None = None
    tip_used: str = ""
    positions: Mapping[KeyframeKind, Position] = field(default_factory=dict)
    known: dict[str, Any] = field(default_factory=dict, init=False, repr=False, compare=False)
    """What was worked out of it before; see :meth:`once`."""

    def once(self, what: str, make: Callable[[], T]) -> T:
        """``make()``, computed once for this sample: many models are fitted on the same ones."""
        if what not in self.known:
            self.known[what] = make()
        return cast(T, self.known[what])

    @property
    def tip(self) -> TipGeometry:
        """The kind of tip that it was pipetted with."""
        return tip_for(self.pipette, self.capacity_ul)

    @property
    def tip_class(self) -> str:
        """What is learned by kind of tip is kept under it: ``"p20"``, or a Flex tip's name."""
        return self.tip.name if is_flex(self.pipette) else pipette_class(self.pipette)

    def learned_as(self, known: Container[str]) -> str:
        """Its tip class, or, where none of these is that, the OT-2's of its pipette's size."""
        return self.tip_class if self.tip_class in known else pipette_class(self.pipette)

    @property
    def lacks_tip(self) -> bool:
        """Whether no tip was found in a frame that shows one wherever there is one."""
        return any(self.detections.get(kind) is None for kind in FREE)


class Scorer(Protocol):
    """Fit on normal trajectories, gives each trajectory an anomaly score (higher is worse)."""

    name: str

    def fit(self, normals: Sequence[TrajectorySample]) -> None:
        """Learn what normal looks like. Raises :class:`ValueError` on an empty sequence."""

    def score(self, sample: TrajectorySample) -> float:
        """Anomaly score of one trajectory, in the scorer's own unit, >= 0."""


def is_image(image: object) -> bool:
    """Whether it is a frame that can be looked at at all."""
    return (
        isinstance(image, np.ndarray)
        and image.dtype == np.uint8
        and image.ndim == 3
        and image.shape[2] == 3
        and min(image.shape[:2]) >= 16
    )
