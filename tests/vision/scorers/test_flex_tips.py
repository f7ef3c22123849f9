"""What is learned of Flex tips is kept apart from the OT-2's of the same size."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.simulation import SessionParameters
from aegis_ot.vision.run_scorer import RunScorer
from aegis_ot.vision.scorers.column import ColumnScorer
from aegis_ot.vision.scorers.ensemble import EnsembleScorer
from aegis_ot.vision.types import TrajectorySample
from aegis_ot_lab.drawing.dataset import PlannedWell, SimulatedPlate, render_trajectory

SESSION = replace(SessionParameters.bench(5), overexposed_chance=0.0)


def wells(pipette: str, volume: float, count: int = 3) -> list[TrajectorySample]:
    rng = np.random.default_rng(3)
    plate = SimulatedPlate("plate", SESSION, pipette, volume)
    return [
        render_trajectory(str(n), f"A{n + 1}", PlannedWell(0, "red", ""), plate, rng)[0]
        for n in range(count)
    ]


def test_each_robots_tips_have_a_model_of_their_own() -> None:
    scorer = ColumnScorer()
    scorer.fit([*wells("p1000", 300.0), *wells("flex_1channel_1000", 300.0)])
    assert set(scorer.models) == {"p1000", "flex_1000"}
    for model in scorer.models.values():
        assert model.height_scale == pytest.approx(1.0, abs=0.06)


def test_the_ensemble_keeps_them_apart_too() -> None:
    scorer = EnsembleScorer()
    scorer.fit([*wells("p1000", 300.0), *wells("flex_1channel_1000", 300.0)])
    assert set(scorer.sums) == set(scorer.pair.known) == {"p1000", "flex_1000"}
    assert set(RunScorer(scorer, 6).height_factors) == {"ot2_1000", "flex_1000"}
    assert np.isfinite(scorer.score(wells("flex_1channel_1000", 300.0, 1)[0]))


def test_a_flex_tip_that_was_not_learned_is_judged_by_the_size_of_its_pipette() -> None:
    scorer = ColumnScorer()
    scorer.fit(wells("p1000", 300.0))
    assert scorer.report(wells("flex_1channel_1000", 300.0, 1)[0]).score < 3.0
