"""The tip axis inside a box, from the tip's own edges."""

from __future__ import annotations

from itertools import pairwise

import cv2
import numpy as np

from ..types import Image

Point = tuple[float, float]
_LEAST_SIDE = 8


def axis_in_box(image: Image, x: float, y: float, w: float, h: float) -> tuple[Point, Point]:
    """Collar and orifice of the tip in a box, px.

    A tip is symmetric, so in each band across the box its edges lie evenly about the axis: the
    centre of the horizontal gradient's magnitude is taken as a point of the axis, and a line is
    put through the bands' points, robustly. Where the box is too small or the edges say nothing
    the axis is the box's vertical centre line.

    Args:
        image: BGR, ``uint8``, shape ``(height, width, 3)``.
        x, y, w, h: The box, px.

    Returns:
        Upper and lower end of the axis, on the box's upper and lower side.
    """
    middle = x + w / 2
    fallback = ((middle, y), (middle, y + h))
    x0, x1 = int(max(0, np.floor(x))), int(min(image.shape[1], np.ceil(x + w)))
    y0, y1 = int(max(0, np.floor(y))), int(min(image.shape[0], np.ceil(y + h)))
    if x1 - x0 < _LEAST_SIDE or y1 - y0 < 4 * _LEAST_SIDE:
        return fallback
    grey = cv2.cvtColor(image[y0:y1, x0:x1], cv2.COLOR_BGR2GRAY).astype(np.float32)
    gradient = np.abs(cv2.Sobel(grey, cv2.CV_32F, 1, 0, ksize=3))
    bands = 12
    edges = np.linspace(0, gradient.shape[0], bands + 1).astype(int)
    columns = np.arange(gradient.shape[1]) + 0.5
    heights, centres = [], []
    for low, high in pairwise(edges):
        profile = gradient[low:high].mean(axis=0)
        profile = np.clip(profile - np.median(profile), 0, None)
        strength = float(profile.sum())
        if strength < 1.0:
            continue
        heights.append(y0 + (low + high) / 2)
        centres.append(x0 + float((profile * columns).sum()) / strength)
    if len(heights) < bands // 2:
        return fallback
    at, found = np.array(heights) - (y + h / 2), np.array(centres)
    weight = np.ones_like(at)
    slope, offset = 0.0, middle
    for _ in range(5):  # least squares, the bands that disagree counting less each time
        slope, offset = np.polyfit(at, found, 1, w=np.sqrt(weight))
        misfit = np.abs(found - (slope * at + offset))
        scale = max(0.5, 1.5 * float(np.median(misfit)))
        weight = 1 / np.maximum(1.0, misfit / scale)
    ends = offset + slope * np.array([-h / 2, h / 2])
    if abs(slope) > 0.2 or (ends < x).any() or (ends > x + w).any():
        return fallback
    return (float(ends[0]), y), (float(ends[1]), y + h)
