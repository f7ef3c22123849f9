"""Column heights of a run against the tip's geometry."""

from __future__ import annotations

import pytest

from aegis_ot.vision.tip_scale import TipScale
from aegis_ot.vision.tips import tip_for

TIP = tip_for("p1000")


def test_a_run_that_shows_higher_columns_is_read_so() -> None:
    scale = TipScale()
    unknown = scale.place(TIP, 300.0)
    for volume in (100.0, 200.0, 300.0, 400.0):
        top = 1.0 - 1.1 * float(TIP.height_of(volume)) / TIP.length_mm
        scale.note(TIP, top, volume)
    assert scale.known
    assert 1.0 - scale.place(TIP, 300.0) == pytest.approx(1.1 * (1.0 - unknown))
    assert scale.volume(TIP, scale.place(TIP, 250.0)) == pytest.approx(250.0)


def test_a_volume_is_more_uncertain_before_the_run_has_shown_its_heights() -> None:
    scale = TipScale()
    top = scale.place(TIP, 300.0)
    before = scale.sigma_ul(TIP, top, 300.0)
    for volume in (100.0, 200.0, 300.0):
        scale.note(TIP, scale.place(TIP, volume), volume)
    assert scale.sigma_ul(TIP, top, 300.0) < before / 2
    assert scale.margin(top) < TipScale().margin(top)


def test_nothing_drawn_ends_at_the_orifice() -> None:
    assert TipScale().place(TIP, 0.0) == 1.0
