"""One frame, one column: where it ends, and what breaks it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..tips import TipGeometry
from ..types import Image, TipDetection
from .alone import alone
from .axis import clarities, rectify
from .breaks import strongest_break
from .evidence import (
    ELSEWHERE,
    IMPOSSIBLE,
    DyeColour,
    EmptyColour,
    Strengths,
    colour_evidence,
    colour_steps,
    edge_evidence,
    step_evidence,
)
from .profile import INSIDE, TipProfile, tip_profile, unroll
from .strip import SHAPES, Array, Strip, TipShape, resample

_SHORTEST = (0.08, 9.0)
"""Shortest column that is looked for, tip lengths and px: the orifice's own rim glints."""


@dataclass(frozen=True)
class Reference:
    """What is known about this run's tips beforehand; every part may be missing.

    Attributes:
        dye: Colour of a full column of this reagent.
        empty: Colour that an empty tip shows of itself.
        height_scale: How high columns stand in the frame, over what the geometry says: it is
            not published (see :mod:`~aegis_ot.vision.tips`), and the camera looks at an angle.
        height_sd: Standard deviation of where a meniscus stands, tip lengths.
    """

    dye: DyeColour | None = None
    empty: EmptyColour = field(default_factory=EmptyColour)
    height_scale: float = 1.0
    height_sd: float = 0.08


@dataclass(frozen=True)
class ColumnEnd:
    """Where the liquid column of one frame ends.

    Attributes:
        presence: Largest log-likelihood ratio of one: above about 5 there is a column, below 0
            there is none to see.
        top: Upper meniscus, u (0 collar, 1 orifice); 1 where there is no column.
        gap: Strength of the strongest break in it, however weak; ``None`` where none can be told.
    """

    presence: float
    top: float
    gap: float | None


_MEASURED = {"ot2_1000": "p1000", "ot2_300": "p300", "ot2_200": "p300"}


def shape_of(tip: TipGeometry) -> TipShape:
    """Outline of a kind of tip."""
    if tip.name.startswith("ot2_"):
        return SHAPES[_MEASURED.get(tip.name, "p20")]
    return _of_geometry(tip, 240 if tip.nominal_ul >= 500 else 160)


def shapes_of(tip: TipGeometry) -> tuple[TipShape, ...]:
    """Outlines that a kind of tip may have.

    Makers differ: some of an OT-2's smaller tips taper straight, others have a narrow lower part,
    as the geometry has it. By the wrong outline a tip is laid beside its place.
    """
    shape = shape_of(tip)
    if tip.name == "ot2_1000" or not tip.name.startswith("ot2_"):
        return (shape,)
    return shape, _of_geometry(tip, shape.rows)


def _of_geometry(tip: TipGeometry, rows: int) -> TipShape:
    collar = (max(tip.profile[-1][1], tip.nozzle_radius_mm) + tip.wall_mm) / tip.length_mm
    return TipShape(
        tip.name,
        rows,
        collar,
        (tip.profile[0][1] + tip.wall_mm) / tip.length_mm,
        tip.overlap_mm / tip.length_mm,
        tuple(
            (1.0 - height / tip.length_mm, (radius + tip.wall_mm) / tip.length_mm)
            for height, radius in reversed(tip.profile[1:-1])
        ),
    )


@dataclass(frozen=True)
class TipLook:
    """What is kept of one frame: enough for every scorer, without the frame.

    Attributes:
        profile: Signals along the tip.
        cone: ``(rows, lanes, 3)`` the tip with its outline made straight, see
            :func:`~.profile.unroll`.
        collar, orifice: Ends of the refined axis, px of the frame.
        shape: The outline by which it was laid straight.
        clarities: How well each of :func:`shapes_of` fits; empty where that is one, or was given.
    """

    profile: TipProfile
    cone: Array = field(repr=False)
    collar: tuple[float, float]
    orifice: tuple[float, float]
    shape: TipShape
    clarities: tuple[float, ...] = ()

    @property
    def washed_out(self) -> bool:
        """Whether the frame is overexposed, so that no colour or edge of the tip is left: what is
        beside the tip may be as white as it likes, and so may one of a dye's colours."""
        return float((self.cone[:, INSIDE].min(axis=2) >= 250).mean()) > 0.4


def look_at_tip(
    image: Image,
    detection: TipDetection,
    tip: TipGeometry,
    length: float | None = None,
    shape: TipShape | None = None,
) -> TipLook:
    """Straighten the tip and read its signals: all that takes time, done once per frame.

    ``length`` of the tip in px, and ``shape`` of its outline: where other frames of the trajectory
    show them better.
    """
    left, top = 0, 0
    if detection.apart is not None:
        image, detection, (left, top) = alone(image, detection, shape_of(tip))
    clear: tuple[float, ...] = ()
    if shape is None:
        shapes = shapes_of(tip)
        clear = clarities(image, detection, shapes) if len(shapes) > 1 else ()
        shape = shapes[int(np.argmax(clear))] if clear else shapes[0]
    strip = rectify(image, detection, shape, length=length)
    cone = unroll(strip, shape)
    collar, orifice = ((x + left, y + top) for x, y in (strip.collar, strip.orifice))
    return TipLook(tip_profile(strip, shape, cone), cone, collar, orifice, shape, clear)


def look_along(
    image: Image,
    detection: TipDetection,
    tip: TipGeometry,
    seen: TipLook,
    moved: tuple[float, float] = (0.0, 0.0),
) -> TipLook:
    """The tip laid straight by an axis that is known: of this frame, or of one at the same place.

    ``moved``: how far the tip hangs from there, px.
    """
    shape = seen.shape
    left, top = 0, 0
    if detection.apart is not None:
        image, _, (left, top) = alone(image, detection, shape_of(tip))
    there = np.subtract(moved, (left, top))
    collar, orifice = (np.add(end, there) for end in (seen.collar, seen.orifice))
    pixels, u, v = resample(image, collar, orifice, shape.rows, shape.half_width)
    upper, lower = ((float(x), float(y)) for x, y in (collar, orifice))
    strip = Strip(pixels, u, v, upper, lower, seen.profile.clarity)
    cone = unroll(strip, shape)
    upper, lower = ((x + left, y + top) for x, y in (upper, lower))
    return TipLook(tip_profile(strip, shape, cone), cone, upper, lower, shape)


def read_column(
    profile: TipProfile, tip: TipGeometry, expected_ul: float, reference: Reference
) -> ColumnEnd:
    """Find the column's end in the signals of one frame.

    Args:
        profile: The signals.
        tip: Geometry of the tip.
        expected_ul: Liquid that should be in it, µL: where to look first. 0: anything.
        reference: What is known of this run.
    """
    evidence = column_evidence(profile, tip, reference)
    ranked = evidence
    if expected_ul > 0:
        evidence = evidence + step_evidence(profile)
        off = profile.u - expected_top(tip, expected_ul, reference)
        ranked = evidence - np.minimum(0.5 * (off / max(reference.height_sd, 0.01)) ** 2, 12.0)
    row = int(np.argmax(ranked))
    presence = float(evidence[row])
    if presence <= 0:
        return ColumnEnd(presence, 1.0, None)
    top = _summit(profile.u, ranked, row)
    return ColumnEnd(presence, top, strongest_break(profile, top))


def column_evidence(profile: TipProfile, tip: TipGeometry, reference: Reference) -> Array:
    """Ratio from colour and edges for a column that ends at each row."""
    ratio = tip_colour_evidence(profile, tip, reference) + edge_evidence(profile)
    return np.where(possible_tops(profile, tip), ratio, IMPOSSIBLE).astype(np.float32)


def tip_colour_evidence(
    profile: TipProfile,
    tip: TipGeometry,
    reference: Reference,
    strengths: Strengths = ELSEWHERE,
) -> Array:
    """Ratio from colour alone."""
    return colour_evidence(
        profile, reference.dye, reference.empty, top=ceiling(tip), strengths=strengths
    )


def possible_tops(profile: TipProfile, tip: TipGeometry) -> NDArray[np.bool_]:
    """Rows at which a column can end and be seen to: below the nozzle, above the orifice."""
    lowest = 1.0 - max(_SHORTEST[0], _SHORTEST[1] / max(profile.length, 1.0))
    return np.asarray((profile.u > ceiling(tip) + 0.02) & (profile.u < lowest))


def expected_top(tip: TipGeometry, volume_ul: float, reference: Reference) -> float:
    """Where the meniscus of a volume should stand, u."""
    height = float(tip.height_of(volume_ul))
    return 1.0 - reference.height_scale * height / tip.length_mm


def ceiling(tip: TipGeometry) -> float:
    """Where the free bore begins: a little below the nozzle, u."""
    return tip.overlap_mm / tip.length_mm + 0.06


def _summit(u: Array, ranked: Array, row: int) -> float:
    """Mean of the posterior around its highest row, u."""
    near = slice(max(0, row - 6), row + 7)
    weight = np.exp(ranked[near].astype(np.float64) - float(ranked[row]))
    return float(weight @ u[near] / weight.sum())


def dye_at(profile: TipProfile, tip: TipGeometry, row: int, empty: EmptyColour) -> DyeColour:
    """Colour step at a row, less what an empty tip shows."""
    red, blue = colour_steps(profile, ceiling(tip), 0.97)
    sd = float(max(np.hypot(red.sd[row], empty.red_sd), np.hypot(blue.sd[row], empty.blue_sd)))
    return DyeColour(
        float(red.size[row]) - empty.red,
        float(blue.size[row]) - empty.blue,
        sd if np.isfinite(sd) else 1.0,
    )
