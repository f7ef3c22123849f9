"""The tips of a data set, found once in every frame, by a detector or by the set's own labels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from aegis_ot.errors import DatasetError
from aegis_ot.progress import Progress
from aegis_ot.vision.dataset import Dataset, TrueBoxes
from aegis_ot.vision.registration import TipLocator
from aegis_ot.vision.types import Detector, TipDetection, TrajectorySample
from aegis_ot.vocabulary import KeyframeKind
from aegis_ot.worldmodel.registered_tips import located_tips
from aegis_ot.worldmodel.tips import find_detector


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


def registered_samples(data: Dataset, detector: Detector) -> list[TrajectorySample]:
    """All trajectories; each plate's camera is registered by its own first wells, as a run's is.

    Args:
        data: A set with ``positions.csv``.
        detector: Searches the frames until a camera is registered, then confirms.

    Raises:
        DatasetError: The set has no positions.
    """
    if not data.positions:
        raise DatasetError(
            f"{data.root / 'positions.csv'} is missing: without the robot's positions no camera "
            "can be registered; use the detector alone (--boxes detector)"
        )
    plates: dict[str, list[TrajectorySample]] = {}
    samples = data.samples(detector)
    for sample in samples:
        plates.setdefault(sample.plate, []).append(sample)
    located: dict[str, Mapping[KeyframeKind, TipDetection | None]] = {}
    for plate in plates.values():
        located.update(located_tips(plate, TipLocator(detector)))
    return [replace(sample, detections=located[sample.id]) for sample in samples]
