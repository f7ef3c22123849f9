"""Build the world model of a lab from its recorded normal runs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from numpy.typing import NDArray

from ..errors import ConfigurationError, DatasetError, StoreError
from ..progress import Progress
from ..sidecar.analysers import load_scorer
from ..sidecar.store.opening import is_store, open_store
from ..vision.dataset import Dataset, TrueBoxes, load_dataset
from ..vision.lab_limits import LabLimits
from ..vision.models import SHIPPED, ModelFile, save_model
from ..vision.scorers import make_scorer
from ..vision.types import Detector, Scorer, TrajectorySample
from .detection_limits import smallest_caught
from .leave_one_out import hold_out, score_with
from .limits import ENOUGH, FittedLimit, LimitGoal, fit_limits
from .recorded import recorded_runs
from .tips import find_detector, named_detector

STORED = ("pca", "column", "pair", "ensemble")
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
    start: str = "",
    wanted: LimitGoal | None = None,
) -> ModelFile:
    """Fit a scorer on the normals of recorded runs, and the lab's own limits on what failed.

    Args:
        recordings: Data sets, or folders of data sets or of a sidecar's store. Of a data set the
            wells labelled normal are taken, and failures for the limits; of a store those that
            passed as things stand after the operator. A well in whose frames a tip is missing is
            left out.
        path: The file to write.
        scorer: Name of the scorer.
        detector: As in :func:`~.evaluate.evaluate_layer2`; true boxes serve data sets only.
        progress: Told how far it is.
        measure: Find out the smallest retained volume that a live run would catch, see
            :mod:`.detection_limits`; takes as long as an evaluation.
        start: ``"shipped"``: keep the shipped scorer, and fit limits alone.
        wanted: What the limits are to do.

    Returns:
        What was written. Its ``data["recordings"]`` names each recording with its ``source``
        (``"rendered"``, ``"synthetic"``, ``"real"``), its plates or runs, and how many normals
        were taken and left out; ``data["smallest"]`` what this camera would let be caught;
        ``data["limits"]`` what each limit would have done to the wells that made it.

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
    if start not in ("", "shipped"):
        raise ConfigurationError(f"a model starts from nothing, or from 'shipped', not {start!r}")
    wells: list[TrajectorySample] = []
    used: list[dict[str, Any]] = []
    for number, item in enumerate(recordings):
        for found, told in _labelled(item, detector):
            # Plates of other sets may bear the same names, and have other cameras.
            own = [replace(sample, plate=f"{number}:{sample.plate}") for sample in found]
            taken = _with_tips(own, f"Finding tips, {told['name']}", progress)
            wells += taken
            normal = sum(sample.label == "normal" for sample in taken)
            left_out = sum(sample.label == "normal" for sample in found) - normal
            used.append(told | {"normals": normal, "left_out": left_out})
    normals = [sample for sample in wells if sample.label == "normal"]
    if not normals:
        raise DatasetError(
            "There is no normal trajectory with a tip in every frame: nothing to learn from."
        )
    fitted = load_scorer(SHIPPED) if start else make_scorer(scorer)
    assert isinstance(fitted, Storable)
    if not start:
        _fit(fitted, normals, progress)
    seen = []
    if measure and not start and hasattr(fitted, "p_value"):
        seen = smallest_caught(normals, lambda: make_scorer(scorer), progress)
    limits, told_limits = _limits(wells, fitted if start else None, scorer, wanted, progress)
    arrays, settings = fitted.to_arrays()
    more, its = limits.to_arrays()
    told = {
        "recordings": used,
        "smallest": [one.to_json() for one in seen],
        "limits": [one.to_json() for one in told_limits],
    }
    return save_model(path, fitted.name, arrays | more, settings | its, told)


def _fit(fitted: Scorer, normals: Sequence[TrajectorySample], progress: Progress) -> None:
    progress.begin(f"Fitting {fitted.name} on {len(normals)} normal wells", 1)
    try:
        fitted.fit(normals)
    except ValueError as error:
        raise DatasetError(
            f"Scorer {fitted.name!r} cannot learn from {len(normals)} normal wells ({error}); "
            "record more of them."
        ) from error
    progress.step()


def _limits(
    wells: Sequence[TrajectorySample], shipped: Scorer | None, scorer: str,
    wanted: LimitGoal | None, progress: Progress,
) -> tuple[LabLimits, list[FittedLimit]]:  # fmt: skip
    """Limits of liquids whose failures are labelled; none where there are too few."""
    failures = sum(sample.label == "failure" for sample in wells)
    if failures < ENOUGH or (shipped is None and not hasattr(make_scorer(scorer), "p_value")):
        return LabLimits({}), []
    try:
        held = (
            score_with(wells, shipped, progress)
            if shipped is not None
            else hold_out(wells, lambda: make_scorer(scorer), "p-value", progress)
        )
    except DatasetError:
        return LabLimits({}), []  # a single plate: nothing judged it that had not learned it
    found = fit_limits(held, wanted)
    return found.limits, found.reports


def _labelled(
    item: Dataset | str | Path, detector: Detector | TrueBoxes | str
) -> list[tuple[list[TrajectorySample], dict[str, Any]]]:
    """Labelled wells of a data set, or normal ones of each run of a store, and what to call them:
    of a store nobody knows for certain what failed."""
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
    labelled = [sample for sample in data.samples(boxes) if sample.label]
    told = {"name": data.name, "source": data.source, "plates": list(data.plates), "detector": name}
    return [(labelled, told)]


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
