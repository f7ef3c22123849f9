"""Build the world model of a lab from its recorded normal runs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from numpy.typing import NDArray

from ...errors import ConfigurationError, DatasetError
from ...vision.dataset import Dataset, TrueBoxes, load_dataset
from ...vision.models import ModelFile, save_model
from ...vision.scorers import make_scorer
from ...vision.types import Detector
from .evaluate import find_detector


@runtime_checkable
class Storable(Protocol):
    """A scorer that can be written to a model file."""

    def to_arrays(self) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
        """Arrays and settings."""


def fit_model(
    datasets: Sequence[Dataset | str | Path],
    path: str | Path,
    scorer: str = "pca",
    detector: Detector | TrueBoxes | str = "default",
) -> ModelFile:
    """Fit a scorer on the normals of one or more data sets and write its model file.

    Args:
        datasets: Data sets or their folders; failures in them are left out.
        path: The file to write.
        scorer: Name of the scorer.
        detector: As in :func:`~.evaluate.evaluate_layer2`.

    Raises:
        ConfigurationError: If the scorer is unknown or cannot be stored.
        DatasetError: If a set is faulty, or none holds a normal in which tips were found.
        ModelError: If the file cannot be written.
    """
    fitted = make_scorer(scorer)
    if not isinstance(fitted, Storable):
        raise ConfigurationError(f"scorer {scorer!r} is for comparison only: it has no model file")
    normals, used = [], []
    for item in datasets:
        data = item if isinstance(item, Dataset) else load_dataset(item)
        finder, name = find_detector(data, detector)
        found = [
            sample
            for sample in data.samples(finder)
            if sample.label == "normal" and all(sample.detections[k] for k in sample.detections)
        ]
        normals += found
        used.append(
            {"name": data.name, "source": data.source, "normals": len(found), "detector": name}
        )
    if not normals:
        raise DatasetError("no normal trajectory with a tip in every frame: nothing to fit on")
    fitted.fit(normals)
    arrays, settings = fitted.to_arrays()
    return save_model(path, scorer, arrays, settings, {"datasets": used})
