"""Pair and column as one p-value."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from aegis_ot.errors import ModelError
from aegis_ot.vision.models import ModelFile, load_model, save_model
from aegis_ot.vision.run_scorer import RunScorer
from aegis_ot.vision.scorers.ensemble import EnsembleScorer
from aegis_ot.vision.scorers.surprise import MOST, NO_TIP, Tail, fit_tail
from aegis_ot.vision.types import TrajectorySample
from aegis_ot.vocabulary import KeyframeKind

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
    tops = (0.88, 0.85, 0.8, 0.7)
    scores = [scorer.score(trajectory(str(t), "new", left=t, seed=93)) for t in tops]
    assert len(set(scores)) == len(scores)
    assert min(scores) > 3


def test_one_bad_normal_in_the_fit_does_not_blind_it() -> None:
    scorer = EnsembleScorer()
    scorer.fit([*normals(), trajectory("bad", "plate0", left=0.6, seed=94)])
    scorer.calibrate([trajectory("first", "new", seed=90)])
    assert scorer.score(trajectory("f", "new", left=0.7, seed=92)) > 3


def test_signs_say_what_both_saw(scorer: EnsembleScorer) -> None:
    failed = trajectory("f", "new", left=0.7, seed=93)
    report = scorer.report(failed)
    assert report.pair is not None
    assert scorer.signs(failed) == {**report.column.surprises, "pair": report.pair}


def test_without_a_pair_the_column_judges(scorer: EnsembleScorer) -> None:
    unseen = KeyframeKind.TRANSIT
    normal, failed = (
        _without(trajectory("n", "new", left=left, seed=91), unseen) for left in (1.0, 0.6)
    )
    assert scorer.report(failed).pair is None
    assert "pair" not in scorer.signs(failed)
    assert scorer.score_of_seen(failed) > 3 > scorer.score_of_seen(normal)


def _without(sample: TrajectorySample, kind: KeyframeKind) -> TrajectorySample:
    return replace(sample, detections={**sample.detections, kind: None})


def test_a_run_that_adapts_once_frames_are_gone_keeps_its_readings(
    scorer: EnsembleScorer,
) -> None:
    first, failed = trajectory("first", "new", seed=90), trajectory("f", "new", left=0.8, seed=92)
    expected = scorer.score(failed)
    run = RunScorer(scorer, 2)
    own = replace(first, frames=dict(first.frames))
    run.score(own)
    run.accept(own)
    own.frames.clear()
    run.adapt()
    assert run.score(failed) == pytest.approx(expected)


def test_a_model_of_an_earlier_version_is_refused_with_what_to_do() -> None:
    old = ModelFile("ensemble", {}, {"pipettes": [], "patches": {}}, package="0.9")
    with pytest.raises(ModelError, match=r"aegis_ot 0\.9.*fit it anew"):
        EnsembleScorer.from_model(old)


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
