"""Tip axes of rendered frames, from their boxes and the renderer's camera.

A data set gives boxes only. A rendered set's ``meta.json`` gives each plate's camera, and its
box is the bounding box of the upright cylinder around the tip (radius of the collar, length of
the tip). So the place of the tip in the room follows from the box, and the axis from its place.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class TipLabel:
    """Where the tip is in a frame, as the network learns it, px.

    Attributes:
        collar, orifice: Upper and lower end of the tip axis (x, y).
        radius: Half the tip's greatest width.
        beside: The other tips of a multi-channel pipette.
    """

    collar: tuple[float, float]
    orifice: tuple[float, float]
    radius: float
    beside: tuple[TipLabel, ...] = ()

    @property
    def length(self) -> float:
        """Length of the axis, px."""
        return float(np.hypot(self.orifice[0] - self.collar[0], self.orifice[1] - self.collar[1]))

    def mapped(self, scale_x: float, scale_y: float, dx: float, dy: float) -> TipLabel:
        """The label after ``x -> x * scale_x + dx``, ``y -> y * scale_y + dy``."""
        return TipLabel(
            (self.collar[0] * scale_x + dx, self.collar[1] * scale_y + dy),
            (self.orifice[0] * scale_x + dx, self.orifice[1] * scale_y + dy),
            self.radius * abs(scale_x),
            tuple(tip.mapped(scale_x, scale_y, dx, dy) for tip in self.beside),
        )


@dataclass(frozen=True)
class PlateCamera:
    """A pinhole camera: world in mm, z up; image in px."""

    eye: Vector
    right: Vector
    up: Vector
    forward: Vector
    focal: float
    size: tuple[int, int]

    @classmethod
    def from_meta(cls, plate: Mapping[str, Any]) -> PlateCamera:
        """Camera of one entry of ``plates`` in a rendered set's ``meta.json``."""
        eye = np.asarray(plate["eye"], dtype=np.float64)
        forward = np.asarray(plate["look"], dtype=np.float64) - eye
        forward /= np.linalg.norm(forward)
        right = np.cross(forward, [0.0, 0.0, 1.0])
        right /= np.linalg.norm(right)
        up = np.cross(right, forward)
        roll = np.deg2rad(-float(plate["roll"]))
        right, up = (
            right * np.cos(roll) + up * np.sin(roll),
            up * np.cos(roll) - right * np.sin(roll),
        )
        width, height = (int(v) for v in plate["size"])
        focal = width / 2 / np.tan(np.deg2rad(float(plate["fov"])) / 2)
        return cls(eye, right, up, forward, float(focal), (width, height))

    def project(self, points: Vector) -> Vector:
        """Image coordinates, shape ``(n, 2)``, of world points, shape ``(n, 3)``."""
        rays = points - self.eye
        depth = rays @ self.forward
        return np.stack(
            [
                self.size[0] / 2 + self.focal * (rays @ self.right) / depth,
                self.size[1] / 2 - self.focal * (rays @ self.up) / depth,
            ],
            axis=-1,
        )

    def lift(self, x: float, y: float, depth: float) -> Vector:
        """World point seen at ``(x, y)`` at the given depth, mm."""
        sideways = self.right * ((x - self.size[0] / 2) / self.focal)
        upwards = self.up * (-(y - self.size[1] / 2) / self.focal)
        point: Vector = self.eye + depth * (self.forward + sideways + upwards)
        return point


_ANGLES = np.linspace(0, 2 * np.pi, 32, endpoint=False)
_RING = np.stack([np.cos(_ANGLES), np.sin(_ANGLES), np.zeros_like(_ANGLES)], axis=-1)


def _cylinder_box(camera: PlateCamera, foot: Vector, radius: float, length: float) -> Vector:
    ring = _RING * radius + foot
    points = camera.project(np.concatenate([ring, ring + np.array([0.0, 0.0, length])]))
    low = points.min(axis=0)
    return np.concatenate([low, points.max(axis=0) - low])


def _place(camera: PlateCamera, box: Vector, radius: float, length: float) -> tuple[Vector, float]:
    """Foot of the tip, mm, and the largest misfit of its box, px."""
    x, y, w, h = box
    start = camera.lift(x + w / 2, y + h, camera.focal * length / h)
    fit = least_squares(
        lambda foot: _cylinder_box(camera, foot, radius, length) - box,
        start,
        xtol=1e-10,
        ftol=1e-12,
    )
    return fit.x, float(np.abs(fit.fun).max())


def rendered_labels(
    cameras: Sequence[PlateCamera], boxes: NDArray[np.float64], fit_on: int = 24
) -> list[TipLabel]:
    """Axes of tips of one kind from their boxes.

    The ratio of radius to length is the same for all tips of a set; it is found by fitting a
    few boxes (the absolute size is not seen by one camera, and not needed).

    Args:
        cameras: Camera of each frame.
        boxes: ``x, y, w, h`` of each frame, px, shape ``(n, 4)``.
        fit_on: Number of boxes that the ratio is found from.
    """
    length = 100.0
    chosen = np.unique(np.linspace(0, len(boxes) - 1, min(fit_on, len(boxes))).astype(int))

    def misfit(ratio: float) -> float:
        return float(
            np.median([_place(cameras[i], boxes[i], ratio * length, length)[1] for i in chosen])
        )

    ratios = np.linspace(0.03, 0.1, 15)
    best = float(ratios[int(np.argmin([misfit(float(r)) for r in ratios]))])
    fine = np.linspace(best - 0.005, best + 0.005, 11)
    radius = float(fine[int(np.argmin([misfit(float(r)) for r in fine]))]) * length
    labels = []
    rise = np.array([0.0, 0.0, length])
    for camera, box in zip(cameras, boxes, strict=True):
        foot, _ = _place(camera, box, radius, length)
        orifice, collar, side = camera.project(
            np.stack([foot, foot + rise, foot + rise + camera.right * radius])
        )
        labels.append(
            TipLabel(
                (float(collar[0]), float(collar[1])),
                (float(orifice[0]), float(orifice[1])),
                float(np.hypot(*(side - collar))),
            )
        )
    return labels
