"""Pipettes and tips for drawn frames, in many shapes and materials."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .strokes import Axis, Image, paint, random_colour

Curve = NDArray[np.float64]


def draw_pipette(
    rng: np.random.Generator, image: Image, axis: Axis, radius: float, seat: float
) -> None:
    """Body, shaft and nozzle, down to ``seat`` px below the collar of a tip of that radius."""
    height = image.shape[0]
    shaft = radius * rng.uniform(0.7, 1.5)
    nozzle = min(shaft, radius * rng.uniform(0.6, 1.0))
    stem = float(np.exp(rng.uniform(0, np.log(40)))) * radius
    bare = rng.uniform(0, 5) * radius if rng.random() < 0.5 else 0.0
    body = radius * rng.uniform(2, 7)
    shift = rng.uniform(-0.5, 0.5) * body
    block = axis.strip([-2.0 * height, -stem - bare], body, shift)
    paint(image, block, random_colour(rng, 20, 235, 0.12), 1.0)
    if rng.random() < 0.5:  # the side of the body that is turned away
        paint(
            image,
            axis.strip([-2.0 * height, -stem - bare], body * rng.uniform(0.1, 0.4), shift + body),
            random_colour(rng, 15, 200, 0.12),
            1.0,
        )
    _barrel(rng, image, axis, -stem - bare - 1, -bare, shaft, shaft * rng.uniform(0.85, 1.0))
    if bare or seat > 0:
        _barrel(rng, image, axis, -bare - 1, seat, nozzle, nozzle * rng.uniform(0.75, 1.0))
        for _ in range(int(rng.integers(0, 3))):  # sealing rings
            ring = rng.uniform(-bare, max(seat, 0.1))
            paint(
                image,
                axis.strip([ring, ring + radius * 0.3], nozzle * 1.05),
                random_colour(rng, 5, 90, 0.1),
                0.9,
            )


def _barrel(
    rng: np.random.Generator,
    image: Image,
    axis: Axis,
    top: float,
    bottom: float,
    half: float,
    end: float,
) -> None:
    """An opaque, shaded, round body from ``top`` to ``bottom`` that narrows to ``end``."""
    colour = random_colour(rng, 15, 235, 0.12)
    light, contrast = rng.uniform(-0.7, 0.7), rng.uniform(0.0, 0.6)
    slices = 7
    for i in range(slices):
        u = -1 + (i + 0.5) * 2 / slices
        shade = 1 - contrast * abs(u - light) / 1.7
        paint(
            image,
            axis.strip(
                [top, bottom], [half / slices * 1.15, end / slices * 1.15], [u * half, u * end]
            ),
            np.clip(colour * shade, 0, 255),
            1.0,
        )


def draw_tip(
    rng: np.random.Generator, image: Image, axis: Axis, length: float, radius: float, seat: float
) -> None:
    """A tip, ``length`` px long, into which the nozzle reaches ``seat`` px."""
    at, half = _profile(rng, radius)
    t = np.linspace(0, 1, 25)
    outline = axis.strip(t * length, np.interp(t, at, half))
    dark_edges = rng.random() < 0.25
    faint = 0.35 if rng.random() < 0.2 else 1.0  # a clean tip before a plain ground
    paint(image, outline, random_colour(rng, 60, 255, 0.12), faint * rng.uniform(0.02, 0.5))
    paint(
        image,
        axis.strip([0, at[1] * length], [half[0], half[1]]),
        random_colour(rng, 60, 255, 0.1),
        rng.uniform(0, 0.6),
    )
    for _ in range(int(rng.integers(0, 5))):  # ribs of the collar
        rib = rng.uniform(0, at[1]) * length
        paint(
            image,
            axis.strip([rib, rib + 1.5], half[0]),
            random_colour(rng, 30, 255, 0.1),
            rng.uniform(0.1, 0.6),
        )
    if rng.random() < 0.12:  # filter
        low = rng.uniform(seat / length, 0.4)
        span = np.array([low, low + rng.uniform(0.04, 0.12)])
        paint(
            image,
            axis.strip(span * length, np.interp(span, at, half) * 0.9),
            random_colour(rng, 150, 255, 0.2),
            0.9,
        )
    _contents(rng, image, axis, length, at, half)
    shine = random_colour(rng, 5, 60, 0.1) if dark_edges else random_colour(rng, 110, 255, 0.08)
    for side, strength in ((-1, rng.uniform(0.1, 0.9)), (1, rng.uniform(0.1, 0.9))):
        wall = max(0.6, radius * rng.uniform(0.06, 0.2))
        inner = side * (np.interp(t, at, half) - wall / 2)
        paint(image, axis.strip(t * length, wall / 2, inner), shine, faint * strength)
    for _ in range(int(rng.integers(0, 3))):  # long glints
        u, a, b = rng.uniform(-0.8, 0.8), *np.sort(rng.random(2))
        span = np.linspace(a, b, 8)
        paint(
            image,
            axis.strip(span * length, max(0.4, 0.06 * radius), np.interp(span, at, half) * u),
            random_colour(rng, 150, 255, 0.05),
            rng.uniform(0.1, 0.8),
        )


def _profile(
    rng: np.random.Generator, radius: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Half-width of a tip against the fraction of its length from the collar."""
    collar = rng.uniform(0.04, 0.3)
    shoulder = rng.uniform(0.7, 1.0)
    knee = rng.uniform(collar + 0.2, 0.9)
    end = rng.uniform(0.08, 0.3)
    at_knee = end + (shoulder - end) * (1 - knee) / (1 - collar) * rng.uniform(0.7, 1.5)
    at = np.array([0.0, collar, min(collar + 0.02, knee - 0.05), knee, 1.0])
    half = (
        np.array([1.0, rng.uniform(shoulder, 1.0), shoulder, min(at_knee, shoulder), end]) * radius
    )
    return at, half


def _contents(
    rng: np.random.Generator,
    image: Image,
    axis: Axis,
    length: float,
    at: NDArray[np.float64],
    half: NDArray[np.float64],
) -> None:
    if rng.random() < 0.45:
        return
    top = 1 - rng.uniform(0.03, 0.8)
    pieces = [(top, 1.0)]
    if rng.random() < 0.25:  # an air gap
        gap = rng.uniform(top, 1.0)
        pieces = [(top, gap), (min(gap + rng.uniform(0.01, 0.1), 1.0), 1.0)]
    if rng.random() < 0.3:  # dye
        colour, alpha = (
            random_colour(rng, 40, 255, 0.2) * rng.uniform(0, 1, 3),
            rng.uniform(0.2, 0.9),
        )
    else:
        colour, alpha = random_colour(rng, 20, 255, 0.6), rng.uniform(0.05, 0.8)
    for low, high in pieces:
        span = np.linspace(low, high, 12)
        paint(image, axis.strip(span * length, np.interp(span, at, half) * 0.85), colour, alpha)
        edge = np.array([low, low + 2.0 / length])
        paint(
            image,
            axis.strip(edge * length, np.interp(edge, at, half) * 0.85),
            random_colour(rng, 10, 255, 0.1),
            rng.uniform(0, 0.8),
        )
    if rng.random() < 0.12:  # hanging drop
        centre = axis.at(length + half[-1] * 0.6, 0.0)[0]
        radius = half[-1] * rng.uniform(1.0, 2.0)
        angles = np.linspace(0, 2 * np.pi, 16)
        drop = centre + radius * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        paint(image, drop, colour, rng.uniform(0.4, 0.9))
