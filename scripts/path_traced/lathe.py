"""Surfaces of revolution: profiles about an axis, turned into triangles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
SEGMENTS = 48
"""Facets around the axis; normals are smooth."""
FLUTED = 96
"""The same where ribs run along it."""


@dataclass(frozen=True)
class Surface:
    """A triangle mesh in mm.

    Attributes:
        points: Vertices, shape ``(n, 3)``.
        normals: Outward unit normals, the same shape.
        faces: Indices of vertices, shape ``(m, 3)``.
        colour: One value per vertex and channel (R, G, B), shape ``(n, 3)``, or ``None``.
    """

    points: Floats
    normals: Floats
    faces: NDArray[np.uint32]
    colour: Floats | None = None


def turn(
    profile: Sequence[tuple[float, float]],
    colour: Floats | None = None,
    flutes: tuple[int, float, float] = (0, 0.0, 0.0),
) -> Surface:
    """A surface of revolution about z from ``(height, radius)`` pairs.

    Walked along the profile, the outside lies on the right hand of one who looks with the axis
    on the left: upwards along a wall the normals point away from the axis. Corners stay sharp:
    each stretch of the profile has vertices of its own where it bends by more than 30 degrees.

    Args:
        profile: Points in order, mm.
        colour: One (R, G, B) for each point of the profile, shape ``(len(profile), 3)``.
        flutes: Ribs along the wall: how many, their depth, and the height from which up, mm.
    """
    along, normal, tint = _split_at_corners(np.asarray(profile, dtype=float), colour)
    count, depth, above = flutes
    segments = FLUTED if count else SEGMENTS
    angle = np.linspace(0.0, 2 * np.pi, segments, endpoint=False)
    wave = depth * (along[:, 0] >= above)[:, None]
    radius = along[:, 1, None] - wave * (1 - np.cos(count * angle)) / 2
    slope = -wave * count * np.sin(count * angle) / 2
    # The normal of r(angle) is turned from the radius by the slope of the rib's flank.
    lean = np.arctan2(slope, np.maximum(radius, 1e-6))
    points = np.stack(
        [
            radius * np.cos(angle),
            radius * np.sin(angle),
            np.broadcast_to(along[:, :1], radius.shape),
        ],
        axis=-1,
    )
    normals = np.stack(
        [
            normal[:, 1, None] * np.cos(angle - lean),
            normal[:, 1, None] * np.sin(angle - lean),
            np.broadcast_to(normal[:, :1], radius.shape),
        ],
        axis=-1,
    )
    faces = []
    for i in range(len(along) - 1):
        if np.allclose(along[i], along[i + 1]):
            continue
        a = i * segments + np.arange(segments)
        b = i * segments + (np.arange(segments) + 1) % segments
        c, d = b + segments, a + segments
        faces += [np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]
    return Surface(
        points=points.reshape(-1, 3),
        normals=normals.reshape(-1, 3),
        faces=np.concatenate(faces).astype(np.uint32),
        colour=None if tint is None else np.repeat(tint, segments, axis=0),
    )


def _split_at_corners(
    points: Floats, colour: Floats | None
) -> tuple[Floats, Floats, Floats | None]:
    """The profile with its corners doubled, its normals ``(height, radius)``, its colours."""
    step = np.diff(points, axis=0)
    step /= np.maximum(np.linalg.norm(step, axis=1, keepdims=True), 1e-12)
    facing = np.stack([-step[:, 1], step[:, 0]], axis=1)  # to the right of the walk
    places, normals, index = [points[0]], [facing[0]], [0]
    for i in range(1, len(points) - 1):
        if facing[i - 1] @ facing[i] > np.cos(np.radians(30)):
            middle = facing[i - 1] + facing[i]
            places.append(points[i])
            normals.append(middle / np.linalg.norm(middle))
            index.append(i)
        else:
            places += [points[i], points[i]]
            normals += [facing[i - 1], facing[i]]
            index += [i, i]
    places.append(points[-1])
    normals.append(facing[-1])
    index.append(len(points) - 1)
    return np.array(places), np.array(normals), None if colour is None else colour[index]


def ball(radius: float, centre_height: float) -> Surface:
    """A sphere on the axis."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, 13)
    profile = np.stack([centre_height + radius * np.sin(angle), radius * np.cos(angle)], axis=1)
    profile[[0, -1], 1] = 1e-4
    return turn([(float(h), float(r)) for h, r in profile])
