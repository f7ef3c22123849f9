"""How far readings of normal tips stray."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from aegis_ot.vision.column import Wetness
from aegis_ot.vision.usual import ENOUGH, Usual, alike


def wetness(power: float = 400.0) -> Wetness:
    u = np.linspace(0.0, 1.0, 100, dtype=np.float32)
    return Wetness(u, np.zeros(100), np.ones(100), power)


def test_a_narrow_bore_is_read_less_surely() -> None:
    usual = Usual()
    wide, narrow = (usual.variance(wetness(), px, full=False) for px in (6.0, 2.0))
    assert narrow > 5 * wide


def test_a_liquid_that_hardly_shows_is_read_less_surely() -> None:
    usual = Usual()
    assert usual.variance(wetness(4.0), 6.0, full=True) > usual.variance(wetness(), 6.0, full=True)


def test_steady_normal_tips_make_readings_surer_and_straying_ones_less_sure() -> None:
    steady, straying, fresh = Usual(), Usual(), Usual()
    for _ in range(8):
        steady.note_empty([0.02] * 4)
        straying.note_empty([0.6] * 4)
    known = [u.variance(wetness(), 3.0, full=False) for u in (steady, fresh, straying)]
    assert known == sorted(known)
    assert (steady.tested(full=False), steady.tested(full=True)) == (8, 0)


def test_a_short_column_that_strays_makes_a_long_one_no_less_sure() -> None:
    usual = Usual()
    for _ in range(8):
        usual.note_empty([1.2, 0.3, 0.1, 0.05])
    short, long = (usual.variance(wetness(), 3.0, full=False, height=share) for share in (0.2, 1.0))
    assert long < 0.2 * short


def test_frames_of_another_brightness_are_not_compared() -> None:
    usual = Usual()
    assert usual.comparable(250.0)
    for _ in range(ENOUGH):
        usual.note_light(100.0)
    assert usual.comparable(120.0)
    assert not usual.comparable(250.0)
    assert not usual.anew().comparable(250.0)
    assert alike(100.0, 110.0)


def test_a_plain_liquid_is_read_in_any_light() -> None:
    usual = Usual()
    for _ in range(ENOUGH):
        usual.note_light(100.0)
    assert usual.readable(wetness(100.0), 250.0)
    assert not usual.readable(wetness(5.0), 250.0)
    assert usual.readable(wetness(5.0), 110.0)


def test_a_frame_that_looks_like_no_tip_of_this_run_is_not_read() -> None:
    usual = Usual()
    odd = Wetness(wetness().u, np.zeros(100), np.ones(100), 30.0, misfit=6.0)
    plain = Wetness(wetness().u, np.zeros(100), np.ones(100), 400.0, misfit=6.0)
    assert usual.fits(wetness())
    assert not usual.fits(odd)
    assert usual.fits(plain)
    usual.note_full(1.0, 5.0)
    assert usual.fits(odd)


def test_a_pair_that_was_laid_beside_the_tip_is_not_read() -> None:
    usual = Usual()
    pair = replace(wetness(10.0), misfit=0.85, paired=True)
    assert usual.fits(pair), "the run has not shown yet how its pairs fit"
    for _ in range(ENOUGH):
        usual.note_pair(0.25)
    assert not usual.fits(pair)
    assert usual.fits(replace(pair, misfit=0.45))
    assert usual.fits(replace(pair, paired=False)), "a frame read alone strays farther"
