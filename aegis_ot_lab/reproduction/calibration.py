"""The band of a run: how many exchangeable normal wells leave it (paper, Cascade)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from aegis_ot.vision.calibration import PRESETS, CalibrationSettings, RunCalibration

from ..evaluation.layer2.figures import COLOURS, Canvas
from .context import Context
from .experiment import Experiment, ExperimentOutcome, ExperimentPicture, table

Draw = Callable[[np.random.Generator, int], NDArray[np.float64]]

SHAPES: dict[str, Draw] = {
    "normal": lambda rng, count: rng.normal(10.0, 1.0, count),
    "lognormal": lambda rng, count: rng.lognormal(0.0, 0.4, count),
    "gamma": lambda rng, count: rng.gamma(3.0, 1.0, count),
}
"""Scores of normal wells; only the shape matters, for the band is set on the same scores."""

MULTIPLIERS = (0.7, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0)
RUNS, LATER = 2000, 20


def run(context: Context) -> ExperimentOutcome:
    """Simulate scores; no frames are in this."""
    shares = {
        name: [
            routed(replace(PRESETS["paper"], multiplier=m), draw, context.options.seed)
            for m in MULTIPLIERS
        ]
        for name, draw in SHAPES.items()
    }
    ours = {name: routed(PRESETS["default"], draw, context.options.seed)
            for name, draw in SHAPES.items()}  # fmt: skip
    rows: list[tuple[object, ...]] = [
        (f"median ± {m:g}·MAD", *(f"{shares[name][i]:.1%}" for name in SHAPES))
        for i, m in enumerate(MULTIPLIERS)
    ]
    rows.append(("the package's preset", *(f"{ours[name]:.1%}" for name in SHAPES)))
    canvas = Canvas(context.pictures("calibration"), "simulated scores, six calibration wells")
    canvas.draw("band", lambda axes: _band(axes, shares))
    paper = PRESETS["paper"]
    return ExperimentOutcome(
        data=("simulated: scores of exchangeable normal wells, no frames",),
        answers={
            "calibration": (
                f"preset paper: {paper.wells} wells, median ± {paper.multiplier:g}·MAD, floor "
                f"{paper.score_floor:g}: sends {_span(s[0] for s in shares.values())} of normal "
                f"wells to the gate; the package's preset: {_span(ours.values())}",
            )
        },
        tables=(
            table(
                "Normal wells outside the band, by the shape of their scores",
                ("band", *SHAPES),
                rows,
            ),
        ),
        pictures=(
            ExperimentPicture(
                context.picture(canvas.paths[0]), "Normal wells sent to the gate, by width"
            ),
        ),
        notes=(
            "The paper's 15.7 % of wells routed corresponds to a multiplier of 3.5 to 4, not to "
            "0.7, if normal wells are exchangeable.",
        ),
        figures={"multipliers": list(MULTIPLIERS), "routed": shares, "default": ours},
    )


def routed(settings: CalibrationSettings, draw: Draw, seed: int) -> float:
    """Share of later normal wells outside a band that was set on the first ones."""
    rng = np.random.default_rng((seed, 31))
    outside = []
    for _ in range(RUNS):
        calibration = RunCalibration(settings)
        for score in draw(rng, settings.wells):
            calibration.add(float(score))
        outside += [not calibration.standing(float(s)).inside for s in draw(rng, LATER)]
    return float(np.mean(outside))


def _span(values: Any) -> str:
    ordered = sorted(values)
    return f"{ordered[0]:.0%} to {ordered[-1]:.0%}"


def _band(axes: Any, shares: dict[str, list[float]]) -> None:
    for colour, (name, values) in zip(COLOURS, shares.items(), strict=False):
        axes.plot(MULTIPLIERS, values, "o-", ms=3, color=colour, label=name)
    axes.axhline(0.157, ls=":", c="#8a94a0")
    axes.text(0.8, 0.165, "the paper's 15.7 %", fontsize=8, color="#8a94a0")
    axes.set(xlabel="multiplier of the MAD", ylabel="normal wells sent to the gate", ylim=(0, 0.85))
    axes.legend()


EXPERIMENT = Experiment(
    "calibration", "Calibration band", "Methods, Cascade", ("calibration",), (), run
)
