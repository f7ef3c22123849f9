"""Which detector is meant."""

from __future__ import annotations

from pathlib import Path
from typing import TypeVar

from ..vision.dataset import Dataset, TrueBoxes
from ..vision.types import Detector

D = TypeVar("D")


def find_detector(
    data: Dataset, detector: Detector | TrueBoxes | str
) -> tuple[Detector | TrueBoxes, str]:
    """The detector that is meant, and what to call it.

    Raises:
        DatasetError: If true boxes are asked for and the set has none.
        ModelError: If a detector's file cannot be used.
    """
    if detector == "true":
        return data.true_boxes(), TrueBoxes.name
    return named_detector(detector)


def named_detector(detector: D | str) -> tuple[D | Detector, str]:
    """A detector, loaded if only its file is named, and what to call it.

    Raises:
        ModelError: If its file cannot be used.
    """
    if not isinstance(detector, str):
        return detector, str(getattr(detector, "name", type(detector).__name__))
    from aegis_ot.vision.detection import load_detector

    return load_detector(detector), f"detector {Path(detector).name}"
