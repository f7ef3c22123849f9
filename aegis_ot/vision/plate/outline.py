"""Where a plate may lie in a picture: four-cornered regions of a footprint's shape."""

from __future__ import annotations

from collections.abc import Iterator

import cv2
import numpy as np
from numpy.typing import NDArray

from ..types import Image
from .formats import LENGTH_MM, WIDTH_MM

Corners = NDArray[np.float32]

_LEAST_AREA, _MOST_AREA = 0.08, 0.98
"""Shares of the picture that a plate may take."""

_ASPECT = LENGTH_MM / WIDTH_MM
_ASKEW = 1.3
"""Most that perspective changes a plate's length by width."""

_ALIKE = 0.012
"""Corners nearer to each other than this, shares of the picture's width, are the same."""


def outlines(image: Image) -> list[Corners]:
    """Regions that may be a plate, ``(4, 2)`` px each: around it as seen, two long sides along x.

    The first corner is the one at the top left where the plate lies lengthwise in the picture,
    and the one at the top right where it stands upright in it.
    """
    found: list[Corners] = []
    tall, wide = image.shape[:2]
    for mask in _masks(image):
        contours, _ = cv2.findContours(mask, cv2.RETR_LIST, cv2.CHAIN_APPROX_SIMPLE)
        contours = sorted(contours, key=cv2.contourArea, reverse=True)[:4]
        for contour in contours:
            area = cv2.contourArea(cv2.convexHull(contour)) / (tall * wide)
            if not _LEAST_AREA < area < _MOST_AREA:
                continue
            corners = _quadrilateral(contour)
            if corners is None or any(
                np.abs(corners - known).max() < _ALIKE * wide for known in found
            ):
                continue
            found.append(corners)
    return found


def _masks(image: Image) -> Iterator[NDArray[np.uint8]]:
    """Pictures in two levels in one of which a plate should be one region."""
    smooth = cv2.GaussianBlur(image, (0, 0), 2.0)
    lab = cv2.cvtColor(smooth, cv2.COLOR_BGR2LAB).astype(np.float32)
    border = np.concatenate([lab[:8].reshape(-1, 3), lab[-8:].reshape(-1, 3),
                             lab[:, :8].reshape(-1, 3), lab[:, -8:].reshape(-1, 3)])  # fmt: skip
    far = np.linalg.norm(lab - np.median(border, axis=0), axis=2)
    grey = cv2.cvtColor(smooth, cv2.COLOR_BGR2GRAY)
    for plane in (grey, np.clip(far * 2, 0, 255).astype(np.uint8)):
        level, mask = cv2.threshold(plane, 0, 255, cv2.THRESH_BINARY + cv2.THRESH_OTSU)
        yield from _closed(mask)
        yield from _closed(cv2.threshold(plane, 0.6 * level, 255, cv2.THRESH_BINARY)[1])
    for strict in (1.0, 0.5, 0.25):
        edge = cv2.Canny(grey, 30 * strict, 80 * strict)
        for size in (5, 11):
            yield cv2.morphologyEx(edge, cv2.MORPH_CLOSE, np.ones((size, size), np.uint8))


def _closed(mask: NDArray[np.uint8]) -> Iterator[NDArray[np.uint8]]:
    kernel = np.ones((9, 9), np.uint8)
    for one in (mask, 255 - mask):
        yield cv2.morphologyEx(one, cv2.MORPH_OPEN, kernel)


def _quadrilateral(contour: NDArray[np.int32]) -> Corners | None:
    """Four corners around a contour, if they have a plate's shape."""
    hull = cv2.convexHull(contour)
    around = cv2.arcLength(hull, True)
    for share in (0.01, 0.015, 0.02, 0.03, 0.045, 0.06):
        corners = cv2.approxPolyDP(hull, share * around, True)
        if len(corners) == 4:
            break
    else:
        corners = cv2.boxPoints(cv2.minAreaRect(hull))
    return _in_order(np.asarray(corners, np.float32).reshape(4, 2))


def _in_order(corners: Corners) -> Corners | None:
    middle = corners.mean(axis=0)
    angles = np.arctan2(corners[:, 1] - middle[1], corners[:, 0] - middle[0])
    corners = corners[np.argsort(angles)]  # clockwise as seen: y points down
    sides = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
    first, second = sides[0] + sides[2], sides[1] + sides[3]
    if second > first:
        corners = np.roll(corners, -1, axis=0)
        first, second = second, first
    if not _ASPECT / _ASKEW < first / max(second, 1e-6) < _ASPECT * _ASKEW:
        return None
    along = corners[1] - corners[0] + corners[2] - corners[3]
    # Lengthwise: the columns run to the right. Upright: they run downwards.
    ahead = along[0] if abs(along[0]) >= abs(along[1]) else along[1]
    return corners if ahead > 0 else np.roll(corners, 2, axis=0)
