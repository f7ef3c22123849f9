"""What stands still in a session: wall, deck, labware, light. Drawn once, then reused."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from .optics import Pinhole
from .session import SessionLabware, SessionParameters

Plane = NDArray[np.float32]
BACK_MM = 190.0
"""Where the deck ends and the panel behind it begins, mm."""


def draw_backdrop(parameters: SessionParameters, camera: Pinhole) -> Plane:
    """The empty scene before light falls on it: float32 ``(height, width, 3)``, grey levels."""
    width, height = parameters.size
    rng = np.random.default_rng((parameters.seed, 1))
    ramp = np.linspace(0.0, 1.0, height, dtype=np.float32)[:, None, None]
    wall = np.asarray(parameters.wall, np.float32)
    top = np.asarray(parameters.backdrop_top, np.float32)
    image: Plane = np.ascontiguousarray(
        np.broadcast_to(top * (1 - ramp) + wall * ramp, (height, width, 3))
    )
    if parameters.clutter > 0:
        _clutter(image, parameters, rng)
    blocks = [block.y + block.DEPTH for block in parameters.labware]
    far, right = max(BACK_MM, *blocks, BACK_MM) + 1.0, parameters.panel_right_mm
    _polygon(
        image, camera, [(-700, far, 0), (right, far, 0), (right, -260, 0), (-700, -260, 0)],
        parameters.deck,
    )  # fmt: skip
    _slots(image, camera, parameters)
    # Farther blocks first, so that nearer ones cover them.
    for block in sorted(parameters.labware, key=lambda item: -item.y):
        _block(image, camera, block, rng)
    grain = rng.normal(0.0, 1.0, (height // 4 + 1, width // 4 + 1)).astype(np.float32)
    texture = cv2.resize(grain, (width, height), interpolation=cv2.INTER_CUBIC)
    image *= 1.0 + 0.008 * texture[..., None]
    return np.clip(image, 0.0, 255.0)


def light_field(parameters: SessionParameters) -> Plane:
    """Brightness over the frame times white balance, float32 ``(height, width, 3)``."""
    width, height = parameters.size
    y = np.linspace(0.0, 1.0, height, dtype=np.float32)[:, None]
    x = np.linspace(-1.0, 1.0, width, dtype=np.float32)[None, :]
    light = 1.0 - parameters.brightness_fall * (1.0 - y)
    light = light * (1.0 - parameters.side_fall * (x + 1) / 2)
    light = light * (1.0 - parameters.vignette * (x**2 + (2 * y - 1) ** 2) / 2)
    balance = np.asarray(parameters.white_balance, np.float32) * parameters.gain
    return np.asarray(light[..., None] * balance, np.float32)


def _polygon(
    image: Plane,
    camera: Pinhole,
    points: list[tuple[float, float, float]],
    colour: tuple[float, float, float],
) -> None:
    pixels = np.round(camera.project(points) * 16 - 8).clip(-(2**20), 2**20).astype(np.int32)
    cv2.fillPoly(image, [pixels], colour, cv2.LINE_AA, 4)


def _clutter(image: Plane, parameters: SessionParameters, rng: np.random.Generator) -> None:
    """Shelves, bottles, windows: blurred boxes far behind the deck."""
    height, width = image.shape[:2]
    layer = image.copy()
    for _ in range(int(rng.integers(6, 18))):
        x, y = int(rng.uniform(-0.1, 1.0) * width), int(rng.uniform(-0.1, 0.8) * height)
        w, h = int(rng.uniform(0.03, 0.4) * width), int(rng.uniform(0.03, 0.5) * height)
        colour = rng.uniform(10.0, 235.0) * (1 + rng.normal(0, 0.2, 3))
        shade = tuple(float(c) for c in colour.clip(0, 255))
        cv2.rectangle(layer, (x, y), (x + w, y + h), shade, -1)
    layer = cv2.GaussianBlur(layer, (0, 0), rng.uniform(2.0, 14.0) * height / 480)
    cv2.addWeighted(layer, parameters.clutter, image, 1 - parameters.clutter, 0, dst=image)


def _slots(image: Plane, camera: Pinhole, parameters: SessionParameters) -> None:
    """The seams between deck slots."""
    shade = tuple(0.75 * c for c in parameters.deck)
    lines = [
        [(x, -200.0, 0.0), (x, BACK_MM, 0.0)]
        for x in (-265, -132.5, 0, 132.5, 265)
        if x < parameters.panel_right_mm
    ]
    lines += [
        [(-600.0, y, 0.0), (min(600.0, parameters.panel_right_mm), y, 0.0)]
        for y in (-45.0, 45.5, 136.0)
    ]
    for line in lines:
        a, b = np.round(camera.project(line) * 16 - 8).clip(-(2**20), 2**20).astype(int)
        cv2.line(image, (int(a[0]), int(a[1])), (int(b[0]), int(b[1])), shade, 1, cv2.LINE_AA, 4)


def _block(image: Plane, camera: Pinhole, block: SessionLabware, rng: np.random.Generator) -> None:
    left, right = block.x - block.WIDTH / 2, block.x + block.WIDTH / 2
    front, back, top = block.y - block.DEPTH / 2, block.y + block.DEPTH / 2, block.height_mm
    shadow = 5.0
    floor = camera.project([(left, front, 0.0)])[0].round().astype(int)
    under = image[
        int(np.clip(floor[1], 0, image.shape[0] - 1)), int(np.clip(floor[0], 0, image.shape[1] - 1))
    ]
    dim = (float(under[0]) * 0.55, float(under[1]) * 0.55, float(under[2]) * 0.55)
    _polygon(
        image, camera,
        [(left - shadow, front - shadow, 0), (right + shadow, front - shadow, 0),
         (right + shadow, back, 0), (left - shadow, back, 0)], dim,
    )  # fmt: skip

    def shade(factor: float) -> tuple[float, float, float]:
        b, g, r = block.colour
        return (b * factor, g * factor, r * factor)

    for x, visible in ((left, camera.eye[0] < left), (right, camera.eye[0] > right)):
        if visible:
            _polygon(
                image, camera,
                [(x, front, 0), (x, back, 0), (x, back, top), (x, front, top)], shade(0.55),
            )  # fmt: skip
    _polygon(
        image, camera,
        [(left, front, 0), (right, front, 0), (right, front, top), (left, front, top)],
        shade(0.68),
    )  # fmt: skip
    _polygon(
        image, camera,
        [(left, front, top), (right, front, top), (right, back, top), (left, back, top)],
        shade(1.0),
    )  # fmt: skip
    angles = np.linspace(0, 2 * np.pi, 20, endpoint=False)
    ring = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=1)
    depth = rng.uniform(0.45, 0.75)
    for row in range(block.rows):
        for column in range(block.columns):
            x = block.x + (column - (block.columns - 1) / 2) * 108 / block.columns
            y = block.y - (row - (block.rows - 1) / 2) * 72 / block.rows
            # A reservoir's troughs run from front to back.
            stretch = (block.well_radius_mm, 34.0 if block.rows == 1 else block.well_radius_mm, 0)
            points = [tuple(p) for p in ring * stretch + (x, y, top)]
            _polygon(image, camera, points, shade(depth * rng.uniform(0.9, 1.1)))
