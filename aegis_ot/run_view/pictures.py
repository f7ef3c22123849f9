"""Cutting pictures out of frames, small enough that a page of many wells stays quick."""

from __future__ import annotations

from collections.abc import Callable

import cv2
import numpy as np

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
    part = part_of(width, height, box)
    if part is None:
        return None
    left, top, wide, tall = part
    cut = image[top : top + tall, left : left + wide]
    return Picture(_jpeg(cut, _TIP_HEIGHT / tall, 84), left, top, wide, tall)


def part_of(width: int, height: int, box: Box) -> tuple[int, int, int, int] | None:
    """The part x, y, w, h of a frame that shows a tip with some margin, px.

    ``None`` if the box lies outside the frame.
    """
    x, y, w, h = box
    tall = h * (1 + 2 * _MARGIN)
    wide = max(w * (1 + 4 * _MARGIN), _LEAST_ASPECT * tall)
    left, right = int(max(x + w / 2 - wide / 2, 0)), int(min(x + w / 2 + wide / 2, width))
    top, bottom = int(max(y + h / 2 - tall / 2, 0)), int(min(y + h / 2 + tall / 2, height))
    if right - left < 8 or bottom - top < 8:
        return None
    return left, top, right - left, bottom - top


def cut_pictures(
    frame: Callable[[int], bytes | None],
) -> Callable[[int, Box | None], tuple[Picture | None, Picture | None, str]]:
    """Cuts the pictures of keyframes out of their JPEG files.

    Args:
        frame: The JPEG of a keyframe's number; ``None`` where it is missing.
    """

    def pictures(sequence: int, box: Box | None) -> tuple[Picture | None, Picture | None, str]:
        jpeg = frame(sequence)
        if jpeg is None:
            return None, None, "This frame is missing in the store."
        decoded = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR) if jpeg else None
        if decoded is None:
            return None, None, "This frame is damaged in the store."
        image = np.asarray(decoded, dtype=np.uint8)
        return whole_frame(image), None if box is None else close_up(image, box), ""

    return pictures


def _jpeg(image: Image, scale: float, quality: int) -> bytes:
    if scale < 1:
        image = cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    _, data = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, quality])
    return data.tobytes()
