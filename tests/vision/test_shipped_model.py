"""The world model in the wheel: small, whole, and of use from a run's first wells on."""

from __future__ import annotations

from aegis_ot.vision.models import SHIPPED, load_model
from aegis_ot.vision.scorers.ensemble import EnsembleScorer


def test_it_is_small_and_says_what_it_was_fitted_on() -> None:
    assert SHIPPED.stat().st_size <= 5_000_000
    model = load_model(SHIPPED, "ensemble")
    assert {used["source"] for used in model.data["recordings"]} == {"synthetic"}
    assert all(used["normals"] > 20 for used in model.data["recordings"])


def test_it_knows_the_pipettes_of_the_ot2() -> None:
    scorer = EnsembleScorer.from_model(load_model(SHIPPED, "ensemble"))
    assert set(scorer.sums) == {"p20", "p300", "p1000"}
