"""One frame: where the column ends, what breaks it, how sure that is."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.vision.column import Dye, Reference, expected_top, measure_column
from aegis_ot.vision.tips import tip_for

from .drawn import FULL, RED, WATER, detection, draw_tip


@pytest.mark.parametrize("top", [0.35, 0.53, 0.7, 0.85])
def test_the_meniscus_is_found_to_two_pixels(top: float) -> None:
    found = measure_column(draw_tip(top=top), detection(), "p1000")
    assert found.presence > 8
    assert abs(found.top - top) * 185 < 2.0
    x, y = found.point(found.top)
    assert abs(y - (40 + top * 185)) < 3
    assert 150 < x < 176


def test_sub_pixel_moves_of_the_meniscus_are_seen() -> None:
    tops = np.linspace(0.55, 0.56, 5)  # 1.85 px in all
    found = [
        measure_column(draw_tip(top=top, seed=i), detection(), "p1000").top
        for i, top in enumerate(tops)
    ]
    assert np.corrcoef(tops, found)[0, 1] > 0.8


def test_an_empty_tip_shows_no_column() -> None:
    dye = Dye(0.1, 0.0, 0.005)
    found = measure_column(draw_tip(top=1.0), detection(), "p1000", reference=Reference(dye=dye))
    assert found.presence < 2


def test_more_liquid_reads_as_more_volume_and_uncertainty_is_stated() -> None:
    read = [measure_column(draw_tip(top=top), detection(), "p1000") for top in (0.8, 0.6, 0.45)]
    volumes = [found.volume_ul for found in read]
    assert volumes == sorted(volumes)
    assert all(0 < found.volume_sd_ul < found.volume_ul for found in read)
    assert all(found.length_sd_mm < 3 for found in read)


def test_the_height_scale_turns_lengths_into_the_right_volume() -> None:
    tip = tip_for("p1000")
    scale = (1 - FULL) * tip.length_mm / tip.height_of(250.0)
    reference = Reference(height_scale=scale, height_sd=0.03)
    assert expected_top(tip, 250.0, reference) == pytest.approx(FULL)
    found = measure_column(
        draw_tip(top=FULL), detection(), "p1000", expected_ul=250.0, reference=reference
    )
    assert abs(found.volume_ul - 250.0) < 3 * found.volume_sd_ul


def test_water_is_seen_by_its_meniscus_alone() -> None:
    found = measure_column(
        draw_tip(top=0.6, dye=WATER), detection(), "p1000", reference=Reference(dye=Dye(0, 0, 0.01))
    )
    assert found.presence > 3
    assert abs(found.top - 0.6) < 0.02


@pytest.mark.parametrize("dye", [RED, WATER])
def test_a_break_is_found_where_it_is(dye: tuple[float, float, float]) -> None:
    whole = measure_column(draw_tip(top=0.5, dye=dye), detection(), "p1000", expected_ul=250.0)
    broken = measure_column(
        draw_tip(top=0.5, dye=dye, gap=(0.66, 0.70)), detection(), "p1000", expected_ul=250.0
    )
    assert whole.gap is not None
    assert broken.gap is not None
    assert broken.gap.strength > 3 * whole.gap.strength
    assert 0.63 < (broken.gap.top + broken.gap.bottom) / 2 < 0.73


def test_exposure_does_not_move_the_reading() -> None:
    dim = measure_column(draw_tip(top=0.6, light=0.8), detection(), "p1000")
    bright = measure_column(draw_tip(top=0.6, light=1.2), detection(), "p1000")
    assert abs(dim.top - bright.top) < 0.01
    assert dim.dye.red == pytest.approx(bright.dye.red, abs=0.02)
