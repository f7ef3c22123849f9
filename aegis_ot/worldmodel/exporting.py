"""Recorded runs written in the trajectory data set format."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import DatasetError, StoreError
from ..progress import Progress
from ..sidecar.store.opening import open_store
from ..vision.dataset_writer import DatasetWriter
from ..vision.tips import tip_for
from ..vision.types import Detector
from ..vocabulary import KeyframeKind
from .recorded import jpegs_of, recorded_runs
from .tips import named_detector


@dataclass(frozen=True)
class Exported:
    """What came of an export.

    Attributes:
        runs: Runs of which something was written.
        written, failures: Trajectories, and how many of them are failures.
        left_out: Trajectories without a verdict, with damaged frames, or of a plate (run,
            pipette and liquid) on which no well passed.
    """

    runs: int
    written: int
    failures: int
    left_out: int


def export_runs(
    store: Path,
    folder: Path,
    runs: Sequence[str] = (),
    detector: Detector | str = "default",
    progress: Progress | None = None,
) -> Exported:
    """Write runs of a store as one data set; its labels are the verdicts.

    Raises:
        ConfigurationError: There is no store, or no such run.
        DatasetError: The folder holds a data set already, or there is nothing to write.
        StoreError: The store cannot be read.
    """
    progress = progress or Progress()
    finder, name = named_detector(detector)
    found = recorded_runs(open_store(store), finder, runs)
    left_out = sum(run.left_out for run in found)
    all_samples = [sample for run in found for sample in run.samples]
    whole = []
    progress.begin("Finding tips", len(all_samples))
    for sample in all_samples:
        try:
            for kind in KeyframeKind:
                sample.detections[kind]
            whole.append(sample)
        except StoreError:
            left_out += 1
        progress.step()
    normal_plates = {sample.plate for sample in whole if sample.label == "normal"}
    kept = [s for s in whole if s.label and s.plate in normal_plates]
    left_out += len(whole) - len(kept)
    if not kept:
        raise DatasetError(
            f"{store}: no delivery of a single tip passed, so there is nothing to write. Left out: "
            f"{left_out}, of several tips, given up, without frames, or in runs without a pass."
        )
    sources = {run.source for run in found}
    meta = {
        "source": sources.pop() if len(sources) == 1 else "synthetic",
        "runs": [run.run for run in found],
        "boxes": name,
        "tips_ul": {s.id: s.capacity_ul for s in kept if s.tip is not tip_for(s.pipette)},
        "tips_used": {s.id: s.tip_used for s in kept if s.tip_used},
        "notes": "Labels are verdicts of aegis_ot and decisions of its operators, not truth.",
    }
    progress.begin("Writing", len(kept))
    with DatasetWriter(folder, meta) as writer:
        for sample in kept:
            writer.add(sample, jpegs_of(sample))
            progress.step()
    labels = Counter(sample.label for sample in kept)
    written_runs = sum(any(sample in kept for sample in run.samples) for run in found)
    return Exported(written_runs, len(kept), labels["failure"], left_out)
