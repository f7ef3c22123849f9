"""How many components the paper's world model needs: scree and sweep (SI C)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict

import numpy as np

from aegis_ot.vision.crops import VECTOR_LENGTH
from aegis_ot.vision.dataset import first_normals
from aegis_ot.vision.scorers.pca import COMPONENTS, PcaScorer
from aegis_ot.vision.types import TrajectorySample

from ..evaluation.layer2.figures import Canvas, draw_components
from ..evaluation.layer2.studies import component_sweep, explained_variance
from .context import Context, label
from .experiment import Experiment, ExperimentOutcome, ExperimentPicture, table


def run(context: Context) -> ExperimentOutcome:
    """Scree and sweep on every p1000 set."""
    folder = context.pictures("components")
    tables, pictures, model, sweep = [], [], [], []
    figures = {}
    sets = context.tips("p1000")
    for data, tips in sets:
        explained = explained_variance(tips.samples)
        points = component_sweep(tips.samples, context.progress)
        inside = {p.components: learned_threshold(tips.samples, p.components) for p in points}
        title = f"{data.name} ({label(data.source)} frames)"
        canvas = Canvas(folder / data.name, title)
        draw_components(canvas, explained, points)
        names = ("Variance explained", "Number of components, F1 and threshold")
        pictures += [
            ExperimentPicture(context.picture(file), f"{name}: {title}")
            for file, name in zip(canvas.paths, names, strict=True)
        ]
        tables.append(
            table(
                f"{title}: leave one plate out by number of components",
                ("k", "F1", "precision", "recall", "median threshold, plate held out",
                 "median threshold, plate learned from"),
                [
                    (p.components, f"{p.f1:.3f}", f"{p.precision:.3f}", f"{p.recall:.3f}",
                     f"{p.threshold:.3g}", f"{inside[p.components]:.3g}")
                    for p in points
                ],
            )
        )  # fmt: skip
        share = explained[min(COMPONENTS, len(explained)) - 1]
        by_k = {point.components: point for point in points}
        model.append(
            f"{data.name}: {VECTOR_LENGTH}-vector, k = {COMPONENTS}: {share:.1%} of variance"
        )
        sweep.append(
            f"{data.name}: F1 {by_k[2].f1:.3f} at k = 2, {by_k[15].f1:.3f} at 15, "
            f"{by_k[25].f1:.3f} at 25; threshold from 15 to 25: times "
            f"{_ratio(by_k[25].threshold, by_k[15].threshold)} with the plate held out, times "
            f"{_ratio(inside[25], inside[15])} with it learned from"
        )
        figures[data.name] = {
            "explained": explained.tolist(),
            "sweep": [asdict(point) for point in points],
            "learned_threshold": {str(k): value for k, value in inside.items()},
        }
    return ExperimentOutcome(
        data=tuple(context.describe(data) for data, _ in sets),
        answers={"world-model": tuple(model), "components": tuple(sweep)},
        tables=tuple(tables),
        pictures=tuple(pictures),
        notes=(
            "The paper's threshold collapses to rounding noise: that is the score of a well that "
            "the model learned from. Of a plate that is held out, the first normal well's is not.",
        ),
        figures=figures,
    )


def learned_threshold(samples: Sequence[TrajectorySample], components: int) -> float:
    """Median over the plates of the first normal's score by a model that learned from it."""
    scorer = PcaScorer(components)
    scorer.fit([sample for sample in samples if sample.label == "normal"])
    return float(np.median([scorer.score(one) for one in first_normals(samples).values()]))


def _ratio(value: float, base: float) -> str:
    return f"{value / base:.1e}" if base else "unknown"


EXPERIMENT = Experiment(
    "components",
    "Components of the paper's world model",
    "Methods, PCA; SI C, Fig. scree and Fig. component sweep",
    ("world-model", "components"),
    ("data", "plates"),
    run,
)
