"""What is truly in a simulated frame, to the fraction of a pixel."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..vocabulary import KeyframeKind
from .optics import on_plane
from .reflections import column_edges
from .scene import SceneState, TipContent

Point = tuple[float, float]


@dataclass(frozen=True)
class TipTruth:
    """One tip as it stands in a frame, px.

    Attributes:
        channel: Number of the channel, 0 for ``A1``.
        box: ``(x, y, w, h)`` of the whole tip, orifice to collar, labware ignored and not
            clipped to the frame; ``None`` if there is no tip.
        orifice, collar: Ends of the tip's axis (without a tip: where they would be).
        column_bottom, column_top: Ends of the liquid on the axis; ``None`` without liquid.
        gaps: Air in the column, ``(bottom, top)`` on the axis.
        liquid_ul: What the tip holds in this frame, µL.
        hidden: Fraction of the tip's length that labware hides.
    """

    channel: int
    box: tuple[float, float, float, float] | None
    orifice: Point
    collar: Point
    column_bottom: Point | None
    column_top: Point | None
    gaps: tuple[tuple[Point, Point], ...]
    liquid_ul: float
    hidden: float


@dataclass(frozen=True)
class FrameTruth:
    """What is in a frame.

    Attributes:
        kind: Which keyframe.
        tips: Every channel's tip, channel 0 first.
        front: Number in ``tips`` of the tip nearest to the camera, which no other hides.
        dye: Name of the liquid.
        overexposed: Whether this is the frame that came out far too bright.
    """

    kind: KeyframeKind
    tips: tuple[TipTruth, ...]
    front: int
    dye: str
    overexposed: bool

    @property
    def tip(self) -> TipTruth:
        """The tip in front, the one a detector should find."""
        return self.tips[self.front]

    @property
    def box(self) -> tuple[float, float, float, float] | None:
        """Box of the tip in front; ``None`` without a tip."""
        return self.tip.box


def tip_truth(
    channel: int,
    plane: NDArray[np.float64],
    state: SceneState,
    content: TipContent,
    hidden_below: float,
) -> TipTruth:
    """One tip as the plane of its axis projects into the frame."""
    tip = state.tip
    radius = float(tip.outer_radius(tip.length_mm)) + 0.35 * tip.wall_mm
    foot = float(tip.outer_radius(0.0))
    outline = [(-radius, tip.length_mm), (radius, tip.length_mm), (-foot, 0.0), (foot, 0.0)]
    corners = np.array([on_plane(plane, a, b) for a, b in outline])
    (x0, y0), (x1, y1) = corners.min(axis=0), corners.max(axis=0)
    pieces = column_edges(tip, content)
    edges = [(on_plane(plane, 0, a), on_plane(plane, 0, b)) for a, b in pieces]
    return TipTruth(
        channel=channel,
        box=(float(x0), float(y0), float(x1 - x0), float(y1 - y0)) if content.present else None,
        orifice=on_plane(plane, 0, 0),
        collar=on_plane(plane, 0, tip.length_mm),
        column_bottom=edges[0][0] if edges else None,
        column_top=edges[-1][1] if edges else None,
        gaps=tuple((a[1], b[0]) for a, b in pairwise(edges)),
        liquid_ul=content.liquid_ul if content.present else 0.0,
        hidden=float(np.clip(hidden_below / tip.length_mm, 0.0, 1.0)),
    )
