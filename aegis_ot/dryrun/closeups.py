"""The part of a frame that a person wants to see."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

_MARGIN = 0.12
_ASPECT = 0.62
"""Width of a close-up, as a fraction of its height."""

_HEIGHT = 420
"""px."""


def close_up(jpeg: bytes, box: Sequence[float]) -> bytes | None:
    """Cut the tip out of a frame and enlarge it; ``None`` if that cannot be done.

    Args:
        jpeg: The whole frame.
        box: Tip box x, y, w, h, px.
    """
    image = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR)
    if image is None:
        return None
    x, y, w, h = box
    half = h * (0.5 + _MARGIN)
    middle = (x + w / 2, y + h / 2)
    top, bottom = int(max(middle[1] - half, 0)), int(min(middle[1] + half, image.shape[0]))
    reach = half * _ASPECT
    left, right = int(max(middle[0] - reach, 0)), int(min(middle[0] + reach, image.shape[1]))
    if bottom - top < 8 or right - left < 8:
        return None
    scale = _HEIGHT / (bottom - top)
    size = (max(int((right - left) * scale), 1), _HEIGHT)
    done, data = cv2.imencode(".jpg", cv2.resize(image[top:bottom, left:right], size))
    return bytes(data) if done else None
