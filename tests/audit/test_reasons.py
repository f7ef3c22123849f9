"""What is said of failures near by, and of a group."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from aegis_ot.audit.patterns import Drift
from aegis_ot.audit.reasons import drift_words, neighbour_words, no_liquid_words


def well(number: int, outcome: str = "pass", tip: str = "", source: str = "A1") -> Any:
    keyframe = SimpleNamespace(
        tip=tip or f"1:{number}", sources=(source,), reagent="", mount="left",
        pipette="p300_single_gen2",
    )  # fmt: skip
    sample = SimpleNamespace(well=f"A{number}", volume_ul=50.0 * number)
    return SimpleNamespace(trajectory=number, outcome=outcome, keyframe=keyframe, sample=sample)


def test_a_failure_of_the_same_tip_counts_once_however_often_it_failed() -> None:
    wells = [well(n, "fail" if n != 3 else "pass", tip="1:A1") for n in range(1, 6)]
    assert list(neighbour_words(wells[2], wells)) == [
        ("The same tip failed at A1 and 3 more.", 1.0)
    ]


def test_a_failure_next_to_it_counts_if_it_drew_from_the_same_source() -> None:
    wells = [well(1, "fail"), well(2), well(3, "fail", source="B1"), well(4, "undecided"), well(5)]
    ((said, counts),) = neighbour_words(wells[1], wells)
    assert "A1, served just before it from the same source, failed." in said
    assert 0 < counts < 1
    assert list(neighbour_words(wells[4], wells)) == []


def test_groups_are_told_with_their_wells_and_volumes() -> None:
    wells = [well(n) for n in range(1, 10)]
    first, *more = drift_words(Drift("after", 9.0, (4, 5, 8), {"left_40": 0.312}), wells)
    assert "more and more stays in the tip, from A5 to A9" in first
    assert "31 percentage points fuller" in more[0]
    loaded = drift_words(Drift("loaded", 9.0, (4, 8), {"short": 0.2}), wells)
    assert "20 percentage points emptier" in loaded[1]
    assert "50 to 450 µL should stand in the tip" in no_liquid_words(wells, None)[0]
