"""Readings with the tip's end a pixel apart, and their mean."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.vision.column import look_along
from aegis_ot.vision.models import ModelFile
from aegis_ot.vision.run_scorer import RunScorer
from aegis_ot.vision.scorers.aims import AIMS, aimed
from aegis_ot.vision.scorers.ensemble import EnsembleScorer
from aegis_ot.vision.scorers.looks import looks
from aegis_ot.vocabulary import KeyframeKind
from aegis_ot.worldmodel.detection_limits import with_retained
from tests.vision.column.drawn import normals, trajectory


def test_the_end_moves_along_the_tip_and_nothing_else_does() -> None:
    sample = trajectory("n", "new", seed=91)
    for px in (-1.0, 1.0):
        moved = looks(aimed(sample, px))
        assert moved.keys() == looks(sample).keys()
        for kind, seen in looks(sample).items():
            along = np.subtract(seen.orifice, seen.collar)
            expected = np.add(seen.orifice, px * along / np.hypot(*along))
            assert moved[kind].orifice == pytest.approx(expected, abs=1e-3)
            assert moved[kind].collar == seen.collar
            assert moved[kind].profile.length == pytest.approx(seen.profile.length + px, abs=1e-3)
            assert not np.array_equal(moved[kind].cone, seen.cone)


def test_of_a_row_the_neighbours_stay_painted_over() -> None:
    sample = trajectory("n", "new", seed=91)
    (kind, tip), *_ = sample.detections.items()
    assert tip is not None
    beside = replace(tip, apart=2.0 * tip.w)
    row = replace(sample, detections={**sample.detections, kind: beside})
    seen, moved = looks(row)[kind], looks(aimed(row, 1.0))[kind]
    assert np.hypot(*np.subtract(moved.orifice, seen.orifice)) == pytest.approx(1.0, abs=1e-3)
    assert moved.cone.shape == seen.cone.shape
    for each in (row, sample):
        same = look_along(
            each.frames[kind], each.detections[kind], each.tip, looks(each)[kind], 0.0
        )
        np.testing.assert_allclose(same.cone, looks(each)[kind].cone, atol=1e-3)


def test_a_reading_is_made_once_and_the_first_is_the_sample_itself() -> None:
    sample = trajectory("n", "new", seed=91)
    assert aimed(sample, 0.0) is sample
    assert aimed(sample, 1.0) is aimed(sample, 1.0)
    assert aimed(sample, 1.0) is not aimed(sample, -1.0)


def test_a_tip_that_is_not_seen_stays_unseen() -> None:
    assert not looks(aimed(trajectory("gone", tips=False), 1.0))


def test_looks_whose_frames_are_gone_are_read_as_they_are() -> None:
    sample = trajectory("n", "new", seed=91)
    kept = replace(sample, frames={})
    kept.once("looks", lambda: looks(sample))
    moved = looks(aimed(kept, 1.0))
    assert all(moved[kind] is seen for kind, seen in looks(sample).items())


def test_a_run_that_adapts_once_frames_are_gone_keeps_its_readings() -> None:
    scorer = EnsembleScorer()
    scorer.fit(normals())
    first, failed = trajectory("first", "new", seed=90), trajectory("f", "new", left=0.85, seed=92)
    scorer.calibrate([first])
    expected = scorer.score(failed)
    run = RunScorer(scorer, 2)
    own = replace(first, frames=dict(first.frames))
    run.score(own)
    run.accept(own)
    own.frames.clear()
    run.adapt()
    assert run.score(failed) == pytest.approx(expected)


def test_a_fitted_scorer_reads_as_a_saved_one_and_a_second_fit_forgets_the_first() -> None:
    scorer = EnsembleScorer()
    scorer.fit(normals())
    failed = trajectory("f", "new", left=0.85, seed=92)
    again = EnsembleScorer.from_model(_model_of(scorer))
    assert scorer.score(failed) == pytest.approx(again.score(failed), rel=1e-4)
    scorer.fit(normals())
    assert all(column.models is scorer.column.models for column, _ in scorer._by_aim.values())


def test_what_is_planted_is_planted_in_all_readings() -> None:
    sample = trajectory("n", "new", seed=91)
    failed = with_retained(sample, 0.8)
    kind = KeyframeKind.POST_DISPENSE
    for px in AIMS:
        planted, normal = looks(aimed(failed, px))[kind], looks(aimed(sample, px))[kind]
        assert np.abs(planted.cone - normal.cone).max() > 5


def test_the_score_is_the_mean_of_all_readings_each_calibrated_by_its_own() -> None:
    first = trajectory("first", "new", seed=90)
    failed = trajectory("f", "new", left=0.85, seed=92)
    scorer = EnsembleScorer()
    scorer.fit(normals())
    scorer.calibrate([first])
    single = []
    for px in AIMS:
        alone = EnsembleScorer.from_model(_model_of(scorer))
        alone.column.calibrate([aimed(first, px)])
        alone.patches.calibrate([aimed(first, px)])
        alone._by_aim = {0.0: (alone.column, alone.patches)}
        single.append(alone.report(aimed(failed, px)).score)
    assert len({round(score, 6) for score in single}) == len(AIMS)
    assert scorer.score(failed) == pytest.approx(np.mean(single), rel=1e-4)
    assert scorer.score_of_seen(failed) == scorer.score(failed)


def _model_of(scorer: EnsembleScorer) -> ModelFile:
    arrays, settings = scorer.to_arrays()
    return ModelFile("ensemble", arrays, settings)
