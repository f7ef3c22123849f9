"""Column and patches as one p-value."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from aegis_ot.errors import ModelError
from aegis_ot.vision.models import ModelFile, load_model, save_model
from aegis_ot.vision.scorers.aims import AIMS
from aegis_ot.vision.scorers.ensemble import EnsembleScorer
from aegis_ot.vision.scorers.surprise import MOST, NO_TIP, Tail, fit_tail

from ..column.drawn import normals, trajectory


@pytest.fixture(scope="module")
def scorer() -> EnsembleScorer:
    scorer = EnsembleScorer()
    scorer.fit(normals())
    scorer.calibrate([trajectory("first", "new", seed=90)])
    return scorer


def test_the_score_is_a_p_value(scorer: EnsembleScorer) -> None:
    normal, failed = trajectory("n", "new", seed=91), trajectory("f", "new", left=0.7, seed=92)
    assert scorer.p_value(normal) > 0.05 > 0.001 > scorer.p_value(failed)
    assert scorer.score(failed) == pytest.approx(-np.log(scorer.p_value(failed)))


def test_scores_of_different_evidence_do_not_tie(scorer: EnsembleScorer) -> None:
    tops = (0.9, 0.85, 0.8, 0.7)
    scores = [scorer.score(trajectory(str(t), "new", left=t, seed=93)) for t in tops]
    assert len(set(scores)) == len(scores)
    assert min(scores) > 3


def test_one_bad_normal_in_the_fit_does_not_blind_it() -> None:
    scorer = EnsembleScorer()
    scorer.fit([*normals(), trajectory("bad", "plate0", left=0.6, seed=94)])
    scorer.calibrate([trajectory("first", "new", seed=90)])
    assert scorer.score(trajectory("f", "new", left=0.7, seed=92)) > 3


def test_the_signs_are_of_the_readings_that_the_score_is_of(scorer: EnsembleScorer) -> None:
    failed = trajectory("f", "new", left=0.85, seed=93)
    readings = [scorer.read(failed, px) for px in AIMS]
    signs = scorer.signs(failed)
    patches = signs.pop("patches")
    assert patches == pytest.approx(np.mean([one.patches for one in readings]))
    for sign, nats in signs.items():
        told = [one.column.surprises.get(sign, 0.0) for one in readings]
        assert nats == pytest.approx(np.mean(told))
    totals = [one.total for one in readings]
    assert sum(signs.values()) + 0.5 * patches == pytest.approx(np.mean(totals))
    assert max(totals) - min(totals) > 0.05, "else one reading would do"


def test_no_tip(scorer: EnsembleScorer) -> None:
    assert scorer.score(trajectory("gone", tips=False)) == NO_TIP


def test_a_saved_scorer_scores_the_same(scorer: EnsembleScorer, tmp_path: Path) -> None:
    arrays, settings = scorer.to_arrays()
    save_model(tmp_path / "ensemble.npz", "ensemble", arrays, settings, {})
    again = EnsembleScorer.from_model(load_model(tmp_path / "ensemble.npz", "ensemble"))
    again.calibrate([trajectory("first", "new", seed=90)])
    sample = trajectory("f", "new", left=0.8, seed=95)
    assert again.score(sample) == pytest.approx(scorer.score(sample), rel=1e-5)


def test_a_garbled_model_is_refused() -> None:
    with pytest.raises(ModelError, match="fit it anew"):
        EnsembleScorer.from_model(ModelFile("ensemble", {}, {"pipettes": []}))


def test_surprise_rises_along_the_tail_and_is_bounded() -> None:
    tail = Tail(2.0, 0.5)
    assert tail.surprise(1.0) == 0
    assert tail.surprise(3.0) == 2
    assert tail.surprise(1e9) == MOST
    assert tail.surprise(None) == tail.surprise(float("nan")) == 0


def test_a_few_agreeing_normals_do_not_make_a_needle_of_a_tail() -> None:
    prior = Tail(2.0, 1.0)
    assert fit_tail([1.0] * 5, prior).scale >= 0.5
    assert fit_tail([], prior) == prior
    assert fit_tail([0.0] * 20 + [100.0], prior).scale <= 1.5
