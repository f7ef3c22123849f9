"""The column scorer: surprise in nats, comparable between plates."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from aegis_ot.errors import ModelError
from aegis_ot.vision.models import ModelFile, load_model, save_model
from aegis_ot.vision.scorers.column import ColumnScorer
from aegis_ot.vision.scorers.surprise import NO_TIP
from aegis_ot.vision.types import TrajectorySample
from aegis_ot.vocabulary import KeyframeKind

from ..column.drawn import ALARM, FULL, WATER, normals, trajectory


@pytest.fixture(scope="module")
def known() -> list[TrajectorySample]:
    return normals()


@pytest.fixture
def scorer(known: list[TrajectorySample]) -> ColumnScorer:
    scorer = ColumnScorer()
    scorer.fit(known)
    scorer.calibrate([trajectory("first", "new", seed=90)])
    return scorer


def failures() -> dict[str, TrajectorySample]:
    return {
        "a quarter left": trajectory("quarter", left=0.8, seed=91),
        "nothing dispensed": trajectory("all", left=FULL, seed=92),
        "a bubble": trajectory("bubble", gap=(0.66, 0.69), seed=93),
        "too much drawn": trajectory("more", full=FULL - 0.07, seed=94),
        "nothing drawn": trajectory("none", full=1.0, seed=95),
    }


@pytest.mark.parametrize("what", sorted(failures()))
def test_failures_surprise_and_normals_do_not(scorer: ColumnScorer, what: str) -> None:
    normal = max(scorer.score(trajectory(f"n{i}", "new", seed=100 + i)) for i in range(3))
    assert normal < ALARM
    assert scorer.score(failures()[what]) > max(ALARM, normal + 2)


def test_the_report_names_the_sign(scorer: ColumnScorer) -> None:
    surprises = scorer.report(failures()["a quarter left"]).surprises
    assert max(surprises, key=lambda sign: surprises[sign]) == "retained"


def test_no_tip_scores_highest(scorer: ColumnScorer) -> None:
    assert scorer.score(trajectory("gone", tips=False)) == NO_TIP


def test_a_volume_of_its_own_per_well_is_no_surprise(scorer: ColumnScorer) -> None:
    model = scorer.models["p1000"]
    sample = trajectory("small", "new", full=0.66, seed=96)
    assert scorer.score(sample) > 3
    from aegis_ot.vision.tips import tip_for

    tip = tip_for("p1000")
    volume = tip.volume_of((1 - 0.66) * tip.length_mm / model.height_scale)
    due = {kind: volume if value else 0.0 for kind, value in sample.expected_ul.items()}
    assert scorer.score(replace(sample, volume_ul=volume, expected_ul=due)) < 3


def test_another_reagent_needs_no_new_fit(known: list[TrajectorySample]) -> None:
    scorer = ColumnScorer()
    scorer.fit(known)
    scorer.calibrate([trajectory("first", "wet", dye=WATER, seed=97)])
    normal = scorer.score(trajectory("n", "wet", dye=WATER, seed=98))
    kept = scorer.score(trajectory("k", "wet", left=0.75, dye=WATER, seed=99))
    assert kept > normal + 2


def test_calibration_can_be_undone(scorer: ColumnScorer) -> None:
    sample = failures()["a quarter left"]
    scorer.calibrate([])
    before = scorer.score(sample)
    scorer.calibrate([trajectory("first", "new", seed=90)])
    scorer.calibrate([])
    assert scorer.score(sample) == before


def test_an_overexposed_frame_is_left_out(scorer: ColumnScorer) -> None:
    sample = trajectory("n", "new", seed=120)
    frames = dict(sample.frames)
    frames[KeyframeKind.DISPENSE] = frames[KeyframeKind.DISPENSE] * 0 + 255
    assert scorer.score(replace(sample, frames=frames)) < ALARM


def test_nothing_to_learn_from_is_an_error() -> None:
    with pytest.raises(ValueError, match="no normal"):
        ColumnScorer().fit([])


def test_a_saved_scorer_scores_the_same(known: list[TrajectorySample], tmp_path: Path) -> None:
    scorer = ColumnScorer()
    scorer.fit(known)
    arrays, settings = scorer.to_arrays()
    save_model(tmp_path / "column.npz", "column", arrays, settings, {})
    again = ColumnScorer.from_model(load_model(tmp_path / "column.npz", "column"))
    for sample in failures().values():
        assert again.score(sample) == pytest.approx(scorer.score(sample), rel=1e-9)


def test_a_garbled_model_is_refused() -> None:
    with pytest.raises(ModelError, match="fit it anew"):
        ColumnScorer.from_model(ModelFile("column", {}, {"signs": [], "pipettes": ["p1000"]}))
