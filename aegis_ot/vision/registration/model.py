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

    @property
    def eye(self) -> Floats:
        """Where the camera stands on the deck, mm, shape ``(3,)``."""
        axes = self._axes()
        ray = np.array((self.x, self.y, 1.0))
        return np.asarray(self.pivot - axes.T @ ray * self.distance_mm)

    def depth(self, points: Floats) -> Floats:
        """Distance along the optical axis of points ``(n, 3)``, mm, shape ``(n,)``."""
        return self._in_camera(points)[:, 2]

    def project(self, points: Floats) -> Floats:
        """Points on the deck, mm, ``(n, 3)``, to pixels ``(n, 2)``; ``nan`` behind the camera."""
        seen = self._in_camera(points)
        depth = np.where(seen[:, 2:] > 1.0, seen[:, 2:], np.nan)
        plain = seen[:, :2] / depth * np.exp(self.log_focal)
        corner = 0.25 * (self.size[0] ** 2 + self.size[1] ** 2)
        bent = plain * (1.0 + self.distortion * (plain**2).sum(axis=1, keepdims=True) / corner)
        return np.asarray(bent + np.array(self.size) / 2.0)

    def _in_camera(self, points: Floats) -> Floats:
        """Right, down and forward of the camera, mm, ``(n, 3)``."""
        ray = np.array((self.x, self.y, 1.0)) * self.distance_mm
        return np.asarray((points - np.array(self.pivot)) @ self._axes().T + ray)

    def _axes(self) -> Floats:
        """Unit vectors right, down and forward in deck coordinates, in rows, ``(3, 3)``."""
        sin_a, cos_a = np.sin(self.azimuth), np.cos(self.azimuth)
        sin_e, cos_e = np.sin(self.elevation), np.cos(self.elevation)
        forward = np.array((cos_e * sin_a, cos_e * cos_a, -sin_e))
        right = np.array((cos_a, -sin_a, 0.0))
        down = np.cross(forward, right)
        sin_r, cos_r = np.sin(self.roll), np.cos(self.roll)
        return np.stack((cos_r * right + sin_r * down, cos_r * down - sin_r * right, forward))
