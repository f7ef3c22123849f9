"""The vision room: frames to detections, crops, scores, calibration, routes and gates."""

from .types import Detector, Image, Scorer, TipDetection, TrajectorySample

__all__ = ["Detector", "Image", "Scorer", "TipDetection", "TrajectorySample"]
