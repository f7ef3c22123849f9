"""Figures of a Layer 2 evaluation, each labelled with where its frames come from."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from sklearn.metrics import precision_recall_curve, roc_curve

from aegis_ot.progress import Progress
from aegis_ot.vision.scorers.pca import COMPONENTS
from aegis_ot.vision.types import TrajectorySample

from ...scorers import make_scorer
from .result import Layer2Result
from .studies import SweepPoint, component_sweep, explained_variance, sample_complexity

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")
"""Told apart with any colour vision (Okabe and Ito, 2008)."""

_NORMAL, _FAILED, _GREY = "#009E73", "#D55E00", "#8a94a0"
_STYLE = {
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": _GREY,
    "axes.grid": True,
    "grid.color": "#e6eaee",
    "axes.axisbelow": True,
    "legend.frameon": False,
    "legend.fontsize": 8,
    "savefig.dpi": 160,
}

Drawing = Callable[[Any], None]


def draw_figures(
    results: Layer2Result | Sequence[Layer2Result],
    folder: str | Path,
    samples: Sequence[TrajectorySample] = (),
    progress: Progress | None = None,
) -> list[Path]:
    """Draw all figures that the material allows, as PNG files.

    Args:
        results: Evaluations of one or several scorers on one data set.
        folder: Where to write; made if need be.
        samples: The set's trajectories: with them, scree and component sweep (of the paper's
            scorer) and the sample complexity of the paper's and of the first scorer are drawn
            too (minutes for slow scorers).
        progress: Told how far it is.

    Returns:
        The files, in the order drawn.
    """
    several = [results] if isinstance(results, Layer2Result) else list(results)
    first = several[0]
    canvas = Canvas(Path(folder), f"{first.dataset} ({first.source} frames), {first.protocol}")
    canvas.draw("precision_recall", lambda axes: _precision_recall(axes, several))
    canvas.draw("roc", lambda axes: _roc(axes, several))
    canvas.draw("failure_types", lambda axes: _bars(axes, several), width=8.0)
    for result in several:
        name = "scores" if len(several) == 1 else f"scores_{result.scorer}"
        canvas.draw(name, lambda axes, shown=result: _strip(axes, shown), width=7.0)  # type: ignore[misc]
    if samples:
        explained, points = explained_variance(samples), component_sweep(samples, progress)
        draw_components(canvas, explained, points)
        canvas.draw("sample_complexity", lambda axes: _complexity(axes, samples, first, progress))
    return canvas.paths


def draw_components(
    canvas: Canvas, explained: NDArray[np.float64], points: Sequence[SweepPoint]
) -> None:
    """The paper's two figures on the number of components (SI C)."""
    canvas.draw("scree", lambda axes: _scree(axes, explained))
    canvas.draw("components", lambda axes: _sweep(axes, points))


class Canvas:
    """Draws one figure after another in one style, as PNG files.

    Args:
        folder: Where to write; made if need be.
        title: Of all figures: what they stand on.

    Attributes:
        paths: The files, in the order drawn.
    """

    def __init__(self, folder: Path, title: str) -> None:
        self._folder, self._title = folder, title
        self.paths: list[Path] = []
        folder.mkdir(parents=True, exist_ok=True)

    def draw(self, name: str, drawing: Drawing, width: float = 5.4) -> None:
        """One figure of one pair of axes."""
        # The object interface of matplotlib: no window system, no state shared between threads.
        from matplotlib import rc_context
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        path = self._folder / f"{name}.png"
        with rc_context(_STYLE):
            figure = Figure(figsize=(width, 3.9), layout="constrained")
            FigureCanvasAgg(figure)
            axes = figure.add_subplot()
            drawing(axes)
            axes.set_title(self._title)
            figure.savefig(path)
        self.paths.append(path)


def _arrays(result: Layer2Result) -> tuple[Any, Any, Any]:
    failed = np.array([well.failed for well in result.wells], dtype=bool)
    standing = np.array([well.standing for well in result.wells])
    return failed, standing, np.array(result.flagged, dtype=bool)


def _precision_recall(axes: Any, results: Sequence[Layer2Result]) -> None:
    axes.set(xlabel="recall", ylabel="precision", xlim=(0, 1.03), ylim=(0, 1.05))
    failed, _, _ = _arrays(results[0])
    if not failed.any():
        _say(axes, "no failures in this set")
        return
    axes.axhline(failed.mean(), ls=":", c=_GREY)
    axes.text(0.01, failed.mean() + 0.01, "all wells flagged", color=_GREY, fontsize=8)
    for colour, result in zip(_cycle(results), results, strict=True):
        failed, standing, _ = _arrays(result)
        up, along, _ = precision_recall_curve(failed, standing)
        label = f"{result.scorer}, AP {result.metrics['average_precision']}"
        axes.step(along, up, where="pre", color=colour, label=label)
        point = result.metrics["recall"].value, result.metrics["precision"].value
        axes.plot(*point, "o", color=colour, mec="white", clip_on=False)
    axes.legend(loc="lower left", title="points: as flagged", title_fontsize=8)


def _roc(axes: Any, results: Sequence[Layer2Result]) -> None:
    axes.set(xlabel="normal wells flagged", ylabel="recall", xlim=(-0.02, 1.02), ylim=(0, 1.05))
    axes.plot([0, 1], [0, 1], ls=":", c=_GREY)
    failed, _, _ = _arrays(results[0])
    if not failed.any() or failed.all():
        _say(axes, "not defined: one kind of well only")
        return
    for colour, result in zip(_cycle(results), results, strict=True):
        failed, standing, flagged = _arrays(result)
        along, up, _ = roc_curve(failed, standing)
        axes.plot(along, up, color=colour, label=f"{result.scorer}, {result.metrics['auroc']}")
        point = flagged[~failed].mean(), flagged[failed].mean()
        axes.plot(*point, "o", color=colour, mec="white", clip_on=False)
    axes.legend(loc="lower right", title="AUROC (points: as flagged)", title_fontsize=8)


def _bars(axes: Any, results: Sequence[Layer2Result]) -> None:
    groups = [
        {
            "normal\n(flagged)": result.flagged_normals,
            **result.per_failure_type(),
            **({"no_tip": result.no_tip} if result.no_tip.total else {}),
            **result.per_reagent(),
        }
        for result in results
    ]
    names = list(groups[0])
    positions = np.arange(len(names), dtype=float)
    # A gap between failure types and reagents: the same wells, grouped anew.
    positions[len(names) - len(results[0].per_reagent()) :] += 0.6
    positions[1:] += 0.6
    width = 0.8 / len(results)
    for i, (colour, shares) in enumerate(zip(_cycle(results), groups, strict=True)):
        heights = [share.caught / share.total if share.total else 0.0 for share in shares.values()]
        places = positions + (i - (len(results) - 1) / 2) * width
        axes.bar(places, heights, 0.92 * width, color=colour, label=results[i].scorer)
        if len(results) <= 2:
            for place, height, share in zip(places, heights, shares.values(), strict=True):
                axes.text(place, height + 0.015, str(share), ha="center", fontsize=7)
    labels = [name.replace("_", " ") for name in names]
    axes.set_xticks(positions, labels, rotation=40, ha="right")
    axes.set(ylabel="share flagged", ylim=(0, 1.1))
    axes.grid(visible=False, axis="x")
    if len(results) > 1:
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))


def _strip(axes: Any, result: Layer2Result) -> None:
    kinds = ["normal", *result.per_failure_type()]
    rng = np.random.default_rng(0)
    for position, kind in enumerate(kinds):
        values = np.array(
            [w.standing for w in result.wells if (w.sample.failure_type or "normal") == kind]
        )
        spread = rng.uniform(-0.18, 0.18, len(values))
        colour = _NORMAL if kind == "normal" else _FAILED
        axes.plot(position + spread, values, "o", ms=4, alpha=0.75, color=colour, mec="white")
    axes.axhline(0, ls="--", c=_GREY)
    axes.text(1.005, 0, "threshold", transform=axes.get_yaxis_transform(), va="center", fontsize=8)
    axes.set_xticks(
        np.arange(len(kinds)), [kind.replace("_", " ") for kind in kinds], rotation=40, ha="right"
    )
    axes.grid(visible=False, axis="x")
    axes.set(ylabel=f"{result.scorer} score above its plate's threshold")


def _scree(axes: Any, explained: NDArray[np.float64]) -> None:
    axes.plot(np.arange(1, len(explained) + 1), explained, "o-", ms=3, color=COLOURS[0])
    axes.axvline(COMPONENTS, ls=":", c=_GREY)
    if len(explained) >= COMPONENTS:
        share = explained[COMPONENTS - 1]
        axes.text(COMPONENTS + 0.3, share - 0.06, f"k = {COMPONENTS}: {share:.1%}", fontsize=8)
    axes.set(xlabel="components (pca)", ylabel="variance explained", ylim=(0, 1.03))


def _sweep(axes: Any, points: Sequence[SweepPoint]) -> None:
    along = [point.components for point in points]
    for colour, name in zip(COLOURS, ("f1", "precision", "recall"), strict=False):
        values = [getattr(point, name) for point in points]
        axes.plot(along, values, "o-", ms=3, label=name.replace("f1", "F1"), color=colour)
    axes.set(xlabel="components (pca)", ylim=(0, 1.03))
    axes.legend(loc="lower left")
    other = axes.twinx()
    if all(point.threshold > 0 for point in points):  # blank crops score nothing
        other.semilogy(along, [point.threshold for point in points], "s--", ms=3, c=_GREY)
    other.set_ylabel("median threshold (grey)")
    other.grid(visible=False)


def _complexity(
    axes: Any,
    samples: Sequence[TrajectorySample],
    result: Layer2Result,
    progress: Progress | None,
) -> None:
    # One draw of a slow scorer tells as much as a reader needs beside three of the quick one.
    curves = {"pca": ("first-normal", 3), result.scorer: (result.threshold, 3)}
    if result.scorer != "pca":
        curves[result.scorer] = (result.threshold, 1)
    for colour, (name, (threshold, draws)) in zip(COLOURS, curves.items(), strict=False):
        points = sample_complexity(
            samples, lambda name=name: make_scorer(name), threshold, draws, progress  # type: ignore[misc]
        )  # fmt: skip
        sizes = [point.plates for point in points]
        label = f"{name}, {draws} draws" if draws > 1 else f"{name}, one draw"
        middle = [float(np.mean(point.aurocs)) for point in points]
        axes.plot(sizes, middle, "o-", ms=4, color=colour, label=label)
        if draws > 1:
            low, high = zip(*((min(p.aurocs), max(p.aurocs)) for p in points), strict=True)
            axes.fill_between(sizes, low, high, alpha=0.15, color=colour, lw=0)
    axes.axhline(0.5, ls=":", c=_GREY)
    axes.set(xlabel="plates to learn from", ylabel="AUROC", ylim=(0, 1.03))
    axes.legend(loc="lower right")


def _cycle(results: Sequence[Layer2Result]) -> list[str]:
    return [COLOURS[i % len(COLOURS)] for i in range(len(results))]


def _say(axes: Any, what: str) -> None:
    axes.text(0.5, 0.5, what, ha="center", va="center", color=_GREY, transform=axes.transAxes)
