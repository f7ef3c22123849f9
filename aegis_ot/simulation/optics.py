"""A pinhole camera over the deck: mm to px, and px back to a tip's own plane."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .session import SessionParameters

Floats = NDArray[np.float64]
Point = tuple[float, float, float]


class Pinhole:
    """Projection of one session's camera.

    Pixel coordinates follow :mod:`aegis_ot.vision.types`: the centre of the first pixel is
    ``(0.5, 0.5)``.
    """

    def __init__(self, parameters: SessionParameters) -> None:
        self.eye = np.array(parameters.eye, dtype=float)
        forward = np.array(parameters.look, dtype=float) - self.eye
        forward /= np.linalg.norm(forward)
        right = np.cross(forward, (0.0, 0.0, 1.0))
        right /= np.linalg.norm(right)
        down = np.cross(forward, right)
        self.level_right = right
        roll = np.radians(parameters.roll_deg)
        cos, sin = np.cos(roll), np.sin(roll)
        axes = np.stack([cos * right + sin * down, cos * down - sin * right, forward])
        width, height = parameters.size
        focal = parameters.focal_px
        intrinsic = np.array([[focal, 0, width / 2], [0, focal, height / 2], [0, 0, 1.0]])
        self.matrix: Floats = intrinsic @ axes
        self.forward = forward

    def project(self, points: Floats | list[Point]) -> Floats:
        """Points of shape ``(n, 3)`` in mm to pixels of shape ``(n, 2)``."""
        seen = (np.asarray(points, dtype=float) - self.eye) @ self.matrix.T
        return np.asarray(seen[:, :2] / np.maximum(seen[:, 2:], 1e-6))

    def plane(self, origin: Point, tilt_deg: float) -> Floats:
        """Homography from ``(across, along)`` in mm to pixels, shape ``(3, 3)``.

        The plane holds the axis of a tip that ends at ``origin`` and leans ``tilt_deg`` to the
        right, and faces the camera.
        """
        tilt = np.radians(tilt_deg)
        up = np.array([0.0, 0.0, 1.0])
        along = np.cos(tilt) * up + np.sin(tilt) * self.level_right
        across = np.cos(tilt) * self.level_right - np.sin(tilt) * up
        basis = np.stack([across, along, np.asarray(origin) - self.eye], axis=1)
        return np.asarray(self.matrix @ basis)


def on_plane(homography: Floats, across: float, along: float) -> tuple[float, float]:
    """One point of a tip's plane, mm, to pixels."""
    x, y, w = homography @ (across, along, 1.0)
    return float(x / w), float(y / w)
