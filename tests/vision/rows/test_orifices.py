"""Rows of which only the lower ends are seen."""

from __future__ import annotations

import pytest

from aegis_ot.vision.rows.orifices import find_by_orifices
from aegis_ot.vision.types import End, Ends

TIP_MM, STEP = 59.3, 40.0
LENGTH = STEP * TIP_MM / 9.0


def row_of(numbers: list[int], *more: End) -> Ends:
    return Ends(orifices=(*(End(100.0 + STEP * n, 370.0 + n % 3, 0.5) for n in numbers), *more))


@pytest.mark.parametrize("expected", [0.5, 1.0, 1.5])
def test_the_nozzles_distance_gives_the_scale(expected: float) -> None:
    row = find_by_orifices(row_of(list(range(8))), expected * LENGTH, TIP_MM, 8)
    assert row is not None
    assert sorted(row.heats) == list(range(8))
    assert row.length(3.5) == pytest.approx(LENGTH, rel=0.02)
    collar_x, collar_y, orifice_x, orifice_y = row.ends(0)
    assert (orifice_x, orifice_y) == pytest.approx((100.0, 370.0), abs=3)
    assert (collar_x, collar_y) == pytest.approx((100.0, 370.0 - LENGTH), abs=6)


def test_a_gap_stays_a_gap_and_a_stray_end_is_none() -> None:
    stray = End(100.0 + 3 * STEP, 330.0, 0.9)
    row = find_by_orifices(row_of([0, 1, 2, 4, 5, 6, 7], stray), LENGTH, TIP_MM, 8)
    assert row is not None
    assert sorted(row.heats) == [0, 1, 2, 4, 5, 6, 7]


def test_no_more_tips_than_nozzles() -> None:
    beside = End(100.0 + 8 * STEP, 370.0, 0.3)
    row = find_by_orifices(row_of(list(range(8)), beside), LENGTH, TIP_MM, 8)
    assert row is not None
    assert row.span == 8
    assert row.ends(0)[2] == pytest.approx(100.0, abs=3)


@pytest.mark.parametrize(
    ("seen", "y"), [(range(8), 370.0), (range(1, 6), 370.0), (range(3), 400.0)]
)
def test_of_two_rows_of_ends_the_upper_one_is_seen(seen: range, y: float) -> None:
    lower = [End(100.0 + STEP * n, 400.0, 0.8) for n in range(8)]
    row = find_by_orifices(row_of(list(seen), *lower), LENGTH, TIP_MM, 8)
    assert row is not None
    assert [row.ends(n)[3] for n in range(8)] == pytest.approx([y] * 8, abs=3)


def test_what_is_seen_above_brings_no_missing_tip_back() -> None:
    some = [0, 1, 2, 4, 5, 6, 7]
    lower = [End(100.0 + STEP * n, 400.0, 0.8) for n in some]
    bare = End(100.0 + 3 * STEP, 370.0, 0.12)
    row = find_by_orifices(row_of(some, bare, *lower), LENGTH, TIP_MM, 8)
    assert row is not None
    assert sorted(row.heats) == some


def test_one_end_is_no_row() -> None:
    assert find_by_orifices(row_of([2]), LENGTH, TIP_MM, 8) is None


def test_nothing_warm_is_no_row() -> None:
    assert find_by_orifices(Ends(), LENGTH, TIP_MM, 8) is None
    cold = Ends(orifices=tuple(End(100.0 + STEP * n, 370.0, 0.05) for n in range(8)))
    assert find_by_orifices(cold, LENGTH, TIP_MM, 8) is None


def test_a_row_seen_from_one_side_keeps_its_taper() -> None:
    taper = 0.01
    ends = Ends(
        orifices=tuple(
            End((100.0 + STEP * n) / (1 + taper * n), 370.0 / (1 + taper * n), 0.5)
            for n in range(8)
        )
    )
    row = find_by_orifices(ends, LENGTH, TIP_MM, 8)
    assert row is not None
    assert row.length(7) < 0.97 * row.length(0)
