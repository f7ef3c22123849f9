"""What the live monitor costs for each trajectory, with the default scorer and with ``pca``."""

from __future__ import annotations

import json
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from .children import in_child
from .figure import Figure
from .memory import peak_mb
from .vision_data import label

SCORERS = ("ensemble", "pca")
TARGET_MS, TARGET_LAST_MS, TARGET_MODEL_MB, TARGET_MB = 120.0, 40.0, 5.0, 400.0
_WELLS = 24


def figures(datasets: Sequence[Path]) -> Iterator[Figure]:
    """Time, memory and model size, in a process and on one core of its own."""
    for folder in datasets:
        for scorer in SCORERS:
            found = in_child("vision_cost", str(folder.resolve()), scorer)
            source, data = label(found["source"]), f"{found['name']}, {found['size']}"
            default = scorer == "ensemble"
            yield Figure(
                f"{scorer}: a trajectory (4 frames, detector, scores, gate)", data, source,
                found["total_ms"], "ms", TARGET_MS if default else None,
            )  # fmt: skip
            yield Figure(
                f"{scorer}: of it after the last keyframe", data, source, found["last_ms"], "ms",
                TARGET_LAST_MS if default else None,
            )  # fmt: skip
            yield Figure(
                f"{scorer}: model file", data, source, found["model_mb"], "MB",
                TARGET_MODEL_MB if default else None, note=f"fitted on {found['normals']} normals",
            )  # fmt: skip
            yield Figure(
                f"{scorer}: peak memory of the process, fitting included", data, source,
                found["peak_mb"], "MB", TARGET_MB if default else None,
            )  # fmt: skip
    yield Figure("detector: network files", "shipped weights", "", _detector_mb(), "MB", 2.0)


def _detector_mb() -> float:
    from aegis_ot.vision.detection import load_weights

    return sum(len(load_weights(of_row=row)[0]) for row in (False, True)) / 1e6


def main(folder: str, scorer: str) -> None:
    """In the child: fit on the normals, then judge trajectories as the sidecar does."""
    import cv2

    from aegis_ot.sidecar.analysers import make_analyser
    from aegis_ot.sidecar.config import CascadeSettings
    from aegis_ot.vision.dataset import load_dataset
    from aegis_ot.worldmodel.fitting import fit_model

    cv2.setNumThreads(1)
    dataset = load_dataset(folder)
    with tempfile.TemporaryDirectory() as place:
        path = Path(place) / "model.npz"
        model = fit_model([dataset], path, scorer, measure=False)
        size_mb = path.stat().st_size / 1e6
        analyser = make_analyser(CascadeSettings(model=path))
    samples = dataset.samples(dataset.true_boxes())
    run = analyser.begin("bench")
    totals, lasts, shape = [], [], (0, 0)
    for number, sample in enumerate(samples[: _WELLS + 4]):
        total, last, shape = _trajectory(run, number, sample)
        if number >= 4:  # the first ones fill caches
            totals.append(total)
            lasts.append(last)
    found = {
        "name": dataset.name,
        "source": dataset.source,
        "size": f"{shape[1]}x{shape[0]}",
        "total_ms": statistics.median(totals),
        "last_ms": statistics.median(lasts),
        "model_mb": size_mb,
        "peak_mb": peak_mb(),
        "normals": sum(used["normals"] for used in model.data["recordings"]),
    }
    print(json.dumps(found))


def _trajectory(run: Any, number: int, sample: Any) -> tuple[float, float, tuple[int, int]]:
    """Processor time of a whole trajectory and of what follows its last frame, ms."""
    from aegis_ot.vision.camera import Frame
    from aegis_ot.vocabulary import Keyframe, KeyframeKind, WellRef

    well = WellRef("labware-1", sample.well, "", "1")
    total, begun, image = 0.0, 0.0, None
    for place, kind in enumerate(KeyframeKind):
        keyframe = Keyframe(
            run="bench", sequence=4 * number + place, trajectory=number, kind=kind,
            pipette=sample.pipette, mount="right", channels=1, tip="1:A1", sources=(well,),
            destinations=(well,), commanded_ul=sample.volume_ul,
            expected_ul=sample.expected_ul[kind], capacity_ul=sample.tip.nominal_ul,
            reagent=sample.reagent,
        )  # fmt: skip
        image = sample.frames[kind]
        frame = Frame(b"", image, 0.0)
        begun = time.process_time()
        run.observe(keyframe, frame)
        if kind is not KeyframeKind.POST_DISPENSE:
            total += time.process_time() - begun
    run.judge(number)
    last = time.process_time() - begun
    assert image is not None
    return 1e3 * (total + last), 1e3 * last, image.shape[:2]


if __name__ == "__main__":
    main(*sys.argv[1:])
