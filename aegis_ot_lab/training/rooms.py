"""Rooms for drawn frames: what a camera may see besides the pipette."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from .strokes import Image, paint, polygon, random_colour

Float = NDArray[np.float32]


def draw_room(rng: np.random.Generator, width: int, height: int) -> Image:
    """An image of the given size, px: a background, and mostly clutter and a deck with labware."""
    kind = rng.random()
    if kind < 0.45:
        base = random_colour(rng, 8, 60, 0.15)
    elif kind < 0.75:
        base = random_colour(rng, 50, 150, 0.2)
    else:
        base = random_colour(rng, 120, 240, 0.15)
    canvas = np.empty((height, width, 3), np.float32)
    canvas[:] = base
    strength = rng.uniform(0, 0.35)
    canvas *= (1 + strength * _texture(rng, height, width, rng.uniform(80, 400)))[..., None]
    if rng.random() < 0.4:
        canvas *= (1 + rng.uniform(0, 0.25) * _texture(rng, height, width, rng.uniform(3, 30)))[
            ..., None
        ]
    image: Image = np.clip(canvas, 0, 255).astype(np.uint8)
    if rng.random() < 0.25:
        image = _patchwork(rng, image)
    for _ in range(int(rng.integers(0, 10)) if rng.random() < 0.6 else 0):
        _clutter(rng, image)
    if rng.random() < 0.5:  # out of focus, behind the pipette
        image = cv2.GaussianBlur(image, (0, 0), rng.uniform(0.5, 6))
    if rng.random() < 0.85:
        _deck(rng, image)
    return image


def _texture(rng: np.random.Generator, height: int, width: int, cell: float) -> Float:
    """Smooth random field in -1..1 with detail of about ``cell`` px."""
    small = rng.uniform(-1, 1, (max(2, int(height / cell) + 2), max(2, int(width / cell) + 2)))
    field: Float = cv2.resize(
        small.astype(np.float32), (width, height), interpolation=cv2.INTER_CUBIC
    )
    return field


def _patchwork(rng: np.random.Generator, image: Image) -> Image:
    """A laboratory behind: things before things, large to small, each with its own light."""
    height, width = image.shape[:2]
    for scale in (0.5, 0.25, 0.12, 0.06):
        for _ in range(int(rng.integers(2, 14))):
            x, y = rng.uniform(-0.1, 1.1) * width, rng.uniform(-0.1, 1.1) * height
            reach = scale * height * np.exp(rng.normal(0, 0.4, 2))
            corners = int(rng.integers(3, 9))
            turn = np.sort(rng.uniform(0, 2 * np.pi, corners))
            if rng.random() < 0.5:  # most things indoors are upright boxes
                turn = np.deg2rad([45, 135, 225, 315]) + rng.normal(0, 0.05, 4)
            shape = np.array([x, y]) + np.stack([np.cos(turn), np.sin(turn)], -1) * reach
            paint(image, shape, random_colour(rng, 5, 235, 0.35), rng.uniform(0.3, 1.0))
    grain = _texture(rng, height, width, rng.uniform(2, 12))[..., None]
    lit = image * (1 + rng.uniform(0, 0.3) * grain)
    return np.clip(lit, 0, 255).astype(np.uint8)


def _clutter(rng: np.random.Generator, image: Image) -> None:
    """A bar, a cable, a box or a glare somewhere."""
    height, width = image.shape[:2]
    colour = random_colour(rng, 5, 240, 0.5).tolist()
    x, y = rng.uniform(0, width), rng.uniform(0, height)
    kind = rng.random()
    if kind < 0.35:  # upright or level bar: frame posts, tubes, labels
        w, h = rng.uniform(2, 40), rng.uniform(30, height)
        if rng.random() < 0.35:
            w, h = h, w
        skew = rng.uniform(-0.06, 0.06) * h
        polygon(
            image, np.array([[x, y], [x + w, y], [x + w + skew, y + h], [x + skew, y + h]]), colour
        )
    elif kind < 0.6:  # cable
        t = np.linspace(0, 1, 12)
        points = np.stack(
            [
                x + rng.uniform(-200, 200) * t + rng.uniform(-80, 80) * t**2,
                y + rng.uniform(-200, 200) * t + rng.uniform(-150, 150) * t**2,
            ],
            axis=-1,
        )
        cv2.polylines(
            image,
            [np.round(points).astype(np.int32)],
            False,
            colour,
            int(rng.integers(1, 7)),
            cv2.LINE_AA,
        )
    elif kind < 0.85:
        w, h = rng.uniform(10, 150), rng.uniform(10, 150)
        cv2.rectangle(image, (int(x), int(y)), (int(x + w), int(y + h)), colour, -1)
    else:
        axes = (int(rng.uniform(2, 30)), int(rng.uniform(2, 30)))
        cv2.ellipse(
            image, (int(x), int(y)), axes, rng.uniform(0, 180), 0, 360, colour, -1, cv2.LINE_AA
        )


def _deck(rng: np.random.Generator, image: Image) -> None:
    height, width = image.shape[:2]
    horizon = rng.uniform(0.45, 0.95) * height
    tilt = rng.uniform(-0.03, 0.03) * width
    colour = random_colour(rng, 20, 190, 0.15).tolist()
    polygon(
        image,
        np.array([[0, horizon], [width, horizon + tilt], [width, height], [0, height]]),
        colour,
    )
    for _ in range(int(rng.integers(0, 5))):
        _labware(rng, image, horizon)


def _labware(rng: np.random.Generator, image: Image, horizon: float) -> None:
    """A plate or a rack: lit top with wells, darker front, now and then tips or tubes in it."""
    height, width = image.shape[:2]
    x0, y0 = rng.uniform(-0.2, 0.9) * width, horizon + rng.uniform(-0.05, 0.3) * height
    w, depth, front = rng.uniform(0.15, 0.45) * width, rng.uniform(5, 60), rng.uniform(5, 90)
    lean = rng.uniform(-40, 40)
    colour = random_colour(rng, 30, 235, 0.6 if rng.random() < 0.5 else 0.08)
    top = np.array(
        [[x0 + lean, y0], [x0 + w + lean * 0.5, y0], [x0 + w, y0 + depth], [x0, y0 + depth]]
    )
    polygon(image, top, colour.tolist())
    polygon(
        image,
        np.array(
            [
                [x0, y0 + depth],
                [x0 + w, y0 + depth],
                [x0 + w - 4, y0 + depth + front],
                [x0 + 4, y0 + depth + front],
            ]
        ),
        (colour * rng.uniform(0.4, 0.95)).tolist(),
    )
    rows, columns = int(rng.integers(2, 7)), int(rng.integers(3, 13))
    hole = (colour * rng.uniform(0.3, 1.2)).clip(0, 255).tolist()
    for i in range(rows):
        v = (i + 0.5) / rows
        for j in range(columns):
            x = x0 + lean * (1 - v) + (j + 0.5) * w / columns
            axes = (max(1, int(w / columns * 0.33)), max(1, int(depth / rows * 0.33)))
            cv2.ellipse(
                image, (int(x), int(y0 + v * depth)), axes, 0, 0, 360, hole, -1, cv2.LINE_AA
            )
    if rng.random() < 0.3:  # a row of things that stand in it: short, and collar upwards
        pitch, tall = w / columns, rng.uniform(6, 35)
        shade = random_colour(rng, 60, 250, 0.2).tolist()
        end = 0.8
        if rng.random() < 0.3:  # tips in an open rack: whole, tapered, and on no pipette
            tall, end = tall * rng.uniform(1.5, 4), rng.uniform(0.15, 0.5)
        for j in range(columns):
            x = x0 + (j + 0.5) * pitch
            half = pitch * 0.3
            corners = [[-half, -tall], [half, -tall], [half * end, 2], [-half * end, 2]]
            place = np.array([x, y0]) + np.array(corners)
            paint(image, place, np.array(shade), 1.0 if end == 0.8 else rng.uniform(0.3, 0.9))
