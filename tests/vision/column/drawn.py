"""Tips drawn from plain geometry, so that what is in them is known to a fraction of a pixel."""

from __future__ import annotations

import cv2
import numpy as np

from aegis_ot.vision.column.strip import SHAPES
from aegis_ot.vision.types import Image, TipDetection, TrajectorySample
from aegis_ot.vocabulary import KeyframeKind

RED = (0.62, 0.60, 0.97)
"""Transmission of a red dye across the bore, BGR."""

WATER = (1.0, 1.0, 1.0)

ALARM = 2.5
"""Score, nats, under which every normal stays (p = 0.08)."""


def draw_tip(
    *,
    collar: tuple[float, float] = (160.0, 40.0),
    orifice: tuple[float, float] = (166.0, 225.0),
    top: float = 1.0,
    dye: tuple[float, float, float] = RED,
    gap: tuple[float, float] | None = None,
    light: float = 1.0,
    seed: int = 0,
    pipette: str = "p1000",
    size: tuple[int, int] = (320, 260),
) -> Image:
    """A frame with one tip, filled from ``top`` (u) down to the orifice, ``gap`` left out."""
    rng = np.random.default_rng(seed)
    shape = SHAPES[pipette]
    width, height = size
    y, x = np.mgrid[0:height, 0:width] + 0.5
    along = np.subtract(orifice, collar)
    length = float(np.hypot(*along))
    u = ((x - collar[0]) * along[0] + (y - collar[1]) * along[1]) / length**2
    v = np.abs((x - collar[0]) * along[1] - (y - collar[1]) * along[0]) / length**2
    radius = np.where(
        u < 0,
        shape.collar_radius * 0.8,
        shape.collar_radius + (shape.orifice_radius - shape.collar_radius) * np.clip(u, 0, 1),
    )
    image = np.full((height, width, 3), 55.0)
    inside = (v < radius) & (u < 1)
    wall = inside & (v > 0.8 * radius)
    image[inside] = 85.0
    image[wall] = 105.0
    image[inside & (u < shape.nozzle_end)] = 190.0
    wet = inside & ~wall & (u > max(top, shape.nozzle_end))
    if gap is not None:
        wet &= ~((u > gap[0]) & (u < gap[1]))
    image[wet] = 85.0 * np.asarray(dye)
    for edge in (top, *(gap or ())):
        image[inside & ~wall & (np.abs(u - edge) < 0.8 / length)] = 150.0
    image = cv2.GaussianBlur(image, (0, 0), 0.9)
    image = image * light + rng.normal(0, 1.7, image.shape)
    return np.clip(image, 0, 255).astype(np.uint8)


def detection(
    collar: tuple[float, float] = (160.0, 40.0),
    orifice: tuple[float, float] = (166.0, 225.0),
    off: tuple[float, float, float, float] = (0, 0, 0, 0),
    confidence: float = 0.95,
) -> TipDetection:
    """The drawn tip's detection, wrong by ``off`` (collar x, y, orifice x, y; px)."""
    c = (collar[0] + off[0], collar[1] + off[1])
    o = (orifice[0] + off[2], orifice[1] + off[3])
    return TipDetection(
        min(c[0], o[0]) - 8, c[1], abs(c[0] - o[0]) + 16, o[1] - c[1], confidence, o, c
    )


FULL = 0.53
"""Where 250 µL stand in a drawn p1000 tip, u."""

LOADED = (KeyframeKind.ASPIRATE, KeyframeKind.TRANSIT)


def trajectory(
    name: str,
    plate: str = "plate0",
    *,
    left: float = 1.0,
    full: float = FULL,
    gap: tuple[float, float] | None = None,
    dye: tuple[float, float, float] = RED,
    seed: int = 0,
    tips: bool = True,
    label: str = "normal",
) -> TrajectorySample:
    """A cycle: filled to ``full`` before the dispense and to ``left`` after it (u)."""
    frames = {
        kind: draw_tip(
            top=full if kind in LOADED else left,
            gap=gap if kind in LOADED else None,
            dye=dye,
            seed=seed * 10 + i,
            light=1.0 + 0.02 * ((seed + i) % 3 - 1),
        )
        for i, kind in enumerate(KeyframeKind)
    }
    return TrajectorySample(
        id=name,
        plate=plate,
        well="A1",
        pipette="p1000",
        volume_ul=250.0,
        frames=frames,
        detections={kind: detection() if tips else None for kind in KeyframeKind},
        expected_ul={kind: 250.0 if kind in LOADED else 0.0 for kind in KeyframeKind},
        label=label,
    )


def normals(plates: int = 4, wells: int = 2) -> list[TrajectorySample]:
    """Normal cycles on several plates."""
    return [
        trajectory(f"p{p}w{w}", f"plate{p}", seed=10 * p + w + 1, full=FULL + 0.004 * (p % 3 - 1))
        for p in range(plates)
        for w in range(wells)
    ]
