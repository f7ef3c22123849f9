"""The refined axis: where the tip is, however badly it was detected."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.vision.column import rectify
from aegis_ot.vision.column.strip import SHAPES

from .drawn import detection, draw_tip

SHAPE = SHAPES["p1000"]
COLLAR, ORIFICE = (160.0, 40.0), (166.0, 225.0)


@pytest.mark.parametrize("off", [(0, 0, 0, 0), (3, -3, -3, 3), (-4, 4, 4, -2), (5, 2, 5, 2)])
def test_an_axis_off_by_some_pixels_is_mended(off: tuple[float, float, float, float]) -> None:
    strip = rectify(draw_tip(), detection(off=off), SHAPE)
    assert np.hypot(*np.subtract(strip.collar, COLLAR)) < 1.5
    assert np.hypot(*np.subtract(strip.orifice, ORIFICE)) < 2.0


def test_the_lower_end_of_a_sleeve_is_no_nozzle_s_end() -> None:
    """As bright as the nozzle it hides that, and ends a fifth of the tip farther down."""
    image = draw_tip()
    image[40:85, 150:172] = image[44:48, 158:162].mean(axis=(0, 1)).astype(np.uint8)
    strip = rectify(image, detection(confidence=0.3), SHAPE)
    assert abs(strip.collar[1] - COLLAR[1]) < 3.0
    assert abs(strip.orifice[1] - ORIFICE[1]) < 3.0


def test_rows_of_a_strip_run_from_collar_to_orifice() -> None:
    strip = rectify(draw_tip(top=0.6), detection(), SHAPE)
    middle = strip.pixels[:, len(strip.v) // 2]
    green = middle[:, 1]
    assert np.median(green[(strip.u > 0.65) & (strip.u < 0.9)]) < 65
    assert np.median(green[(strip.u > 0.2) & (strip.u < 0.55)]) > 75
    assert abs(strip.length - np.hypot(6, 185)) < 3


def test_a_known_length_overrules_the_detection() -> None:
    wrong = detection(off=(0, 0, -1, -40))
    strip = rectify(draw_tip(), wrong, SHAPE, length=185.1)
    assert abs(strip.orifice[1] - ORIFICE[1]) < 2.5


def test_a_tip_that_hangs_out_of_the_frame_raises_nothing() -> None:
    image = draw_tip()[:150]
    strip = rectify(np.ascontiguousarray(image), detection(), SHAPE)
    assert np.isfinite(strip.pixels).all()
