"""The tips of a data set, located plate by plate by where the robot said they were."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from ..errors import DatasetError
from ..vision.dataset import Dataset
from ..vision.registration import TipLocator
from ..vision.types import FREE, Detector, TipDetection, TrajectorySample
from ..vocabulary import KeyframeKind


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


def located_tips(
    plate: Sequence[TrajectorySample], locator: TipLocator
) -> dict[str, Mapping[KeyframeKind, TipDetection | None]]:
    """The tips of one plate's trajectories, in the order in which they were pipetted."""
    return {
        sample.id: {
            kind: locator.locate(
                sample.frames[kind], sample.positions.get(kind), sample.tip.name, kind not in FREE
            ).detection
            for kind in KeyframeKind
        }
        for sample in plate
    }
