"""From detections to the vectors that the crop-based scorers learn (paper, Methods, PCA).

Each keyframe's tip box is cut out, made grey, padded to a square and resized to a fixed canvas.
The four canvases make one trajectory vector.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from ..vocabulary import KeyframeKind
from .types import Image, TipDetection, TrajectorySample

CANVAS = 48
"""Side of a crop, px (paper)."""

VECTOR_LENGTH = len(KeyframeKind) * CANVAS * CANVAS

Array = NDArray[np.float32]


def crop_grey(image: Image, detection: TipDetection | None, size: int = CANVAS) -> Array:
    """The tip in a fixed square canvas: cut out, padded to a square, resized (paper, Methods).

    Padding is black and even on both sides, so that a thin tip keeps its shape and nothing
    beside it is learned.

    Args:
        image: Whole frame, (height, width, 3), BGR.
        detection: The tip; ``None`` gives an all-zero (blank) crop.
        size: Side of the canvas, px.

    Returns:
        (size, size), grey levels from 0 to 1.
    """
    blank = np.zeros((size, size), dtype=np.float32)
    if detection is None:
        return blank
    height, width = image.shape[:2]
    left, top = max(int(detection.x), 0), max(int(detection.y), 0)
    right = min(int(np.ceil(detection.x + detection.w)), width)
    bottom = min(int(np.ceil(detection.y + detection.h)), height)
    if right <= left or bottom <= top:
        return blank
    grey = cv2.cvtColor(image[top:bottom, left:right], cv2.COLOR_BGR2GRAY)
    rows, columns = grey.shape
    side = max(rows, columns)
    above, before = (side - rows) // 2, (side - columns) // 2
    square = np.zeros((side, side), dtype=np.uint8)
    square[above : above + rows, before : before + columns] = grey
    small = cv2.resize(square, (size, size), interpolation=cv2.INTER_AREA)
    return np.asarray(small, dtype=np.float32) / np.float32(255)


def trajectory_vector(sample: TrajectorySample) -> Array:
    """The four crops of a trajectory in one vector, (9216,), grey levels from 0 to 1.

    Computed once per sample. A keyframe without a frame counts as one without a tip.
    """
    return sample.once("vector", lambda: _vector(sample))


def _vector(sample: TrajectorySample) -> Array:
    crops = []
    for kind in KeyframeKind:
        detection = sample.detections.get(kind)
        frame = None if detection is None else sample.frames.get(kind)
        if frame is None:
            crops.append(np.zeros(CANVAS * CANVAS, dtype=np.float32))
        else:
            crops.append(crop_grey(frame, detection).ravel())
    return np.concatenate(crops)
