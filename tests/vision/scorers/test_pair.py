"""The pair network on tips that are drawn from plain geometry, which it has not learned from."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from aegis_ot.errors import ModelError
from aegis_ot.vision.detection.session import open_session, read_weights
from aegis_ot.vision.models import ModelFile
from aegis_ot.vision.scorers.pair import FORMAT, Pair, PairScorer, pair_of, read_pair
from aegis_ot.vision.scorers.pair_strips import COLUMNS, ROWS, U, strip_of, wet_rows
from aegis_ot.vision.scorers.surprise import NO_TIP
from aegis_ot.vision.tips import tip_for
from aegis_ot.vision.types import FREE, TrajectorySample
from aegis_ot.vocabulary import KeyframeKind

from ..column.drawn import FULL, WATER, normals, trajectory


def _pair(sample: TrajectorySample) -> Pair:
    found = pair_of(sample)
    assert found is not None
    return found


@pytest.fixture(scope="module")
def usual() -> list[Pair]:
    return [_pair(trajectory(f"first{seed}", "new", seed=seed)) for seed in (88, 89, 90)]


def test_what_stays_in_the_tip_stands_out(usual: list[Pair]) -> None:
    fine = [read_pair(_pair(trajectory("n", "new", seed=seed)), usual) for seed in range(91, 95)]
    wrong = [read_pair(_pair(trajectory("f", left=left)), usual) for left in (0.75, 0.65, FULL)]
    assert max(one.wrong for one in fine) < 0 < min(one.wrong for one in wrong)
    assert max(one.kept for one in fine) < min(one.kept for one in wrong)


def test_a_tip_that_drew_nothing_stands_out_beside_those_that_did(usual: list[Pair]) -> None:
    assert read_pair(_pair(trajectory("f", full=1.0)), usual).wrong > 0
    assert read_pair(_pair(trajectory("f", dye=WATER)), usual).wrong > 0


def test_it_says_where_liquid_stands(usual: list[Pair]) -> None:
    wet = read_pair(_pair(trajectory("n", seed=91)), usual).wet
    assert wet.shape == (2, ROWS)
    column = (U > FULL + 0.05) & (U < 0.95)
    assert (wet[0, column] > 0).mean() > 0.8
    assert (wet[1] < 0).all()
    assert (wet[0, U < FULL - 0.05] < 0).all()


def test_without_normal_wells_it_reads_a_pair_by_itself() -> None:
    fine, wrong = (_pair(trajectory("n", left=left, seed=91)) for left in (1.0, 0.6))
    assert read_pair(fine).wrong < 0 < read_pair(wrong).wrong


def test_what_is_known_of_the_run_changes_what_it_says(usual: list[Pair]) -> None:
    water = _pair(trajectory("n", dye=WATER, seed=91))
    its_own = [_pair(trajectory("n", dye=WATER, seed=seed)) for seed in (92, 93, 94)]
    assert read_pair(water, its_own).wrong < read_pair(water, usual).wrong


def test_a_strip_is_the_same_for_a_tip_wherever_it_hangs() -> None:
    tip = tip_for("p1000")
    image = np.zeros((300, 400, 3), np.uint8)
    image[100:200, 150:160] = (10, 200, 60)
    here = strip_of(image, (155, 60), (155, 260), tip)
    there = strip_of(np.roll(image, (20, 90), (0, 1)), (245, 80), (245, 280), tip)
    assert here.shape == (ROWS, COLUMNS, 3)
    np.testing.assert_array_equal(here, there)


def test_rows_of_a_volume_reach_from_the_orifice_up() -> None:
    tip = tip_for("p1000")
    wet = wet_rows(tip, ((0.0, 250.0),))
    rows = np.flatnonzero(wet)
    assert U[rows].max() > 0.98
    assert len(rows) == rows[-1] - rows[0] + 1
    assert wet_rows(tip, ((0.0, 500.0),)).sum() > wet.sum()


@pytest.mark.parametrize("kind", FREE)
def test_a_missing_frame_makes_no_pair(kind: KeyframeKind) -> None:
    sample = trajectory("n")
    frames = {name: frame for name, frame in sample.frames.items() if name is not kind}
    assert pair_of(replace(sample, frames=frames)) is None


def test_liquid_that_is_meant_to_stay_makes_no_pair() -> None:
    sample = trajectory("n", left=0.75)
    kept = {**sample.expected_ul, KeyframeKind.POST_DISPENSE: 100.0}
    assert pair_of(replace(sample, expected_ul=kept)) is None
    assert pair_of(replace(sample, expected_ul=dict.fromkeys(KeyframeKind, 0.0))) is None


def test_a_pair_outlives_the_frames() -> None:
    sample = trajectory("n", seed=91)
    own = replace(sample, frames=dict(sample.frames))
    pair = _pair(own)
    own.frames.clear()
    assert pair_of(own) is pair


def test_neighbours_of_a_row_are_painted_over() -> None:
    sample = trajectory("n", seed=91)
    frames = {kind: frame.copy() for kind, frame in sample.frames.items()}
    for frame in frames.values():
        cv2.line(frame, (174, 40), (180, 225), (0, 0, 255), 3)  # parallel to the tip
    tip = sample.detections[FREE[0]]
    assert tip is not None
    row = dict.fromkeys(KeyframeKind, replace(tip, apart=14.0))
    alone = _pair(replace(sample, frames=frames, detections=row))
    beside = _pair(replace(sample, frames=frames))
    red = np.array((0.0, 0.0, 1.0))
    assert (np.abs(beside.frames - red).max(axis=-1) < 0.2).any()
    assert not (np.abs(alone.frames - red).max(axis=-1) < 0.2).any()


def test_the_scorer_ranks_and_is_saved() -> None:
    scorer = PairScorer()
    scorer.fit(normals())
    first = [trajectory("first", "new", seed=90)]
    scorer.calibrate(first)
    failed = trajectory("f", "new", left=0.65, seed=92)
    assert scorer.score(failed) > 2 > scorer.score(trajectory("n", "new", seed=91))
    arrays, settings = scorer.to_arrays()
    again = PairScorer.from_model(ModelFile("pair", arrays, settings))
    again.calibrate(first)
    assert again.score(failed) == pytest.approx(scorer.score(failed))
    assert scorer.score(trajectory("gone", tips=False)) == NO_TIP
    with pytest.raises(ValueError, match="no normal"):
        scorer.fit([])
    with pytest.raises(ModelError, match="fit it anew"):
        PairScorer.from_model(ModelFile("pair", {}, {"pipettes": ["p20"]}))


def test_another_tip_is_held_against_all_that_were_learned() -> None:
    scorer = PairScorer()
    scorer.known = {"p20": np.array([-3.0, -1.0]), "p300": np.array([-2.0])}
    np.testing.assert_array_equal(scorer.normals_like(trajectory("n")), [-3.0, -2.0, -1.0])


@pytest.mark.parametrize(
    ("network", "description", "said"),
    [
        (None, {"format": FORMAT, "sha256": ""}, "cannot be read"),
        (b"x", "{", "no valid|not valid"),
        (b"x", {"format": "other"}, "this version reads"),
        (b"x", {"format": FORMAT, "sha256": "00"}, "is damaged"),
    ],
)
def test_damaged_weights_are_refused(
    tmp_path: Path, network: bytes | None, description: object, said: str
) -> None:
    model, told = tmp_path / "pair.onnx", tmp_path / "pair.json"
    if network is not None:
        model.write_bytes(network)
    told.write_text(description if isinstance(description, str) else json.dumps(description))
    with pytest.raises(ModelError, match=said):
        read_weights(model, told, FORMAT)


def test_a_model_whose_network_is_gone_is_refused_when_it_is_loaded(monkeypatch) -> None:
    """And not at the first well of a run."""
    model = ModelFile("pair", {}, {"pipettes": []})
    PairScorer.from_model(model)
    monkeypatch.setattr("aegis_ot.vision.scorers.pair._network", lambda: open_session(b"", 1, "It"))
    with pytest.raises(ModelError, match="no network that onnxruntime can run"):
        PairScorer.from_model(model)
