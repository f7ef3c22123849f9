"""What a column reader gets, and what it gives: liquid in the tip in µL."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from ..vocabulary import KeyframeKind
from .column import TipShape
from .tips import TipGeometry
from .types import Image, TipDetection


@dataclass(frozen=True)
class SeenColumn:
    """A column that left the tip, by where its end is seen and not by where it should be.

    Its scale is what the run's own wells showed: an estimate, on which no verdict rests.

    Attributes:
        volume_ul: µL.
        sigma_ul: Standard uncertainty of it, µL.
        top: Its upper end as a fraction of the tip's length above the orifice.
    """

    volume_ul: float
    sigma_ul: float
    top: float


@dataclass(frozen=True)
class ColumnReading:
    """The liquid column in one frame.

    Attributes:
        volume_ul: Liquid in the tip, breaks left out, µL.
        sigma_ul: Standard uncertainty of it, µL.
        gap_ul: Air enclosed in the column, µL.
        gap_sigma_ul: Standard uncertainty of that, µL.
        top: Upper end of the column as a fraction of the tip's length above the orifice.
        vague: The tip looks empty, but so might a filled one: no proof either way.
        excess: How far the rows above the expected end speak for liquid there, log-likelihood
            ratio; 0: not at all. From 5 on it is believed, and the volume is what is seen; below
            that it is the expected one.
        seen: The column by its own end, where that shows and the run's scale is known.
        tested: How many normal tips of this run were read so before they were learned: what the
            uncertainties rest on.
    """

    volume_ul: float
    sigma_ul: float
    gap_ul: float = 0.0
    gap_sigma_ul: float = 0.0
    top: float = 0.0
    vague: bool = False
    excess: float = 0.0
    seen: SeenColumn | None = None
    tested: int = 0


@dataclass(frozen=True)
class TipView:
    """What a reader gets of one keyframe.

    Attributes:
        kind: Which keyframe.
        image: Whole frame.
        detection: The tip in it.
        tip: Its geometry.
        expected_ul: Liquid that should be in it, µL.
        shape: Its outline, once the run has shown which it is.
    """

    kind: KeyframeKind
    image: Image
    detection: TipDetection
    tip: TipGeometry
    expected_ul: float
    shape: TipShape | None = None


class ColumnReader(Protocol):
    """Measures the columns of one run; made anew for each run."""

    def look(self, view: TipView) -> object:
        """Extract what is needed from a frame, as soon as it arrives; frames are not kept."""

    def read(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> Mapping[KeyframeKind, ColumnReading]:
        """Readings of one trajectory; a keyframe that cannot be read is left out."""

    def learn(
        self, looks: Mapping[KeyframeKind, object], expected: Mapping[KeyframeKind, float]
    ) -> None:
        """This trajectory was normal: calibrate on it."""
