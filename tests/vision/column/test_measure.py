"""One frame: where the column ends, what breaks it, how sure that is."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from aegis_ot.vision.column import DyeColour, Reference, expected_top, look_at_tip, read_column
from aegis_ot.vision.column.measure import ColumnEnd
from aegis_ot.vision.tips import tip_for

from .drawn import FULL, RED, WATER, detection, draw_tip

TIP = tip_for("p1000")


def read(image: Any, expected_ul: float = 0.0, reference: Reference | None = None) -> ColumnEnd:
    profile = look_at_tip(image, detection(), TIP).profile
    return read_column(profile, TIP, expected_ul, reference or Reference())


@pytest.mark.parametrize("top", [0.35, 0.53, 0.7, 0.85])
def test_the_meniscus_is_found_to_two_pixels(top: float) -> None:
    found = read(draw_tip(top=top))
    assert found.presence > 8
    assert abs(found.top - top) * 185 < 2.0


def test_sub_pixel_moves_of_the_meniscus_are_seen() -> None:
    tops = np.linspace(0.55, 0.56, 5)  # 1.85 px in all
    found = [read(draw_tip(top=top, seed=i)).top for i, top in enumerate(tops)]
    assert np.corrcoef(tops, found)[0, 1] > 0.8


def test_an_empty_tip_shows_no_column() -> None:
    dye = DyeColour(0.1, 0.0, 0.005)
    found = read(draw_tip(top=1.0), reference=Reference(dye=dye))
    assert found.presence < 2


def test_more_liquid_reads_as_a_longer_column() -> None:
    tops = [read(draw_tip(top=top)).top for top in (0.8, 0.6, 0.45)]
    assert tops == sorted(tops, reverse=True)


def test_the_height_scale_turns_lengths_into_the_right_volume() -> None:
    scale = (1 - FULL) * TIP.length_mm / TIP.height_of(250.0)
    reference = Reference(height_scale=scale, height_sd=0.03)
    assert expected_top(TIP, 250.0, reference) == pytest.approx(FULL)
    found = read(draw_tip(top=FULL), expected_ul=250.0, reference=reference)
    assert TIP.volume_of((1 - found.top) * TIP.length_mm / scale) == pytest.approx(250.0, abs=15)


def test_water_is_seen_by_its_meniscus_alone() -> None:
    found = read(draw_tip(top=0.6, dye=WATER), reference=Reference(dye=DyeColour(0, 0, 0.01)))
    assert found.presence > 3
    assert abs(found.top - 0.6) < 0.02


@pytest.mark.parametrize("dye", [RED, WATER])
def test_a_break_stands_out(dye: tuple[float, float, float]) -> None:
    whole = read(draw_tip(top=0.5, dye=dye), expected_ul=250.0)
    broken = read(draw_tip(top=0.5, dye=dye, gap=(0.66, 0.70)), expected_ul=250.0)
    assert whole.gap is not None
    assert broken.gap is not None
    assert broken.gap > 3 * whole.gap


def test_exposure_does_not_move_the_reading() -> None:
    dim = read(draw_tip(top=0.6, light=0.8))
    bright = read(draw_tip(top=0.6, light=1.2))
    assert abs(dim.top - bright.top) < 0.01


def test_a_tip_before_a_white_panel_is_not_washed_out() -> None:
    """What is beside a tip may be saturated: its column shows all the same."""
    frame = draw_tip(top=FULL)
    panel = np.where((np.abs(frame.astype(int) - 55) < 12).all(axis=2)[..., None], 255, frame)
    assert not look_at_tip(panel.astype(np.uint8), detection(), TIP).washed_out


def test_an_overexposed_tip_is_washed_out() -> None:
    assert look_at_tip(draw_tip(top=FULL, light=5.0), detection(), TIP).washed_out
