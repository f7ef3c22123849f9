"""Procedural frames for the detector: a drawn tip, or a bare nozzle, in a drawn room.

Nothing here tries to look like one camera. Every property that the detector must not depend on
is drawn anew for each frame: background, clutter, the shapes of pipette and tip, what the tip
holds, light, colour, blur, noise, compression.
"""

from __future__ import annotations

import numpy as np

from .axes import TipLabel
from .photometry import photograph, shows
from .pipettes import draw_pipette, draw_tip
from .rooms import draw_room
from .strokes import Axis, Image, paint, random_colour

SIZES = ((640, 480), (640, 480), (960, 540), (640, 360), (800, 600), (1280, 720))


def draw_frame(
    rng: np.random.Generator, tip: bool | None = None
) -> tuple[Image, TipLabel | None, TipLabel | None]:
    """One frame, the tip in it, and where a tip is missing from a bare nozzle.

    Args:
        rng: Every choice is drawn from it: the same state gives the same frame.
        tip: Whether the frame shows a tip; drawn (two in three) if not given.

    Returns:
        A BGR image of one of :data:`SIZES`; the tip's label, ``None`` for a bare nozzle, an
        empty frame or one so overexposed that nothing is left to see; the label that a tip
        would have had, ``None`` unless the nozzle is bare.
    """
    width, height = SIZES[int(rng.integers(len(SIZES)))]
    if tip is None:
        tip = bool(rng.random() < 0.67)
    image = draw_room(rng, width, height)
    length = float(np.exp(rng.uniform(np.log(0.06 * width), np.log(0.88 * height))))
    radius = max(2.5, length * rng.uniform(0.035, 0.09))
    angle = float(np.clip(rng.normal(0, 0.03), -0.12, 0.12))
    top = rng.uniform(-0.02, max(0.05, 0.95 - length / height)) * height
    collar = np.array([rng.uniform(0.06, 0.94) * width, max(top, 2.0)])
    axis = Axis(collar, angle)
    seat = rng.uniform(0.0, 0.14) * length
    if rng.random() < 0.2:  # the robot's other mount, bare
        other = Axis(
            collar
            + np.array(
                [
                    rng.choice([-1, 1]) * rng.uniform(0.15, 0.5) * width,
                    rng.uniform(-0.3, 0.4) * height,
                ]
            ),
            angle,
        )
        draw_pipette(rng, image, other, radius * rng.uniform(0.7, 1.3), 0.0)
    if not tip and rng.random() < 0.15:
        return photograph(rng, image), None, None
    draw_pipette(rng, image, axis, radius, seat)
    end = axis.at(length, 0.0)[0]
    label = TipLabel((float(collar[0]), float(collar[1])), (float(end[0]), float(end[1])), radius)
    if tip:
        draw_tip(rng, image, axis, length, radius, seat)
        if rng.random() < 0.3:
            _hide_end(rng, image, axis, length, radius)
    shown = photograph(rng, image)
    if not shows(shown, label):
        return shown, None, None
    return (shown, label, None) if tip else (shown, None, label)


def _hide_end(
    rng: np.random.Generator, image: Image, axis: Axis, length: float, radius: float
) -> None:
    """Put the lower end behind the wall or the rim of what it dips into."""
    rim = axis.at(length * rng.uniform(0.75, 1.0), 0.0)[0]
    left, right = rng.uniform(2, 40, 2) * radius
    drop = rng.uniform(0.05, 0.5) * length
    corners = [
        [-left, 0.0],
        [right, rng.uniform(-0.05, 0.05) * right],
        [right, drop],
        [-left, drop],
    ]
    seen_through = rng.random() < 0.3
    paint(
        image,
        rim + np.array(corners),
        random_colour(rng, 30, 235, 0.3),
        rng.uniform(0.2, 0.8) if seen_through else 1.0,
    )
