"""The patches scorer: what no model of a column expects."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from aegis_ot.errors import ModelError
from aegis_ot.vision.models import ModelFile, load_model, save_model
from aegis_ot.vision.scorers.patches import PatchesScorer, describe
from aegis_ot.vision.scorers.surprise import NO_TIP
from aegis_ot.vision.types import TrajectorySample
from aegis_ot.vocabulary import KeyframeKind

from ..column.drawn import ALARM, normals, trajectory


@pytest.fixture(scope="module")
def scorer() -> PatchesScorer:
    scorer = PatchesScorer()
    scorer.fit(normals())
    return scorer


def with_drop(seed: int) -> TrajectorySample:
    """A clean delivery, but a drop of debris stuck to the tip's side."""
    sample = trajectory("drop", seed=seed)
    frames = dict(sample.frames)
    image = frames[KeyframeKind.POST_DISPENSE].copy()
    cv2.circle(image, (164, 165), 4, (30, 120, 160), -1)
    frames[KeyframeKind.POST_DISPENSE] = image
    return replace(sample, frames=frames)


def test_debris_is_seen_though_no_column_is_wrong(scorer: PatchesScorer) -> None:
    normal = max(scorer.score(trajectory(f"n{i}", seed=60 + i)) for i in range(3))
    assert scorer.score(with_drop(70)) > max(ALARM, normal + 1)


def test_a_run_of_its_own_look_is_learned_by_calibration(scorer: PatchesScorer) -> None:
    odd = with_drop(71)
    before = scorer.score(odd)
    scorer.calibrate([with_drop(72 + i) for i in range(4)])
    after = scorer.score(odd)
    scorer.calibrate([])
    assert after < before
    assert scorer.score(odd) == before


def test_descriptors_are_contrasts_and_ignore_exposure() -> None:
    first, second = describe(trajectory("a", seed=1)), describe(trajectory("b", seed=2))
    assert np.nanmedian(np.abs(first[..., 0] - second[..., 0])) < 0.02


def test_a_missing_tip_scores_highest_and_leaves_gaps(scorer: PatchesScorer) -> None:
    sample = trajectory("gone", tips=False)
    assert np.isnan(describe(sample)).all()
    assert scorer.score(sample) == NO_TIP


def test_one_missing_frame_is_no_alarm(scorer: PatchesScorer) -> None:
    sample = trajectory("n", seed=80)
    found = {**sample.detections, KeyframeKind.DISPENSE: None}
    assert scorer.score(replace(sample, detections=found)) < ALARM


def test_unfitted_or_fitted_on_nothing_is_an_error() -> None:
    with pytest.raises(ValueError, match="not fitted"):
        PatchesScorer().score(trajectory("n"))
    with pytest.raises(ValueError, match="no normal"):
        PatchesScorer().fit([])


def test_a_saved_scorer_scores_the_same(scorer: PatchesScorer, tmp_path: Path) -> None:
    arrays, settings = scorer.to_arrays()
    save_model(tmp_path / "patches.npz", "patches", arrays, settings, {})
    again = PatchesScorer.from_model(load_model(tmp_path / "patches.npz", "patches"))
    sample = with_drop(70)
    assert again.score(sample) == pytest.approx(scorer.score(sample), rel=1e-5)


def test_a_garbled_model_is_refused() -> None:
    with pytest.raises(ModelError, match="fit it anew"):
        PatchesScorer.from_model(ModelFile("patches", {}, {"pipettes": ["p1000"]}))
