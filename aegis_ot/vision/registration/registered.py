"""A registered camera: where each tip must appear, and how surely."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..tips import TipGeometry
from ..types import Position, TipDetection
from .pinhole import POSE, CameraModel

Floats = NDArray[np.float64]

_SURE = 0.02
"""Standard error up to which a tip is measured where it must be, tip lengths."""


@dataclass(frozen=True)
class Sighting:
    """A tip that was seen while the robot said where its end is.

    Attributes:
        position: End of the tip on the deck (x, y, z), mm.
        tip: Kind of tip, as :data:`~aegis_ot.vision.tips.TIPS` names it.
        orifice, collar: Ends of its axis in the frame, px.
        hidden: Whether labware may hide the orifice, so that its place is a guess.
    """

    position: Position
    tip: str
    orifice: tuple[float, float]
    collar: tuple[float, float]
    hidden: bool = False


@dataclass(frozen=True)
class ProjectedTip:
    """Where a tip must appear.

    Attributes:
        orifice, collar: Ends of its axis, px.
        sigma_px: Standard error of the worse of both ends, px.
        px_per_mm: Scale along the tip.
    """

    orifice: tuple[float, float]
    collar: tuple[float, float]
    sigma_px: float
    px_per_mm: float

    @property
    def is_sure(self) -> bool:
        """Whether it may be measured there, though nothing is seen of it."""
        return self.sigma_px <= _SURE * float(np.hypot(*np.subtract(self.orifice, self.collar)))

    def lacking(self, size: tuple[int, int]) -> str:
        """What a frame of ``size`` (width, height, px) does not show of it: ``"upper end"``,
        ``"lower end"``, ``"tip"``, or nothing."""
        upper, lower = (
            not (0 <= x < size[0] and 0 <= y < size[1]) for x, y in (self.collar, self.orifice)
        )
        return "tip" if upper and lower else "upper end" if upper else "lower end" if lower else ""

    def as_detection(self, tip: TipGeometry) -> TipDetection:
        """As if a detector had found it there, with no confidence at all."""
        (x0, y0), (x1, y1) = self.collar, self.orifice
        half = self.px_per_mm * float(tip.outer_radius(tip.length_mm))
        left, right = min(x0, x1) - half, max(x0, x1) + half
        return TipDetection(
            left, y0, right - left, max(y1 - y0, 1.0), 0.0, self.orifice, self.collar
        )


@dataclass(frozen=True)
class Registration:
    """A camera whose pose is known from sightings; made by :func:`~.fitting.fit`.

    Attributes:
        camera: Pose and lens.
        lean: How far tips lean to the camera's right, radians.
        lengths_mm: Visible length of each kind of tip, mm: what the detector calls orifice and
            collar need not be what the maker's drawing does.
        covariance: Of pose and lens, lean, and the lengths in the order of ``lengths_mm``; shape
            ``(9 + n, 9 + n)``.
        residual_px: Median distance of the sightings' ends from where they are projected, px.
        sightings: How many it rests on.
        inliers: The share of their ends that agree with it.
    """

    camera: CameraModel
    lean: float
    lengths_mm: Mapping[str, float]
    covariance: Floats
    residual_px: float
    sightings: int
    inliers: float

    @property
    def parameters(self) -> Floats:
        """Pose and lens, lean, lengths; in the order of :attr:`covariance`."""
        return np.array([*self.camera.parameters, self.lean, *self.lengths_mm.values()])

    def project_tip(self, position: Position, tip: str) -> ProjectedTip | None:
        """Where a tip appears that ends at ``position`` (deck, mm).

        Returns:
            ``None`` for a kind of tip that was never seen, and behind the camera.
        """
        if tip not in self.lengths_mm:
            return None
        names = tuple(self.lengths_mm)
        place, kind = np.array([position]), np.array([names.index(tip)])
        here = self.parameters
        ends, slopes = with_slopes(
            lambda parameters: project_ends(self.camera, parameters, place, kind), here
        )
        ends = ends[0]
        if not np.isfinite(ends).all():
            return None
        slopes = slopes.reshape(4, -1)
        spread = slopes @ self.covariance @ slopes.T
        worst = max(float(np.linalg.eigvalsh(spread[i : i + 2, i : i + 2])[-1]) for i in (0, 2))
        orifice, collar = ends
        length = float(np.hypot(*(orifice - collar)))
        return ProjectedTip(
            (float(orifice[0]), float(orifice[1])),
            (float(collar[0]), float(collar[1])),
            float(np.sqrt(max(worst, 0.0))),
            length / self.lengths_mm[tip],
        )


def project_ends(
    camera: CameraModel, parameters: Floats, places: Floats, kinds: NDArray[np.intp]
) -> Floats:
    """Both ends of tips as they appear.

    Args:
        camera: Gives frame size and pivot.
        parameters: As in :attr:`Registration.parameters`, ``(..., 9 + k)``.
        places: Where the tips end on the deck, mm, ``(n, 3)``.
        kinds: Number of each tip's kind, ``(n,)``.

    Returns:
        Orifice and collar of each, px, ``(..., n, 2, 2)``.
    """
    azimuth, lean = parameters[..., 0, None, None], parameters[..., POSE, None, None]
    lengths = parameters[..., POSE + 1 :][..., kinds][..., None]
    right = np.concatenate((np.cos(azimuth), -np.sin(azimuth), 0.0 * azimuth), axis=-1)
    axis = np.cos(lean) * np.array((0.0, 0.0, 1.0)) + np.sin(lean) * right
    tops = places + lengths * axis
    points = np.concatenate((np.broadcast_to(places, tops.shape), tops), axis=-2)
    seen = camera.project(points, parameters[..., :POSE])
    return np.stack((seen[..., : len(places), :], seen[..., len(places) :, :]), axis=-2)


def with_slopes(function: Callable[[Floats], Floats], here: Floats) -> tuple[Floats, Floats]:
    """A function's value at ``here``, ``(p,)``, and its forward differences, in one call.

    Args:
        function: Takes ``(m, p)`` and gives ``(m, ...)``.

    Returns:
        Value ``(...)`` and slopes ``(..., p)``.
    """
    steps = np.maximum(1e-5, 1e-5 * np.abs(here))
    values = function(np.concatenate((here[None], here + np.diag(steps))))
    return values[0], np.moveaxis(values[1:] - values[0], 0, -1) / steps
