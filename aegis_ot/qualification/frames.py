"""The frames of a qualification as a data set with true labels, and an archive to give away."""

from __future__ import annotations

import json
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np

from ..errors import ConfigurationError, DatasetError
from ..planted import NO_TIP, NORMAL
from ..sidecar.store import Store
from ..vision.dataset import Dataset
from ..vision.dataset_writer import DatasetWriter
from ..vision.registration import TipLocator
from ..vision.tips import tip_for
from ..vision.types import Detector, Image, TipDetection, TrajectorySample
from ..vocabulary import KeyframeKind
from ..worldmodel.recorded import jpegs_of, recorded_runs
from ..worldmodel.registered_tips import located_tips
from .plan import QualificationPlan, QualifyingDelivery

NOTES = (
    "Written by aegis-ot qualify: what each delivery was is known, because the robot did it on "
    "purpose. A plate is half of a liquid's deliveries, and begins with normal ones. Boxes are the "
    "detector's or, where the robot's positions registered the camera, projected: nobody drew them."
)


def true_samples(
    store: Store, run: str, plan: QualificationPlan, detector: Detector
) -> tuple[list[TrajectorySample], str]:
    """The deliveries of a run with four frames, labelled by the plan, and what their frames are.

    Args:
        store, run, plan: As for :func:`~.opening.open_plan`, which checks them.
        detector: Finds the tips; the robot's positions register the camera, on real frames.
    """
    recorded = recorded_runs(store, detector, [run])[0]
    by_id = {f"{run}-{number}": planned for number, planned in enumerate(plan.deliveries)}
    samples = [_truly(each, by_id[each.id]) for each in recorded.samples if each.id in by_id]
    return with_located_tips(samples, detector), recorded.source


def with_located_tips(
    samples: Sequence[TrajectorySample], detector: Detector
) -> list[TrajectorySample]:
    """The deliveries of one run with the boxes of their tips: projected where the robot's positions
    register the camera, none where a tip was planted away."""
    located: Mapping[str, Mapping[KeyframeKind, TipDetection | None]] = {}
    if any(each.positions for each in samples):
        located = located_tips(samples, TipLocator(detector))
    without: Mapping[KeyframeKind, TipDetection | None] = dict.fromkeys(KeyframeKind)
    return [
        replace(
            each,
            detections=without
            if each.failure_type == NO_TIP
            else located.get(each.id, each.detections),
        )
        for each in samples
    ]


def _truly(sample: TrajectorySample, planned: QualifyingDelivery) -> TrajectorySample:
    return replace(
        sample,
        plate=f"{planned.liquid} {planned.half}",
        reagent=planned.liquid,
        label="normal" if planned.kind == NORMAL else "failure",
        failure_type=planned.failure_type,
        retained_fraction=planned.leftover,
    )


def write_frames(folder: Path, samples: Sequence[TrajectorySample], source: str) -> Path:
    """Write them as a data set that ``fit``, ``evaluate`` and ``train`` take.

    Raises:
        DatasetError: The folder holds a data set already.
        StoreError: A frame is missing or damaged.
    """
    meta = {
        "source": source,
        "notes": NOTES,
        "tips_ul": {s.id: s.capacity_ul for s in samples if s.tip is not tip_for(s.pipette)},
    }
    with DatasetWriter(folder, meta) as writer:
        for sample in samples:
            writer.add(sample, jpegs_of(sample))
    return folder


def export_archive(data: Dataset, archive: Path, licence: str) -> int:
    """Write an anonymous archive: frames cut to the tip, what was planted, and nothing else.

    Neither robot, run, date nor the rest of the frame is in it; trajectories are numbered. JPEG
    files are written anew, without what a camera may have noted in them.

    Args:
        data: What :func:`write_frames` wrote.
        archive: The ``.zip`` to write.
        licence: Under which it may be used, a line.

    Returns:
        How many deliveries it holds; those in which no tip was found at all are left out.

    Raises:
        ConfigurationError: No licence is named, or the file is there already.
        DatasetError: No delivery can be cut.
    """
    if not licence.strip():
        raise ConfigurationError(
            "Name the licence under which the archive may be used, as in --licence CC-BY-4.0."
        )
    if archive.exists():
        raise ConfigurationError(f"{archive} is there already; name a new file.")
    samples = data.samples(data.true_boxes())
    windows = _windows(samples)
    rows, written = [], 0
    archive.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(archive, "w") as packed:
        for sample in samples:
            cut = windows.get(sample.plate)
            if cut is None:
                continue
            written += 1
            for kind in KeyframeKind:
                box = sample.detections[kind]
                jpeg = _cut(sample.frames[kind], box, cut[kind]) if kind in cut else None
                if jpeg is not None:
                    packed.writestr(_undated(f"{written:04}_{kind.value}.jpg"), jpeg)
            rows.append(
                {
                    "delivery": written,
                    "plate": data.plates.index(sample.plate) + 1,
                    "pipette": sample.pipette,
                    "tip_ul": sample.tip.nominal_ul,
                    "liquid": _LOOKS.get(sample.reagent.lower(), "unknown"),
                    "volume_ul": sample.volume_ul,
                    "label": sample.label,
                    "failure_type": sample.failure_type,
                    "retained_fraction": sample.retained_fraction,
                }
            )
        about = {"source": data.source, "licence": licence.strip(), "deliveries": rows}
        packed.writestr(_undated("deliveries.json"), json.dumps(about, indent=1) + "\n")
        packed.writestr(_undated("LICENCE.txt"), licence.strip() + "\n")
    if not written:
        archive.unlink()
        raise DatasetError(f"{data.root}: no tip was found in its frames; there is nothing to cut.")
    return written


def _undated(name: str) -> zipfile.ZipInfo:
    """An entry of an archive that does not say when it was written."""
    entry = zipfile.ZipInfo(name)
    entry.external_attr = 0o644 << 16
    return entry


_LOOKS = {"water": "clear", "dye": "dye"}
"""What a liquid's name tells of its look; any other name may hide anything."""

_Window = Mapping[KeyframeKind, tuple[float, float, float, float]]


def _windows(samples: Sequence[TrajectorySample]) -> dict[str, _Window]:
    """By plate, the usual box at each keyframe: where a tip that is missing would be."""
    found: dict[str, dict[KeyframeKind, list[tuple[float, ...]]]] = {}
    for sample in samples:
        for kind in KeyframeKind:
            if (box := sample.detections[kind]) is not None:
                of_plate = found.setdefault(sample.plate, {})
                of_plate.setdefault(kind, []).append((box.x, box.y, box.w, box.h))
    return {
        plate: {kind: tuple(np.median(boxes, axis=0)) for kind, boxes in kinds.items()}
        for plate, kinds in found.items()
    }


def _cut(
    image: Image, tip: TipDetection | None, usual: tuple[float, float, float, float]
) -> bytes | None:
    x, y, w, h = usual if tip is None else (tip.x, tip.y, tip.w, tip.h)
    left, top = max(int(x - w), 0), max(int(y - 0.08 * h), 0)
    part = image[top : int(y + 1.08 * h) + 1, left : int(x + 2 * w) + 1]
    if not part.size:
        return None
    ok, jpeg = cv2.imencode(".jpg", part, [cv2.IMWRITE_JPEG_QUALITY, 95])
    return jpeg.tobytes() if ok else None
