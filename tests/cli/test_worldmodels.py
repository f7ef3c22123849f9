"""What ``aegis-ot fit`` and ``aegis-ot world-model`` say of a model."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from aegis_ot.vision.models import SHIPPED, load_model, save_model
from aegis_ot.worldmodel.reach import Smallest

from .commands import Command

SEEN = Smallest("p20", "red", 10.0, 2.0, {"0.2": 1.0, "1": 1.0}, 4, 2.4, 3.5, 1, 8)


@pytest.fixture
def told(aegis: Command) -> Any:
    """What is said of a model with these figures."""

    def tell(*seen: Smallest) -> str:
        made = load_model(SHIPPED)
        data = {
            "recordings": [{"name": "a", "normals": 30}],
            "smallest": [one.to_json() for one in seen],
        }
        save_model(Path("own.model"), made.kind, made.arrays, made.settings, data)
        shown = aegis("world-model", "own.model")
        assert shown.code == 0
        return shown.out

    return tell


def test_few_planted_wells_are_counted_and_many_are_a_rate(told: Any) -> None:
    few = told(SEEN)
    assert "2.0 µL left in the tip are caught, 4 of 4 planted wells (95 %: 51 to 100 %)" in few
    assert "9 times in 10" not in few
    many = told(replace(SEEN, wells=12, caught={"0.2": 0.917}))
    assert "caught, 9 times in 10: 11 of 12 planted wells (95 %: 65 to 99 %)" in many


def test_false_alarms_are_said_as_they_were_counted(told: Any) -> None:
    assert "1 of 8 normal wells flagged, which would be 12 on a plate of 96" in told(SEEN)
    assert "0 of 8 normal wells flagged. The" in told(replace(SEEN, flagged=0))
    assert "no normal well was left" in told(replace(SEEN, flagged=0, sound=0))


def test_how_near_the_camera_has_to_come_is_said_whatever_was_caught(told: Any) -> None:
    assert "for half of that, about 3.5 px/mm" in told(replace(SEEN, flagged=0))
    blind = replace(SEEN, smallest_ul=None, px_per_mm_for_half=None, caught={"1": 0.25})
    said = told(blind)
    assert "not even the whole volume" in said
    assert "1 of 4 planted wells" in said
    assert "come closer, to 4.8 px/mm, or dye the liquid" in said


def test_what_is_told_is_not_called_unknown_too(told: Any) -> None:
    assert "not known" in told()
    assert "not known" not in told(replace(SEEN, flagged=0))


LIMIT = {
    "tip": "p20", "liquid": "dye", "failures": 22, "normals": 18, "caught_before": 5, "caught": 18,
    "flagged_before": 0, "flagged": 0, "used": True,
}  # fmt: skip


def test_limits_of_ones_own_are_told_with_what_so_few_wells_prove(aegis: Command) -> None:
    made = load_model(SHIPPED)
    data = {"limits": [LIMIT, LIMIT | {"liquid": "water", "used": False}]}
    save_model(Path("own.model"), made.kind, made.arrays, made.settings, data)
    said = aegis("world-model", "own.model").out
    assert "p20, dye: limits of your own catch 18 of 22 planted failures (5 without them)" in said
    assert "at most 19 in 100 normal wells" in said
    assert "p20, water: limits of your own would catch no more failures than chance" in said


def test_one_wish_at_a_time(aegis: Command, tmp_path: Path) -> None:
    both = ("--false-stops-per-plate", "1", "--smallest-leftover", "20")
    shown = aegis("fit", str(tmp_path), "-o", "x.model", *both)
    assert shown.code == 2
    assert "Choose one" in shown.err
