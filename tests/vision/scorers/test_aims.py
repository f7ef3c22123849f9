"""Readings with the tip's end a pixel apart, and their mean."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.vision.models import ModelFile
from aegis_ot.vision.scorers.aims import AIMS, aimed
from aegis_ot.vision.scorers.ensemble import EnsembleScorer
from aegis_ot.vision.types import TipDetection
from aegis_ot.vocabulary import KeyframeKind

from ..column.drawn import normals, trajectory


def test_the_end_moves_along_the_tip_and_nothing_else_does() -> None:
    sample = trajectory("n", "new", seed=91)
    leaning = TipDetection(100.0, 50.0, 40.0, 80.0, 0.9, (130.0, 130.0), (70.0, 50.0))
    kind = KeyframeKind.TRANSIT
    sample = replace(sample, detections={**sample.detections, kind: leaning})
    moved = aimed(sample, 5.0).detections[kind]
    assert moved is not None
    assert moved.orifice == pytest.approx((133.0, 134.0))
    assert (moved.collar, moved.h) == (leaning.collar, pytest.approx(84.0))
    assert aimed(sample, 5.0).frames is sample.frames


def test_a_reading_is_made_once_and_the_first_is_the_sample_itself() -> None:
    sample = trajectory("n", "new", seed=91)
    assert aimed(sample, 0.0) is sample
    assert aimed(sample, 1.0) is aimed(sample, 1.0)
    assert aimed(sample, 1.0) is not aimed(sample, -1.0)


def test_a_tip_that_is_not_seen_stays_unseen_and_a_speck_stays_as_it_is() -> None:
    sample = trajectory("gone", tips=False)
    assert not any(aimed(sample, 1.0).detections.values())
    speck = TipDetection(5.0, 5.0, 1.0, 1.0, 0.9, (5.0, 6.0), (5.0, 5.0))
    sample = replace(sample, detections={KeyframeKind.TRANSIT: speck})
    assert aimed(sample, -1.0).detections[KeyframeKind.TRANSIT] == speck


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
