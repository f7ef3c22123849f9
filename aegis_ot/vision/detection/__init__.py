"""Finding the tip in a frame: the shipped heat-map network, or a user's YOLOv8 export."""

from __future__ import annotations

from pathlib import Path

from ...errors import ModelError
from ..types import Detector
from .heatmap import HeatmapDetector, load_weights
from .yolo import YoloDetector

__all__ = ["HeatmapDetector", "YoloDetector", "load_detector", "load_weights"]


def load_detector(spec: str | Path = "default") -> Detector:
    """The detector that a setting names.

    Args:
        spec: ``"default"`` for the shipped network, or the path of an ``.onnx`` file: one made
            by ``aegis-ot train detector``, with its ``.json`` beside it, or a YOLOv8 export
            (layout: :class:`YoloDetector`).

    Raises:
        ModelError: The file is missing, damaged or of another layout.
    """
    if str(spec) == "default":
        return HeatmapDetector()
    path = Path(spec)
    if not path.is_file():
        raise ModelError(
            f"There is no detector file {spec}. Name an .onnx file, or 'default' for the shipped "
            "detector."
        )
    if path.with_suffix(".json").is_file():
        return HeatmapDetector(path)
    return YoloDetector(path)
