"""Recorded runs as trajectories: what a sidecar's store keeps, as the vision room sees it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from ..errors import ConfigurationError, StoreError
from ..run_view.overview import DeliveryEntry
from ..sidecar.overview import run_overview
from ..sidecar.store import Store
from ..vision.dataset import LazyDetections
from ..vision.dataset_checks import in_data_sets
from ..vision.types import Detector, Image, TrajectorySample
from ..vocabulary import FAILURES, FailureType, KeyframeKind, Outcome


@dataclass(frozen=True)
class RecordedRun:
    """One run of a store.

    Attributes:
        run: Its identifier.
        protocol: File name.
        source: ``"synthetic"`` for a simulated robot, or a camera that draws or replays its frames,
            else ``"real"``: what figures on its frames are called.
        samples: Trajectories with all four frames. Their label is the verdict as it stands after
            the operator: ``"normal"`` for a pass, ``"failure"`` for a fail whose type the data
            set format knows, ``""`` for all others.
        entries: The deliveries of the samples in the run's overview.
        left_out: Trajectories without four timely frames, given up, or of several tips.
    """

    run: str
    protocol: str
    source: str
    samples: Sequence[TrajectorySample]
    entries: Sequence[DeliveryEntry]
    left_out: int


def run_source(row: Mapping[str, Any]) -> str:
    """What figures on a run's frames are called, from the store's account of the run."""
    return "synthetic" if row.get("simulated") else "real"


def recorded_runs(store: Store, detector: Detector, runs: Sequence[str] = ()) -> list[RecordedRun]:
    """Runs of a store, oldest first; frames are decoded, and tips found, when asked for.

    Args:
        store: See :func:`~aegis_ot.sidecar.store.opening.open_store`.
        detector: Finds the tips anew: a store keeps boxes, but no axes.
        runs: Which runs; all if left out.

    Raises:
        ConfigurationError: A run is not in the store.
        StoreError: The store cannot be read.
    """
    known = {str(row["run"]): row for row in reversed(store.runs())}
    unknown = [run for run in runs if run not in known]
    if unknown:
        raise ConfigurationError(
            f"{store.folder} holds no run {unknown[0]!r}; it holds "
            f"{', '.join(list(known)[-10:]) or 'none'}."
        )
    return [_run(store, known[run], detector) for run in runs or known]


def _run(store: Store, row: Mapping[str, Any], detector: Detector) -> RecordedRun:
    run, source = str(row["run"]), run_source(row)
    entries = run_overview(store, run)["trajectories"]
    samples, kept = [], []
    for entry in entries:
        keyframes = {KeyframeKind(k["kind"]): k for k in entry["keyframes"] if not k["late"]}
        # Rows of tips are judged tip by tip; a trajectory of one tip is what is learned from.
        row_of_tips = any(keyframe.get("nozzles") for keyframe in keyframes.values())
        if entry["abandoned"] is None and len(keyframes) == len(KeyframeKind) and not row_of_tips:
            samples.append(_sample(store, run, entry, keyframes, detector, source))
            kept.append(entry)
    return RecordedRun(
        run, str(row.get("protocol", "")), source, samples, kept, len(entries) - len(samples)
    )


def _sample(
    store: Store,
    run: str,
    entry: Mapping[str, Any],
    keyframes: Mapping[KeyframeKind, Mapping[str, Any]],
    detector: Detector,
    source: str,
) -> TrajectorySample:
    last = keyframes[KeyframeKind.POST_DISPENSE]
    sequences = {kind: int(keyframes[kind]["sequence"]) for kind in KeyframeKind}
    frames = StoredFrames(store, run, sequences)
    wells = last["destinations"] or last["sources"]
    label, failure, retained = _label(entry["verdict"], float(last["commanded_ul"]))
    reagent = last["reagent"] or ""
    return TrajectorySample(
        id=f"{run}-{entry['trajectory']}",
        # What is calibrated together: one run, one pipette, one liquid.
        plate=" ".join(filter(None, (run, last["mount"], reagent))),
        well=wells[0]["name"] if wells else "",
        pipette=in_data_sets(last["pipette"]),
        capacity_ul=float(last["capacity_ul"]),
        tip_used=last["tip"],
        volume_ul=float(last["commanded_ul"]),
        frames=frames,
        detections=LazyDetections(frames, dict.fromkeys(KeyframeKind, ""), detector),
        expected_ul={kind: float(keyframes[kind]["expected_ul"]) for kind in KeyframeKind},
        reagent=reagent,
        label=label,
        failure_type=failure,
        retained_fraction=retained,
        positions={
            kind: (float(place[0]), float(place[1]), float(place[2]))
            for kind, keyframe in keyframes.items()
            if source == "real" and (place := keyframe.get("position")) is not None
        },
    )


def _label(verdict: Mapping[str, Any] | None, commanded_ul: float) -> tuple[str, str, float | None]:
    if verdict is None or verdict["outcome"] == Outcome.UNDECIDED.value:
        return "", "", None
    if verdict["outcome"] == Outcome.PASS.value:
        return "normal", "", None
    known = FAILURES[FailureType(verdict["failure"])] if verdict["failure"] else None
    if known is None or not known.label:
        return "", "", None
    retained = None
    if known.stays and verdict["measured_ul"] is not None:
        retained = min(float(verdict["measured_ul"]) / max(commanded_ul, 1e-9), 1.0)
    return "failure", known.label, retained


class StoredFrames(Mapping[KeyframeKind, Image]):
    """The four frames of one recorded trajectory, decoded on each access and not kept.

    Raises :class:`~aegis_ot.errors.StoreError` where a frame is missing or damaged.
    """

    def __init__(self, store: Store, run: str, sequences: Mapping[KeyframeKind, int]) -> None:
        self._store, self._run, self._sequences = store, run, sequences

    def jpeg(self, kind: KeyframeKind) -> bytes:
        """The frame as the camera gave it."""
        data = self._store.frame(self._run, self._sequences[kind])
        if not data:
            raise StoreError(
                f"Frame {self._sequences[kind]} of run {self._run} is missing or empty in "
                f"{self._store.folder}."
            )
        return data

    def __getitem__(self, kind: KeyframeKind) -> Image:
        image = cv2.imdecode(np.frombuffer(self.jpeg(kind), np.uint8), cv2.IMREAD_COLOR)
        if image is None:
            raise StoreError(
                f"Frame {self._sequences[kind]} of run {self._run} in {self._store.folder} is "
                "damaged."
            )
        return np.asarray(image, dtype=np.uint8)

    def __iter__(self) -> Iterator[KeyframeKind]:
        return iter(self._sequences)

    def __len__(self) -> int:
        return len(self._sequences)


def jpegs_of(sample: TrajectorySample) -> dict[KeyframeKind, bytes] | None:
    """The frames as the camera gave them, ``None`` where the sample is not a recorded one."""
    frames = sample.frames
    return {k: frames.jpeg(k) for k in KeyframeKind} if isinstance(frames, StoredFrames) else None
