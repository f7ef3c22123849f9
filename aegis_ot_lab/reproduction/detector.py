"""The tip detector on labelled frames (paper, Tip detection)."""

from __future__ import annotations

from dataclasses import asdict

from aegis_ot.vision.detection import HeatmapDetector

from ..training.figures import measure, read_images
from ..training.recorded import read_frames
from .context import PIPETTES, Context, label
from .experiment import Experiment, ExperimentOutcome, table


def run(context: Context) -> ExperimentOutcome:
    """The shipped detector on every frame of every set that has labelled tips."""
    detector = HeatmapDetector()
    rows, answers, figures, used = [], [], {}, []
    for pipette in PIPETTES:
        for data in context.sets(pipette):
            if not data.boxes:
                continue
            context.progress.begin(f"Finding tips, {data.name}", 1)
            found = measure(detector, read_images(read_frames(data.root)))
            context.progress.step()
            used.append(data)
            figures[data.name] = asdict(found)
            answers.append(f"{data.name}: mAP50 {found.map50:.3f}")
            rows.append(
                (data.name, label(data.source), f"{found.map50:.3f}", f"{found.found:.3f}",
                 f"{found.false_alarms}/{found.empty_frames}", f"{found.mean_overlap:.3f}")
            )  # fmt: skip
    return ExperimentOutcome(
        data=tuple(context.describe(data) for data in used),
        answers={"detector": tuple(answers)},
        tables=(
            table(
                "The shipped detector (the paper: mAP50 0.995)",
                ("set", "frames", "mAP50", "found, IoU over 0.5", "false alarms", "mean IoU"),
                rows,
            ),
        ),
        notes=(
            "The shipped network was trained on drawn, simulated and rendered frames, not on 69 "
            "labelled ones of one camera; `aegis-ot train detector` trains one on frames of your "
            "own. Some plates of the rendered sets were among what it learned from.",
        ),
        figures=figures,
    )


EXPERIMENT = Experiment(
    "detector", "Tip detector", "Methods, Tip detection", ("detector",), ("data", "plates"), run
)
