"""Readings with the tip's end a pixel apart, and their mean."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.vision.crops import remember
from aegis_ot.vision.models import ModelFile
from aegis_ot.vision.scorers.aims import AIMS, aimed
from aegis_ot.vision.scorers.ensemble import EnsembleScorer
from aegis_ot.vision.scorers.looks import looks

from ..column.drawn import normals, trajectory


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
    assert np.abs(moved.cone - seen.cone).mean() < 12  # grey levels: the same picture, a pixel off


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
    remember(kept, "looks", lambda _: looks(sample))
    assert looks(aimed(kept, 1.0)) == looks(sample)


def test_a_run_that_is_looked_back_at_is_read_once(monkeypatch: pytest.MonkeyPatch) -> None:
    scorer = EnsembleScorer()
    scorer.fit(normals())
    first = trajectory("first", "new", seed=90)
    gone = replace(first, frames={})
    remember(gone, "looks", lambda _: looks(first))
    scorer.calibrate([gone])
    asked: list[float] = []
    monkeypatch.setattr(
        "aegis_ot.vision.scorers.ensemble.aimed", lambda s, px: asked.append(px) or s
    )
    assert scorer.score(trajectory("n", "new", seed=91)) >= 0.0
    assert asked == []


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
        alone._beside = {}
        single.append(alone.report(aimed(failed, px)).score)
    assert len({round(score, 6) for score in single}) == len(AIMS)
    assert scorer.score(failed) == pytest.approx(np.mean(single), rel=1e-4)
    assert scorer.score_of_seen(failed) == scorer.score(failed)


def _model_of(scorer: EnsembleScorer) -> ModelFile:
    arrays, settings = scorer.to_arrays()
    return ModelFile("ensemble", arrays, settings)
