"""Build the world model of a lab from its recorded normal runs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from numpy.typing import NDArray

from ..errors import ConfigurationError, DatasetError, StoreError
from ..progress import Progress
from ..sidecar.opening import is_store, open_store
from ..vision.dataset import Dataset, TrueBoxes, load_dataset
from ..vision.models import ModelFile, save_model
from ..vision.scorers import make_scorer
from ..vision.types import Detector, TrajectorySample
from .detection_limits import smallest_caught
from .recorded import recorded_runs
from .tips import find_detector, named_detector

STORED = ("pca", "column", "patches", "ensemble")
"""Scorers that have a model file; the others are for comparison."""


@runtime_checkable
class Storable(Protocol):
    """A scorer that can be written to a model file."""

    def to_arrays(self) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
        """Arrays and settings."""


def fit_model(
    recordings: Sequence[Dataset | str | Path],
    path: str | Path,
    scorer: str = "ensemble",
    detector: Detector | TrueBoxes | str = "default",
    progress: Progress | None = None,
    measure: bool = True,
) -> ModelFile:
    """Fit a scorer on the normals of recorded runs and write its model file.

    Args:
        recordings: Data sets, or folders of data sets or of a sidecar's store. Of a data set the
            wells labelled normal are taken, of a store those that passed as things stand after
            the operator. A well in whose frames a tip is missing is left out.
        path: The file to write.
        scorer: Name of the scorer.
        detector: As in :func:`~.evaluate.evaluate_layer2`; true boxes serve data sets only.
        progress: Told how far it is.
        measure: Find out the smallest retained volume that a live run would catch, see
            :mod:`.smallest`; takes as long as an evaluation.

    Returns:
        What was written. Its ``data["recordings"]`` names each recording with its ``source``
        (``"rendered"``, ``"synthetic"``, ``"real"``), its plates or runs, and how many normals
        were taken and left out; ``data["smallest"]`` what this camera would let be caught.

    Raises:
        ConfigurationError: If the scorer is unknown or cannot be stored, or a folder holds
            neither a data set nor a store.
        DatasetError: If a set is faulty, or there are too few normals in which tips were found.
        StoreError: If a store cannot be read.
        ModelError: If the file cannot be written.
    """
    progress = progress or Progress()
    if scorer not in STORED:
        raise ConfigurationError(
            f"scorer {scorer!r} has no model file; choose one of {', '.join(STORED)}"
        )
    fitted = make_scorer(scorer)
    assert isinstance(fitted, Storable)
    normals: list[TrajectorySample] = []
    used: list[dict[str, Any]] = []
    for number, item in enumerate(recordings):
        for found, told in _normals(item, detector):
            # Plates of other sets may bear the same names, and have other cameras.
            own = [replace(sample, plate=f"{number}:{sample.plate}") for sample in found]
            taken = _with_tips(own, f"Finding tips, {told['name']}", progress)
            normals += taken
            used.append(told | {"normals": len(taken), "left_out": len(found) - len(taken)})
    if not normals:
        raise DatasetError(
            "There is no normal trajectory with a tip in every frame: nothing to learn from."
        )
    progress.begin(f"Fitting {scorer} on {len(normals)} normal wells", 1)
    try:
        fitted.fit(normals)
    except ValueError as error:
        raise DatasetError(
            f"Scorer {scorer!r} cannot learn from {len(normals)} normal wells ({error}); "
            "record more of them."
        ) from error
    progress.step()
    seen = []
    if measure and hasattr(fitted, "p_value"):
        seen = smallest_caught(normals, lambda: make_scorer(scorer), progress)
    arrays, settings = fitted.to_arrays()
    told = {
        "recordings": used,
        "smallest": [one.to_json() for one in seen],
    }
    return save_model(path, scorer, arrays, settings, told)


def _normals(
    item: Dataset | str | Path, detector: Detector | TrueBoxes | str
) -> list[tuple[list[TrajectorySample], dict[str, Any]]]:
    """Normal trajectories of a data set, or of each run of a store, and what to call them."""
    if not isinstance(item, Dataset) and is_store(Path(item)):
        if isinstance(detector, TrueBoxes) or detector == "true":
            raise ConfigurationError(f"{item} is a store: it has no true boxes.")
        finder, name = named_detector(detector)
        return [
            (
                [sample for sample in run.samples if sample.label == "normal"],
                {"name": run.run, "source": run.source, "protocol": run.protocol, "detector": name},
            )
            for run in recorded_runs(open_store(Path(item)), finder)
        ]
    data = item if isinstance(item, Dataset) else load_dataset(item)
    boxes, name = find_detector(data, detector)
    normals = [sample for sample in data.samples(boxes) if sample.label == "normal"]
    told = {
        "name": data.name,
        "source": data.source,
        "plates": list(data.plates),
        "detector": name,
    }
    return [(normals, told)]


def _with_tips(
    samples: Sequence[TrajectorySample], what: str, progress: Progress
) -> list[TrajectorySample]:
    progress.begin(what, len(samples))
    found = []
    for sample in samples:
        try:
            if all(sample.detections[kind] is not None for kind in sample.detections):
                found.append(sample)
        except StoreError:  # a frame that a power cut tore: one well fewer
            pass
        progress.step()
    return found
