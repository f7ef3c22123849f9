"""A registered camera: where each tip must appear, and how surely."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .model import POSE, CameraModel

Floats = NDArray[np.float64]
Position = tuple[float, float, float]


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
        depth_mm: Distance from the camera along its axis, mm: which of two tips is in front.
    """

    orifice: tuple[float, float]
    collar: tuple[float, float]
    sigma_px: float
    px_per_mm: float
    depth_mm: float


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
        ends = project_ends(self.camera, here, place, kind)[0]
        if not np.isfinite(ends).all():
            return None
        steps = np.maximum(1e-5, 1e-5 * np.abs(here))
        slopes = np.stack(
            [
                (project_ends(self.camera, here + step, place, kind)[0] - ends).ravel() / size
                for step, size in zip(np.diag(steps), steps, strict=True)
            ],
            axis=1,
        )
        spread = slopes @ self.covariance @ slopes.T
        worst = max(float(np.linalg.eigvalsh(spread[i : i + 2, i : i + 2])[-1]) for i in (0, 2))
        orifice, collar = ends
        length = float(np.hypot(*(orifice - collar)))
        return ProjectedTip(
            (float(orifice[0]), float(orifice[1])),
            (float(collar[0]), float(collar[1])),
            float(np.sqrt(max(worst, 0.0))),
            length / self.lengths_mm[tip],
            float(self.camera.depth(place)[0]),
        )


def project_ends(
    camera: CameraModel, parameters: Floats, places: Floats, kinds: NDArray[np.intp]
) -> Floats:
    """Both ends of tips as they appear.

    Args:
        camera: Gives frame size and pivot.
        parameters: As in :attr:`Registration.parameters`, ``(9 + k,)``.
        places: Where the tips end on the deck, mm, ``(n, 3)``.
        kinds: Number of each tip's kind, ``(n,)``.

    Returns:
        Orifice and collar of each, px, ``(n, 2, 2)``.
    """
    model = camera.moved_to(parameters[:POSE])
    lean, lengths = parameters[POSE], parameters[POSE + 1 :][kinds]
    right = np.array((np.cos(model.azimuth), -np.sin(model.azimuth), 0.0))
    axis = np.cos(lean) * np.array((0.0, 0.0, 1.0)) + np.sin(lean) * right
    tops = places + lengths[:, None] * axis
    seen = model.project(np.concatenate((places, tops)))
    return np.stack((seen[: len(places)], seen[len(places) :]), axis=1)
