"""The ablation figure: F1 of each configuration, with its bootstrap interval (paper, Layer 1)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from .metrics import BootstrapInterval
from .result import Layer1Result

ORDER = ("rules-only", "llm-only", "trace-blind", "hybrid")
"""Groups of bars, from left to right."""


def draw_ablation(results: Sequence[Layer1Result], folder: Path) -> list[Path]:
    """Draw F1 by configuration and model, once for each way of labelling, as PNG files.

    Args:
        results: Of one benchmark, one per configuration and model.
        folder: Where to write.

    Returns:
        The files.

    Raises:
        OSError: One cannot be written.
    """
    return [
        _draw(results, labels, folder / f"ablation_{labels}.png")
        for labels in ("adjusted", "strict")
    ]


def _draw(results: Sequence[Layer1Result], labels: str, path: Path) -> Path:
    # The object interface of matplotlib: no window system, no state shared between threads.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 3.8), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    groups = [name for name in ORDER if any(r.judge == name for r in results)]
    models = list(dict.fromkeys(_model(result) for result in results))
    for place, group in enumerate(groups):
        members = [result for result in results if result.judge == group]
        width = 0.8 / len(members)
        for number, result in enumerate(members):
            where = place + (number - (len(members) - 1) / 2) * width
            _bar(axes, where, width, getattr(result, labels).f1, models.index(_model(result)))
    handles = [axes.bar(0, 0, color=_colour(n), label=model) for n, model in enumerate(models)]
    figure.legend(handles=handles, fontsize=7, loc="outside lower center", ncols=3)
    axes.set_xticks(range(len(groups)), groups)
    axes.set(ylabel=f"F1, {labels} labels", ylim=(0, 1.08), xlim=(-0.6, len(groups) - 0.4))
    count = len(results[0].rows)
    axes.set_title(
        f"{results[0].benchmark}, {count} protocols; bars: 95 % bootstrap intervals", fontsize=9
    )
    figure.savefig(path, dpi=150)
    return path


def _bar(axes: Any, where: float, width: float, f1: BootstrapInterval, colour: int) -> None:
    if f1.value is None:
        axes.text(where, 0.02, "not defined", rotation=90, ha="center", va="bottom", fontsize=7)
        return
    axes.bar(where, f1.value, 0.9 * width, color=_colour(colour))
    if f1.low is not None and f1.high is not None:
        # The interval of a resampling need not hold the value itself.
        reach = [[max(f1.value - f1.low, 0)], [max(f1.high - f1.value, 0)]]
        axes.errorbar(where, f1.value, yerr=reach, fmt="none", ecolor="black", capsize=3, lw=1)
    # Beside the error bar, which may reach down to it.
    left = where - 0.42 * width
    axes.text(left, 0.02, f"{f1.value:.3f}", ha="left", va="bottom", fontsize=7, color="white")


def _model(result: Layer1Result) -> str:
    if result.bill is None:
        return "no model"
    return ", ".join(result.bill.models) or result.model


def _colour(number: int) -> str:
    return f"C{number % 10}"
