"""How hard simulated frames are for raw-pixel PCA, the paper's scorer.

On real frames PCA saw a retained column only because it changes many pixels: the more the
surer; hardly on the p20, not with water, and no bubbles. A simulation on which it does better
would be too easy. One session, the webcam preset; separation is the chance that a failure
scores above a normal well that the model has not seen.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from aegis_ot.simulation import SessionParameters
from aegis_ot.vision.crops import trajectory_vector
from aegis_ot.vision.scorers.pca import PcaScorer
from aegis_ot_lab.drawing.dataset import PlannedWell, SimulatedPlate, render_trajectory

# A frame far overexposed says nothing here, and with few wells it would decide.
WEBCAM = replace(SessionParameters.webcam(), overexposed_chance=0.0)


class Bench:
    """PCA fitted on one session's normal wells."""

    def __init__(self, pipette: str, reagent: str, volume: float) -> None:
        self._what = (pipette, reagent, volume)
        self._rng = np.random.default_rng(12)
        self.scorer = PcaScorer()
        self.scorer.fit_vectors(np.stack([self._vector("") for _ in range(24)]))
        self._normals = [self.scorer.score_vector(self._vector("")) for _ in range(8)]

    def _vector(self, failure: str) -> NDArray[np.float32]:
        pipette, reagent, volume = self._what
        name = f"{'ABCDEFGH'[self._rng.integers(8)]}1"
        sample, *_ = render_trajectory(
            name,
            name,
            PlannedWell(0, reagent, failure),
            SimulatedPlate("plate00", WEBCAM, pipette, volume),
            self._rng,
        )
        return trajectory_vector(sample)

    def separation(self, failure: str, wells: int = 7) -> float:
        scores = [self.scorer.score_vector(self._vector(failure)) for _ in range(wells)]
        return float(np.mean([a > b for a in scores for b in self._normals]))


@pytest.fixture(scope="module")
def dyed() -> Bench:
    return Bench("p1000", "red", 300.0)


@pytest.fixture(scope="module")
def whole_column(dyed: Bench) -> float:
    """Separation of a whole red column left in a p1000 tip: the easiest failure."""
    return dyed.separation("no_dispense")


def test_a_whole_column_is_seen(whole_column: float) -> None:
    assert whole_column > 0.78


def test_recall_falls_with_the_retained_volume(dyed: Bench, whole_column: float) -> None:
    a_quarter = dyed.separation("partial_75")
    assert a_quarter < whole_column - 0.1


def test_bubbles_are_not_seen(dyed: Bench, whole_column: float) -> None:
    assert dyed.separation("air_bubble") < 0.65 < whole_column


@pytest.mark.parametrize(
    ("pipette", "reagent", "volume"), [("p1000", "water", 300.0), ("p20", "red", 15.0)]
)
def test_water_and_the_p20_are_harder(
    pipette: str, reagent: str, volume: float, whole_column: float
) -> None:
    assert Bench(pipette, reagent, volume).separation("no_dispense") < whole_column - 0.1
