"""Figures of a Layer 2 evaluation, each labelled with where its frames come from."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from sklearn.metrics import precision_recall_curve, roc_curve

from ...vision.scorers.pca import COMPONENTS, PcaScorer, matrix
from ...vision.types import Scorer, TrajectorySample
from .lopo import hold_out
from .metrics import auroc, f1, precision, recall
from .result import Layer2Result

SWEEP = (2, 5, 8, 10, 12, 15, 18, 20, 25)
"""The paper's numbers of components (SI C)."""


def draw_figures(
    result: Layer2Result,
    folder: str | Path,
    samples: Sequence[TrajectorySample] = (),
    make: Callable[[], Scorer] | None = None,
) -> list[Path]:
    """Draw all figures that the material allows, as PNG files.

    Args:
        result: An evaluation.
        folder: Where to write; made if need be.
        samples: The set's trajectories: with them, scree, component sweep and sample complexity
            are drawn too (minutes for slow scorers).
        make: Makes the scorer of the sample-complexity curve, which the result's threshold must
            fit; by default the paper's PCA with the paper's threshold.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    figures = {
        "precision_recall": _precision_recall,
        "roc": _roc,
        "failure_types": _bars,
        "scores": _strip,
    }
    paths = [_draw(folder / f"{name}.png", result, draw) for name, draw in figures.items()]
    if samples:
        paths.append(_draw(folder / "scree.png", result, lambda axes, _: _scree(axes, samples)))
        paths.append(
            _draw(folder / "components.png", result, lambda axes, _: _sweep(axes, samples))
        )
        paths.append(
            _draw(
                folder / "sample_complexity.png",
                result,
                lambda axes, _: _complexity(
                    axes,
                    samples,
                    make or PcaScorer,
                    result.threshold if make else "first-normal",
                ),
            )
        )
    return paths


def _draw(path: Path, result: Layer2Result, draw: Callable[[Any, Layer2Result], None]) -> Path:
    # The object interface of matplotlib: no window system, no state shared between threads.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5.2, 3.6), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    draw(axes, result)
    axes.set_title(f"{result.scorer}, {result.dataset} ({result.source} frames)", fontsize=9)
    figure.savefig(path, dpi=150)
    return path


def _arrays(result: Layer2Result) -> tuple[Any, Any, Any]:
    failed = np.array([well.failed for well in result.wells], dtype=bool)
    standing = np.array([well.standing for well in result.wells])
    return failed, standing, np.array(result.flagged, dtype=bool)


def _precision_recall(axes: Any, result: Layer2Result) -> None:
    failed, standing, _ = _arrays(result)
    axes.set(xlabel="recall", ylabel="precision", xlim=(0, 1.02), ylim=(0, 1.02))
    if failed.any():
        up, along, _ = precision_recall_curve(failed, standing)
        axes.step(along, up, where="post", label=f"AP {result.metrics['average_precision']}")
        axes.axhline(failed.mean(), ls=":", c="grey", label=f"prevalence {failed.mean():.2f}")
    point = result.metrics["recall"].value, result.metrics["precision"].value
    axes.plot(*point, "o", c="black", label=f"operating point, F1 {result.metrics['f1'].value:.3f}")
    axes.legend(fontsize=7, loc="lower left")


def _roc(axes: Any, result: Layer2Result) -> None:
    failed, standing, flagged = _arrays(result)
    axes.set(xlabel="false alarm rate", ylabel="recall", xlim=(-0.02, 1), ylim=(0, 1.02))
    axes.plot([0, 1], [0, 1], ls=":", c="grey")
    if failed.any() and not failed.all():
        along, up, _ = roc_curve(failed, standing)
        axes.plot(along, up, label=f"AUROC {result.metrics['auroc']}")
        axes.plot(flagged[~failed].mean(), flagged[failed].mean(), "o", c="black")
        axes.legend(fontsize=7, loc="lower right")


def _bars(axes: Any, result: Layer2Result) -> None:
    shares = {**result.per_failure_type(), **result.per_reagent()}
    if result.no_tip.total:
        shares["no_tip"] = result.no_tip
    heights = [share.caught / share.total for share in shares.values()]
    positions = np.arange(len(shares))
    axes.bar(positions, heights, color="tab:blue")
    for position, share in zip(positions, shares.values(), strict=True):
        axes.text(position, 1.02, str(share), ha="center", fontsize=7)
    axes.set_xticks(positions, list(shares), rotation=45, ha="right", fontsize=7)
    axes.set(ylabel="caught", ylim=(0, 1.12))


def _strip(axes: Any, result: Layer2Result) -> None:
    kinds = ["normal", *result.per_failure_type()]
    rng = np.random.default_rng(0)
    for position, kind in enumerate(kinds):
        values = [w.standing for w in result.wells if (w.sample.failure_type or "normal") == kind]
        spread = rng.uniform(-0.2, 0.2, len(values))
        axes.plot(position + spread, values, "o", ms=3, alpha=0.7)
    axes.axhline(0, ls="--", c="black", lw=0.8)
    axes.set_xticks(np.arange(len(kinds)), kinds, rotation=45, ha="right", fontsize=7)
    axes.set(ylabel="score against the threshold")


def _scree(axes: Any, samples: Sequence[TrajectorySample]) -> None:
    normals = [sample for sample in samples if sample.label == "normal"]
    pca = PcaScorer(len(normals))
    pca.fit_vectors(matrix(normals))
    explained = pca.explained
    axes.plot(np.arange(1, len(explained) + 1), explained, "o-", ms=3)
    axes.axvline(COMPONENTS, ls=":", c="grey")
    axes.set(xlabel="components (pca)", ylabel="variance explained", ylim=(0, 1.02))


def _sweep(axes: Any, samples: Sequence[TrajectorySample]) -> None:
    rows, anchors = [], []
    for components in SWEEP:
        wells = [
            well
            for well in hold_out(samples, partial(PcaScorer, components), "first-normal").wells
            if not well.without_tip
        ]
        failed = np.array([well.failed for well in wells], dtype=bool)
        flagged = np.array([well.flagged for well in wells], dtype=bool)
        standing = np.array([well.standing for well in wells])
        rows.append([metric(failed, standing, flagged) for metric in (f1, precision, recall)])
        anchors.append(float(np.median([well.anchor for well in wells])))
    for name, values in zip(("F1", "precision", "recall"), np.array(rows).T, strict=True):
        axes.plot(SWEEP, values, "o-", ms=3, label=name)
    axes.set(xlabel="components (pca)", ylim=(0, 1.02))
    axes.legend(fontsize=7, loc="lower left")
    other = axes.twinx()
    other.semilogy(SWEEP, anchors, "s--", ms=3, c="grey")
    other.set_ylabel("median threshold (grey)")


def _complexity(
    axes: Any,
    samples: Sequence[TrajectorySample],
    make: Callable[[], Scorer],
    threshold: str,
) -> None:
    """AUROC when fitted on the normals of fewer other plates."""
    plates = list(dict.fromkeys(sample.plate for sample in samples))
    sizes = sorted({2, 4, 8, 12, len(plates) - 1} & set(range(1, len(plates))))
    means, lows, highs = [], [], []
    for size in sizes:
        values = []
        for seed in range(3):
            rng = np.random.default_rng(seed)
            wells = [
                well
                for well in hold_out(samples, partial(_fewer, make, size, rng), threshold).wells
                if not well.without_tip
            ]
            failed = np.array([well.failed for well in wells], dtype=bool)
            values.append(auroc(failed, np.array([w.standing for w in wells]), failed))
        means.append(np.mean(values))
        lows.append(np.min(values))
        highs.append(np.max(values))
    axes.fill_between(sizes, lows, highs, alpha=0.2)
    axes.plot(sizes, means, "o-", ms=3)
    axes.set(
        xlabel=f"plates to learn from ({make().name})", ylabel="AUROC, three draws", ylim=(0, 1.02)
    )


def _fewer(make: Callable[[], Scorer], plates: int, rng: np.random.Generator) -> _Fewer:
    return _Fewer(make(), plates, rng)


class _Fewer:
    """A scorer that learns from the normals of some of the plates only."""

    def __init__(self, scorer: Scorer, plates: int, rng: np.random.Generator) -> None:
        self.name = scorer.name
        self._scorer, self._plates, self._rng = scorer, plates, rng

    def fit(self, normals: Sequence[TrajectorySample]) -> None:
        names = sorted({sample.plate for sample in normals})
        chosen = set(self._rng.permutation(names)[: self._plates].tolist())
        self._scorer.fit([sample for sample in normals if sample.plate in chosen])

    def score(self, sample: TrajectorySample) -> float:
        return self._scorer.score(sample)

    def __getattr__(self, name: str) -> Any:
        # Calibration, where the scorer has one.
        return getattr(self._scorer, name)
