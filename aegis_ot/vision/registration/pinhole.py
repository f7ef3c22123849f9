"""A pinhole camera beside the deck: deck coordinates in mm to pixels.

Deck coordinates are the robot's: x to the right along the front, y away from the front, z up. The
principal point is the middle of the frame; one term of radial distortion (Brown, 1966) is fitted.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

POSE = 8
"""Parameters before the tip lengths; see :class:`CameraModel`."""


@dataclass(frozen=True)
class CameraModel:
    """One camera's pose and lens.

    Attributes:
        size: Frame width and height, px.
        pivot: Point on the deck about which the pose is written down, mm: the middle of the places
            that were seen, so that the parameters are nearly independent.
        azimuth: Direction in which the camera stands, radians: 0 in front of the deck, positive
            to its left.
        elevation: Angle by which it looks down, radians.
        log_distance: Logarithm of its distance from the pivot, mm.
        roll: Rotation about its optical axis, radians.
        x, y: Where the pivot appears, in focal lengths right and down of the frame's middle.
        log_focal: Logarithm of the focal length in px.
        distortion: Radial distortion at the corner of the frame, as a fraction.
    """

    size: tuple[int, int]
    pivot: tuple[float, float, float]
    azimuth: float
    elevation: float
    log_distance: float
    roll: float
    x: float
    y: float
    log_focal: float
    distortion: float = 0.0

    @property
    def parameters(self) -> Floats:
        """All that is fitted, shape ``(8,)``."""
        return np.array(
            (
                *(self.azimuth, self.elevation, self.log_distance, self.roll),
                *(self.x, self.y, self.log_focal, self.distortion),
            )
        )

    def moved_to(self, parameters: Floats) -> CameraModel:
        """The same frame and pivot with other parameters, shape ``(8,)``."""
        return CameraModel(self.size, self.pivot, *(float(value) for value in parameters))

    @property
    def distance_mm(self) -> float:
        """From the pivot, mm."""
        return float(np.exp(self.log_distance))

    def depth(self, points: Floats) -> Floats:
        """Distance along the optical axis of points ``(n, 3)``, mm, shape ``(n,)``."""
        return _in_camera(self.parameters, points - np.array(self.pivot))[:, 2]

    def project(self, points: Floats, parameters: Floats | None = None) -> Floats:
        """Points on the deck, mm, ``(..., n, 3)``, to pixels ``(..., n, 2)``; ``nan`` behind the
        camera. ``parameters``, ``(..., 8)``: other poses and lenses, all in one go."""
        here = self.parameters if parameters is None else parameters
        seen = _in_camera(here, points - np.array(self.pivot))
        depth = np.where(seen[..., 2:] > 1.0, seen[..., 2:], np.nan)
        focal, distortion = np.exp(here[..., 6, None, None]), here[..., 7, None, None]
        plain = seen[..., :2] / depth * focal
        corner = 0.25 * (self.size[0] ** 2 + self.size[1] ** 2)
        bent = plain * (1.0 + distortion * (plain**2).sum(axis=-1, keepdims=True) / corner)
        return np.asarray(bent + np.array(self.size) / 2.0)


def _in_camera(parameters: Floats, points: Floats) -> Floats:
    """Right, down and forward of the camera, mm, ``(..., n, 3)``, of points about the pivot."""
    x, y = parameters[..., 4], parameters[..., 5]
    ray = np.stack((x, y, np.ones_like(x)), axis=-1) * np.exp(parameters[..., 2, None])
    return np.asarray(points @ np.swapaxes(_axes(parameters), -1, -2) + ray[..., None, :])


def _axes(parameters: Floats) -> Floats:
    """Unit vectors right, down and forward in deck coordinates, in rows, ``(..., 3, 3)``."""
    azimuth, elevation, roll = (parameters[..., i] for i in (0, 1, 3))
    sin_a, cos_a = np.sin(azimuth), np.cos(azimuth)
    sin_e, cos_e = np.sin(elevation), np.cos(elevation)
    forward = np.stack((cos_e * sin_a, cos_e * cos_a, -sin_e), axis=-1)
    right = np.stack((cos_a, -sin_a, np.zeros_like(cos_a)), axis=-1)
    down = np.cross(forward, right)
    sin_r, cos_r = np.sin(roll)[..., None], np.cos(roll)[..., None]
    turned = (cos_r * right + sin_r * down, cos_r * down - sin_r * right, forward)
    return np.stack(turned, axis=-2)
