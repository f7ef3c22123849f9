"""Two frames at one place: what stands behind the tip cancels, and what left it is told."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.vision.column import (
    Deliveries,
    TipLook,
    Wetness,
    at_one_place,
    held_still,
    look_at_tip,
    shift_between,
)
from aegis_ot.vision.column.strip import SHAPES
from aegis_ot.vision.scorers.looks import look_again
from aegis_ot.vision.tips import tip_for
from aegis_ot.vision.types import Image
from aegis_ot.vocabulary import KeyframeKind

from .drawn import FULL, detection, draw_tip

TIP = tip_for("p1000")
HALF = 0.75


def before_an_edge(image: Image, row: int) -> Image:
    """The same picture before a table's edge, which shows beside the tip and through it."""
    lit = image.astype(np.float64)
    lit[row:] += 45.0
    return np.clip(lit, 0, 255).astype(np.uint8)


def pair(seed: int, left: float = 1.0, edge: int = 190) -> tuple[TipLook, TipLook]:
    frames = (draw_tip(top=top, seed=2 * seed + i) for i, top in enumerate((FULL, left)))
    before, after = (look_at_tip(before_an_edge(frame, edge), detection(), TIP) for frame in frames)
    return before, after


@pytest.fixture(scope="module")
def deliveries() -> Deliveries:
    known = Deliveries()
    for seed in range(3):
        before, after = pair(seed, edge=(180, 190, 200)[seed])
        known.learn_pair(before.profile, after.profile, FULL, 0.06)
    return known


def read(deliveries: Deliveries, left: float) -> Wetness:
    before, after = pair(9, left, edge=205)
    wet = deliveries.read_pair(before.profile, after.profile, FULL + 0.06)
    assert wet is not None
    return wet


def test_an_edge_behind_an_emptied_tip_is_no_liquid(deliveries) -> None:
    wet = read(deliveries, left=1.0)
    assert wet.strongest(0.2, 0.08) == 0.0
    assert wet.column(0.3, 0.95) > 0.93


def test_half_a_column_ends_where_it_stays(deliveries) -> None:
    wet = read(deliveries, left=HALF)
    assert wet.strongest(0.2, 0.08) > 5.0
    assert wet.column(0.3, 0.95) == pytest.approx(HALF, abs=0.03)


def test_a_tip_that_does_not_change_kept_all(deliveries) -> None:
    wet = read(deliveries, left=FULL)
    assert wet.strongest(0.2, 0.08) > 8.0
    assert wet.mean(FULL + 0.08, 0.95)[0] == pytest.approx(1.0, abs=0.1)


def test_wells_in_which_nothing_shows_teach_nothing() -> None:
    """Their noise is no liquid, and a tip that does not show it has kept none."""
    known = Deliveries()
    for seed in range(4):
        before, after = pair(seed, left=FULL)
        known.learn_pair(before.profile, after.profile, FULL, 0.06)
        before, after = pair(seed + 10, left=FULL)
        assert known.read_pair(before.profile, after.profile, FULL) is None


def test_a_tip_that_was_raised_stands_elsewhere() -> None:
    axis = ((100.0, 50.0), (102.0, 250.0))
    assert at_one_place(axis, ((101.0, 52.0), (103.0, 253.0)))
    assert not at_one_place(axis, ((100.0, 40.0), (102.0, 240.0)))


def test_where_the_robot_held_it_still_its_own_word_counts() -> None:
    axis = ((100.0, 50.0), (102.0, 250.0))
    badly_found = ((100.0, 50.0), (102.0, 230.0))
    assert at_one_place(axis, badly_found, held=True)
    assert not at_one_place(axis, axis, held=False)
    assert not at_one_place(axis, ((140.0, 50.0), (142.0, 250.0)), held=True), "a replayed frame"


def test_the_robot_says_whether_it_held_still() -> None:
    before, after = KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE
    assert held_still({before: (1.0, 2.0, 3.0), after: (1.0, 2.0, 3.1)}) is True
    assert held_still({before: (1.0, 2.0, 3.0), after: (1.0, 2.0, 9.0)}) is False
    assert held_still({before: (1.0, 2.0, 3.0)}) is None


COLLAR, ORIFICE = np.array((160.0, 40.0)), np.array((166.0, 225.0))


@pytest.mark.parametrize("moved", [(0.0, 0.0), (1.0, -1.0), (-2.0, 1.0)])
def test_a_tip_that_comes_back_is_laid_upon_itself(moved: tuple[float, float]) -> None:
    full = draw_tip(top=FULL, seed=1)
    again = draw_tip(collar=tuple(COLLAR + moved), orifice=tuple(ORIFICE + moved), seed=2)
    shift = shift_between(full, again, COLLAR, ORIFICE, SHAPES["p1000"])
    assert shift == pytest.approx(moved, abs=0.1)


def test_frames_of_two_things_are_not_laid_upon_each_other() -> None:
    bare = np.random.default_rng(0).normal(90, 20, (260, 320, 3)).clip(0, 255).astype(np.uint8)
    assert shift_between(draw_tip(), bare, COLLAR, ORIFICE, SHAPES["p1000"]) is None


def test_an_emptied_tip_is_laid_by_the_axis_of_the_filled_one() -> None:
    """Whatever its own frame would make of it: here its end was found a tenth too high."""
    before, after = KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE
    frames = {before: draw_tip(top=FULL, seed=1), after: draw_tip(top=HALF, seed=2)}
    full = look_at_tip(frames[before], detection(), TIP)
    high = detection()
    high = replace(high, orifice=(high.orifice[0], high.orifice[1] - 18.0))
    seen = look_again(frames, high, TIP, full)
    assert seen.orifice == pytest.approx(full.orifice, abs=0.15)
    assert seen.collar == pytest.approx(full.collar, abs=0.15)
