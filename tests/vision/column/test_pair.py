"""Two frames at one place: what stands behind the tip cancels, and what left it is told."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.vision.column import Deliveries, TipLook, Wetness, at_one_place, look_at_tip
from aegis_ot.vision.tips import tip_for
from aegis_ot.vision.types import Image

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
