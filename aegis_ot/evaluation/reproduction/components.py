"""How many components the paper's world model needs: scree and sweep (SI C)."""

from __future__ import annotations

from dataclasses import asdict

from ...vision.crops import VECTOR_LENGTH
from ...vision.scorers.pca import COMPONENTS
from ..layer2.figures import Canvas, draw_components
from ..layer2.studies import component_sweep, explained_variance
from .context import Context, label
from .experiment import Experiment, Outcome, Picture, table


def run(context: Context) -> Outcome:
    """Scree and sweep on every p1000 set."""
    folder = context.pictures("components")
    tables, pictures, model, sweep = [], [], [], []
    figures = {}
    sets = context.tips("p1000")
    for data, tips in sets:
        explained = explained_variance(tips.samples)
        points = component_sweep(tips.samples, context.progress)
        title = f"{data.name} ({label(data.source)} frames)"
        canvas = Canvas(folder / data.name, title)
        draw_components(canvas, explained, points)
        names = ("Variance explained", "Number of components, F1 and threshold")
        pictures += [
            Picture(context.picture(file), f"{name}: {title}")
            for file, name in zip(canvas.paths, names, strict=True)
        ]
        tables.append(
            table(
                f"{title}: leave one plate out by number of components",
                ("k", "F1", "precision", "recall", "median threshold"),
                [
                    (p.components, f"{p.f1:.3f}", f"{p.precision:.3f}", f"{p.recall:.3f}",
                     f"{p.threshold:.3g}")
                    for p in points
                ],
            )
        )  # fmt: skip
        share = explained[min(COMPONENTS, len(explained)) - 1]
        by_k = {point.components: point for point in points}
        fall = by_k[25].threshold / by_k[15].threshold if by_k[15].threshold else float("nan")
        model.append(
            f"{data.name}: {VECTOR_LENGTH}-vector, k = {COMPONENTS}: {share:.1%} of variance"
        )
        sweep.append(
            f"{data.name}: F1 {by_k[2].f1:.3f} at k = 2, {by_k[15].f1:.3f} at 15, "
            f"{by_k[25].f1:.3f} at 25; threshold times {fall:.1e} from 15 to 25"
        )
        figures[data.name] = {
            "explained": explained.tolist(),
            "sweep": [asdict(point) for point in points],
        }
    return Outcome(
        data=tuple(context.describe(data) for data, _ in sets),
        answers={"world-model": "; ".join(model), "components": "; ".join(sweep)},
        tables=tuple(tables),
        pictures=tuple(pictures),
        notes=(
            "Leave one plate out, 23 to 25 normals are left to learn from: a model has at most one "
            "component fewer, and one of 25 is as many as there are. The paper's threshold falls "
            "to rounding noise where the calibration well was learned from; held out, as here, it "
            "need not.",
        ),
        figures=figures,
    )


EXPERIMENT = Experiment(
    "components",
    "Components of the paper's world model",
    "Methods, PCA; SI C, Fig. scree and Fig. component sweep",
    ("world-model", "components"),
    ("data", "plates"),
    run,
)
