from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.vision.rows.both_ends import find_in_wells, find_row
from aegis_ot.vision.rows.fit import Row, fitted, upright
from aegis_ot.vision.rows.hiding import HIDDEN, covered
from aegis_ot.vision.rows.places import RowPlaces
from aegis_ot.vision.tips import TIPS
from aegis_ot.vision.types import End, Ends

LENGTH = 260.0
TIP = TIPS["ot2_300"]


def true_ends(number: float, angle: float, x: float = 300.0) -> np.ndarray:
    """Collar and orifice of a tip, px, by a camera 600 mm away; 0: the far, left one."""
    across, depth = 9 * number * np.cos(angle), 9 * number * np.sin(angle)
    scale = LENGTH / TIP.length_mm * 600 / (600 - depth)
    collar_x, top = x + across * scale, 190.0 + 0.05 * depth
    return np.array([collar_x, top, collar_x + 2.0, top + TIP.length_mm * scale])


def ends_of(
    numbers: list[int], degrees: float, noise: float = 1.0, x: float = 300.0, stray: bool = True
) -> Ends:
    rng = np.random.default_rng(3)
    seen = [true_ends(n, np.radians(degrees), x) + rng.normal(0, noise, 4) for n in numbers]
    collars = [End(float(s[0]), float(s[1]), 0.7) for s in seen]
    orifices = [End(float(s[2]), float(s[3]), 0.5) for s in seen]
    if stray:  # labware, a meniscus, a shaft's end
        collars += [End(350.0, 330.0, 0.4), End(640.0, 420.0, 0.3), End(330.0, 60.0, 0.2)]
        orifices += [End(500.0, 330.0, 0.4), End(320.0, 560.0, 0.3)]
    return Ends(tuple(collars), tuple(orifices))


@pytest.mark.parametrize("degrees", [0, 15, 30, 45])
def test_eight_tips_are_found_among_other_things(degrees: float) -> None:
    row = find_row(ends_of(list(range(8)), degrees), LENGTH, TIP.length_mm, 8)
    assert row is not None
    assert sorted(row.heats) == list(range(8))
    for number in range(8):
        assert np.abs(row.ends(number) - true_ends(number, np.radians(degrees))).max() < 4


def test_the_nearer_end_is_told_by_the_taper() -> None:
    row = find_row(ends_of(list(range(8)), 35), LENGTH, TIP.length_mm, 8)
    assert row is not None
    assert 7 * row.taper < -0.03


def test_a_missing_tip_leaves_a_hole() -> None:
    row = find_row(ends_of([0, 1, 2, 4, 5, 6, 7], 20), LENGTH, TIP.length_mm, 8)
    assert row is not None
    assert sorted(row.heats) == [0, 1, 2, 4, 5, 6, 7]
    assert row.span == 8


@pytest.mark.parametrize("size", [1.0, 0.5, 0.25])
@pytest.mark.parametrize("degrees", [15, 30])
def test_the_taper_does_not_depend_on_the_picture_s_size(degrees: float, size: float) -> None:
    seen = size * np.array([true_ends(n, np.radians(degrees)) for n in range(8)])
    row = fitted(np.column_stack([seen, np.full(8, 0.5)]), {n: n for n in range(8)})
    first, last = (float(np.hypot(*(seen[n, 2:] - seen[n, :2]))) for n in (0, 7))
    assert row.length(7) / row.length(0) == pytest.approx(last / first, abs=0.005)
    assert 7 * row.taper == pytest.approx(first / last - 1, rel=0.1)


@pytest.mark.parametrize("roll", [-0.03, 0.0, 0.03])
def test_collars_half_a_step_aside_are_put_above_their_orifices(roll: float) -> None:
    seen = np.array([true_ends(n, 0.0) - [0, 0, 2, 0] for n in range(8)])
    seen[:, [1, 3]] += roll * (seen[:, [0, 2]] - seen[0, 0])  # of the row, px down per px right
    row = fitted(np.column_stack([seen, np.full(8, 0.5)]), {n: n for n in range(8)})
    assert upright(row) is None
    step = row.ends(1)[2] - row.ends(0)[2]
    hung = upright(row.moved((step / 2, 0.0, 0.0, 0.0)))
    assert hung is not None
    assert abs(hung.lean[0]) < 0.04
    assert hung.ends(3)[2:] == pytest.approx(row.ends(3)[2:])


@pytest.mark.parametrize(("heat", "seen"), [(0.3, True), (0.1, False)])
def test_of_two_lower_ends_the_upper_one_is_seen(heat: float, seen: bool) -> None:
    ends = ends_of(list(range(8)), 0, noise=0.0, stray=False)
    higher = tuple(End(one.x, one.y - 40.0, heat) for one in ends.orifices)
    row = find_row(Ends(ends.collars, ends.orifices + higher), LENGTH, TIP.length_mm, 8)
    assert row is not None
    lower = true_ends(4, 0.0)[3]
    assert row.ends(4)[3] == pytest.approx(lower - 40.0 if seen else lower, abs=1)


def test_one_tip_is_no_row() -> None:
    assert find_row(ends_of([0], 0, stray=False), LENGTH, TIP.length_mm, 8) is None
    assert find_row(Ends(), LENGTH, TIP.length_mm, 8) is None


def test_in_wells_the_collars_are_enough() -> None:
    known = find_row(ends_of(list(range(8)), 30), LENGTH, TIP.length_mm, 8)
    assert known is not None
    seen = ends_of(list(range(8)), 30, x=340.0)
    row = find_in_wells(Ends(seen.collars, ()), known, TIP.length_mm)
    assert row is not None
    for number in range(8):
        wanted = true_ends(number, np.radians(30), 340.0)
        assert np.abs(row.best(number) - wanted).max() < 6


def test_in_wells_all_collars_are_wanted() -> None:
    known = find_row(ends_of(list(range(8)), 30), LENGTH, TIP.length_mm, 8)
    assert known is not None
    seen = ends_of(list(range(6)), 30)
    assert find_in_wells(Ends(seen.collars, ()), known, TIP.length_mm) is None


def row_at(degrees: float) -> Row:
    row = find_row(ends_of(list(range(8)), degrees, 0.0), LENGTH, TIP.length_mm, 8)
    assert row is not None
    return row


def test_tips_hide_each_other_the_more_the_steeper_the_view() -> None:
    assert max(covered(row_at(0), TIP, range(8)).values()) == 0
    steep = covered(row_at(78), TIP, range(8))
    assert steep[7] == 0  # the nearest one
    assert min(steep[number] for number in range(7)) > HIDDEN


def moved(row: Row, x: float) -> Row:
    shift = np.array([x, 0.0, x, 0.0])
    return Row(row.start + shift, row.step, row.taper, row.heats, {})


def part(row: Row, first: int, last: int) -> Row:
    """What is found of a row whose tips ``first`` to ``last`` are there, numbered anew."""
    heats = {n - first: h for n, h in row.heats.items() if first <= n <= last}
    return Row(row.ends(first), row.step, row.taper, heats, {})


def test_a_tip_missing_at_an_end_is_told_from_where_the_row_should_be() -> None:
    places, row = RowPlaces(), row_at(0)
    places.note((100.0, 70.0, 60.0), row)
    places.note((109.0, 70.0, 60.0), moved(row, 10.0))
    there = (127.0, 70.0, 60.0)
    assert places.offset(there, part(moved(row, 30.0), 1, 7), 8) == 1
    assert places.offset(there, part(moved(row, 30.0), 0, 6), 8) == 0


def test_where_nothing_predicts_the_row_it_is_not_guessed() -> None:
    places, row = RowPlaces(), row_at(0)
    places.note((100.0, 70.0, 60.0), row)
    assert places.offset((109.0, 70.0, 60.0), part(row, 1, 7), 8) is None
    assert places.offset(None, part(row, 1, 7), 8) is None
    assert places.offset((100.0, 70.0, 60.0), part(row, 1, 7), 8) == 1
