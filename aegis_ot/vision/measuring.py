"""What a column reader gets, and what it gives: liquid in the tip in µL."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from ..vocabulary import KeyframeKind
from .tips import TipGeometry
from .types import Image, TipDetection


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
        tested: How many normal tips of this run were read so before they were learned: what the
            uncertainties rest on.
    """

    volume_ul: float
    sigma_ul: float
    gap_ul: float = 0.0
    gap_sigma_ul: float = 0.0
    top: float = 0.0
    vague: bool = False
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
    """

    kind: KeyframeKind
    image: Image
    detection: TipDetection
    tip: TipGeometry
    expected_ul: float


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
