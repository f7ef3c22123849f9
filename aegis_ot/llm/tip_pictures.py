"""What a vision model is shown of a tip: enlarged, its contrast stretched, a normal well beside it.

A person who looks at frames so prepared tells a p20's failures from its normals; on the frames as
they are, nobody does. Both tips of a pair are stretched alike, so that they can be compared.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from ..vision.types import Image, TipDetection
from .backend import PromptPicture

_GREYS = (1.0, 99.0)
"""Percentiles that become black and white."""

_LEAST_RANGE = 24.0
"""Grey levels that are stretched to the whole range at most: less is noise."""

_BAR_PX = 8

_ABOVE = 0.02
"""Shown above a tip, tip lengths."""

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class CropSettings:
    """How a frame is cut and shown.

    Attributes:
        margin: Shown on both sides of the tip and below its orifice, tip lengths. Above the collar
            hardly anything is: the shaft tells nothing and is the brightest thing in the picture.
        lost: Shown beside, and above and below, the place where a tip was not found: from one well
            to the next it moves by up to its length, mostly sideways.
        side: Longer side of the picture that is sent, px.
        saturation: How much colours are strengthened: a dye in a fine bore is faint.
        quality: Of the JPEG, 1 to 100.
    """

    margin: float = 0.15
    lost: tuple[float, float] = (1.0, 0.4)
    side: int = 550
    saturation: float = 2.0
    quality: int = 90


def picture_of(
    frame: Image,
    detection: TipDetection | None,
    crop: CropSettings,
    normal: tuple[Image, TipDetection] | None = None,
) -> PromptPicture:
    """The tip cut out with a margin and brought to size.

    Where none was found, the place is shown where the normal well's is, at the same moment; without
    one, the whole frame.

    Args:
        frame: ``(height, width, 3)``, BGR.
        detection: The tip in it.
        crop: How it is cut.
        normal: The same moment of a normal well, and the tip in it: stands on the left.
    """
    place = detection or (normal[1] if normal else None)
    if place is None:
        side = min(max(frame.shape[:2]), 2 * crop.side)
        whole = _sized(frame.astype(np.float32), side)
        return _encoded(_stretched(whole, crop.saturation), crop)
    beside, below = (crop.margin, crop.margin) if detection else crop.lost
    around = beside, _ABOVE if detection else below, below
    shown = [_sized(_cut(frame, place, around), crop.side)]
    if normal is not None:
        shown.insert(0, _sized(_cut(*normal, around), crop.side))
    height = max(one.shape[0] for one in shown)
    shown = [
        cv2.copyMakeBorder(one, 0, height - one.shape[0], 0, 0, cv2.BORDER_REPLICATE)
        for one in shown
    ]
    stretched = _stretched(np.concatenate(shown, axis=1), crop.saturation)
    if len(shown) == 2:
        bar = shown[0].shape[1]
        stretched = np.insert(stretched, [bar] * _BAR_PX, 255.0, axis=1)
    return _encoded(stretched, crop)


def _cut(frame: Image, detection: TipDetection, around: tuple[float, float, float]) -> Floats:
    """``around``: what is shown beside, above and below the tip, tip lengths."""
    length = max(detection.w, detection.h)
    beside, above, below = (margin * length for margin in around)
    height, width = frame.shape[:2]
    left = int(max(detection.x - beside, 0))
    right = int(detection.x + detection.w + beside)
    top = int(max(detection.y - above, 0))
    bottom = int(detection.y + detection.h + below)
    cut = frame[top : min(bottom, height), left : min(right, width)]
    return (cut if cut.size else frame).astype(np.float32)


def _sized(image: Floats, side: int) -> Floats:
    height, width = image.shape[:2]
    factor = side / max(height, width)
    method = cv2.INTER_AREA if factor < 1 else cv2.INTER_CUBIC
    size = (max(round(width * factor), 1), max(round(height * factor), 1))
    return np.asarray(cv2.resize(image, size, interpolation=method), dtype=np.float32)


def _stretched(image: Floats, saturation: float) -> Floats:
    grey = image.mean(axis=2, keepdims=True)
    low, high = np.percentile(grey, _GREYS)
    coloured = grey + saturation * (image - grey)
    return np.asarray((coloured - low) * (255.0 / max(high - low, _LEAST_RANGE)), np.float32)


def _encoded(image: Floats, crop: CropSettings) -> PromptPicture:
    levels = np.clip(image, 0, 255).astype(np.uint8)
    _, data = cv2.imencode(".jpg", levels, [cv2.IMWRITE_JPEG_QUALITY, crop.quality])
    return PromptPicture(np.asarray(data).tobytes())
