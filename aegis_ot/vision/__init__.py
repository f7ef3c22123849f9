"""The vision room: frames to detections, crops, scores, calibration, routes and gates."""

from typing import TYPE_CHECKING

from ..lazy import door

if TYPE_CHECKING:
    from .types import Detector, Image, Scorer, TipDetection, TrajectorySample

__getattr__ = door(__name__, {"types": "Detector Image Scorer TipDetection TrajectorySample"})

__all__ = ["Detector", "Image", "Scorer", "TipDetection", "TrajectorySample"]
