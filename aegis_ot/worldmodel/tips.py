"""The tips of a data set, found once in every frame, by a detector or by the set's own labels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from ..progress import Progress
from ..vision.dataset import Dataset, TrueBoxes
from ..vision.types import Detector, TrajectorySample
from ..vocabulary import KeyframeKind
from .registered_tips import registered_samples

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


@dataclass(frozen=True)
class FoundTips:
    """The trajectories of a set with the tip in every frame.

    Attributes:
        samples: All trajectories, in order.
        detector: What found the tips.
        finder: The detector itself, unless the tips are labelled.
    """

    samples: Sequence[TrajectorySample]
    detector: str
    finder: Detector | None = None


def find_tips(
    data: Dataset, detector: Detector | TrueBoxes | str, progress: Progress | None = None
) -> FoundTips:
    """Look for the tip in every frame of a set.

    Raises:
        DatasetError: If true boxes are asked for and a frame has none, or ``"registered"`` ones
            and the set does not say where the robot held the tip.
        ModelError: If a detector's file cannot be used.
    """
    from aegis_ot.vision.detection import load_detector

    progress = progress or Progress()
    if detector == "registered":
        shipped = load_detector("default")
        progress.begin("Registering cameras", 1)
        located = registered_samples(data, shipped)
        progress.step()
        return FoundTips(located, "detector and the robot's positions", shipped)
    finder, name = find_detector(data, detector)
    samples = data.samples(finder)
    progress.begin("Finding tips", len(samples))
    for sample in samples:
        for kind in KeyframeKind:
            sample.detections[kind]
        progress.step()
    return FoundTips(samples, name, None if isinstance(finder, TrueBoxes) else finder)
