"""The alternatives that did not work for the paper (SI B), on the same wells as its own scorer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from aegis_ot.llm import Backend
from aegis_ot.vision.gates import GateInput
from aegis_ot.vocabulary import Outcome as Word
from aegis_ot.vocabulary import Route
from aegis_ot_lab.found_tips import FoundTips

from ..evaluation.layer2 import Layer2Result
from ..evaluation.layer2.metrics import f1, precision, recall
from ..scorers import BASELINES
from .context import Context, label
from .experiment import NOT_RUN, Experiment, ExperimentOutcome, Table, table
from .layer1 import NO_MODEL
from .leave_one_out import evaluate, name_of

NEVER = {
    "Vision model asked several times at a temperature, majority vote": (
        f"{NOT_RUN}: this package asks once, with three assessments of which any may fail a well"
    ),
    "Camera from above during the run": f"{NOT_RUN}: a matter of the robot's shape, not of data",
}
"""What of SI B has no counterpart here."""


def run(context: Context) -> ExperimentOutcome:
    """Every baseline on every p1000 set; the vision model where one answers."""
    tables, answers = [], []
    figures: dict[str, dict[str, Any]] = {}
    sets = context.tips("p1000")
    for data, tips in sets:
        results = evaluate(context, BASELINES, data, tips)
        told = {
            f"vision model alone, {backend.name}": _model_alone(context, backend, tips)
            for backend in context.backends
        }
        tables.append(_table(f"{data.name} ({label(data.source)} frames)", results, told))
        figures[data.name] = {one.scorer: one.to_json() for one in results}
        figures[data.name] |= told
        aurocs = {one.scorer: one.metrics["auroc"].value for one in results}
        worse = [name for name in BASELINES[1:] if aurocs[name] < aurocs["pca"]]
        shown = ", ".join(f"{name_of(name)} {value:.3f}" for name, value in aurocs.items())
        answers.append(
            f"{data.name}: AUROC {shown}; {len(worse)} of {len(BASELINES) - 1} worse than pca"
        )
    alone = "vision model alone: see the table" if context.backends else f"vision model {NO_MODEL}"
    return ExperimentOutcome(
        data=tuple(context.describe(data) for data, _ in sets),
        answers={"baselines": (*answers, alone)},
        tables=tuple(tables),
        notes=(
            "The paper gives no settings of its baselines; these are the libraries' usual ones "
            "on the same trajectory vectors, at the same threshold (each plate's first normal "
            "well). SI B's crop-based PCA on the p20 is the experiment p20.",
        ),
        figures=figures,
    )


def _table(title: str, results: Sequence[Layer2Result], told: dict[str, Any]) -> Table:
    rows = [
        (
            name_of(one.scorer),
            *(str(one.metrics[name]) for name in ("average_precision", "auroc", "f1")),
            f"{one.metrics['precision'].value:.3f}",
            f"{one.metrics['recall'].value:.3f}",
            str(one.flagged_normals),
        )
        for one in results
    ]
    for name, found in told.items():
        if isinstance(found, str):
            rows.append((name, found, "", "", "", "", ""))
        else:
            figures = [f"{found[one]:.3f}" for one in ("f1", "precision", "recall")]
            rows.append((name, "no score", "no score", *figures, found["normals"]))
    if not told:
        rows.append(("vision model alone, uncalibrated", NO_MODEL, "", "", "", "", ""))
    rows += [(name, why, "", "", "", "", "") for name, why in NEVER.items()]
    header = ("scorer", "AP", "AUROC", "F1", "precision", "recall", "normals flagged")
    return table(f"{title}: leave one plate out (the paper: all worse than pca)", header, rows)


def _model_alone(context: Context, backend: Backend, tips: FoundTips) -> dict[str, Any] | str:
    """A vision model that sees each well by itself; why not, if it gives no answer."""
    from aegis_ot.llm.vlm import VlmGate

    gate = VlmGate(backend)
    wells = [sample for sample in tips.samples if sample.failure_type != "no_tip"]
    context.progress.begin(f"Asking {backend.name} about every well", len(wells))
    words = []
    for sample in wells:
        words.append(gate.examine(GateInput(sample, Route.ALWAYS_GATE, calibrated=False)))
        context.progress.step()
    silent = [word for word in words if word.outcome is Word.UNDECIDED]
    if len(silent) == len(words):
        return f"{NOT_RUN}: {silent[0].reason}"
    failed = np.array([sample.label == "failure" for sample in wells], dtype=bool)
    flagged = np.array([word.outcome is not Word.PASS for word in words], dtype=bool)
    judged = failed, flagged.astype(np.float64), flagged
    return {
        "f1": f1(*judged),
        "precision": precision(*judged),
        "recall": recall(*judged),
        "normals": f"{int(flagged[~failed].sum())}/{int((~failed).sum())}",
        "undecided": len(silent),
    }


EXPERIMENT = Experiment(
    "baselines",
    "Baselines and negative results",
    "Layer 2 evaluation and SI B",
    ("baselines",),
    ("data", "models", "plates"),
    run,
)
