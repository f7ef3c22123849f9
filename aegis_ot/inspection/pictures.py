"""Cutting pictures out of frames, small enough that a page of many wells stays quick."""

from __future__ import annotations

import cv2

from ..vision.types import Image
from .wells import Box, Picture

_WHOLE_WIDTH = 360
_TIP_HEIGHT = 400
"""Most pixels of a picture; a smaller one is not enlarged."""

_MARGIN = 0.1
_LEAST_ASPECT = 0.8
"""Least width of a close-up, as a fraction of its height."""


def whole_frame(image: Image) -> Picture:
    """The frame, small."""
    height, width = image.shape[:2]
    return Picture(_jpeg(image, _WHOLE_WIDTH / width, 70), 0, 0, width, height)


def close_up(image: Image, box: Box) -> Picture | None:
    """The tip with some margin; ``None`` if the box lies outside the frame."""
    height, width = image.shape[:2]
    x, y, w, h = box
    tall = h * (1 + 2 * _MARGIN)
    wide = max(w * (1 + 4 * _MARGIN), _LEAST_ASPECT * tall)
    left, right = int(max(x + w / 2 - wide / 2, 0)), int(min(x + w / 2 + wide / 2, width))
    top, bottom = int(max(y + h / 2 - tall / 2, 0)), int(min(y + h / 2 + tall / 2, height))
    if right - left < 8 or bottom - top < 8:
        return None
    part = image[top:bottom, left:right]
    return Picture(
        _jpeg(part, _TIP_HEIGHT / (bottom - top), 84), left, top, right - left, bottom - top
    )


def _jpeg(image: Image, scale: float, quality: int) -> bytes:
    if scale < 1:
        image = cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    _, data = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, quality])
    return data.tobytes()
