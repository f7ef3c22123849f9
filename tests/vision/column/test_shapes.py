"""Outlines of tips: each kind is laid straight by its own."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.simulation import SessionParameters
from aegis_ot.simulation.dyes import DYES
from aegis_ot.simulation.exposure import decode
from aegis_ot.simulation.render import render_jpeg
from aegis_ot.simulation.scene import TipContent, place_tip
from aegis_ot.vision.column import look_at_tip
from aegis_ot.vision.column.measure import shape_of
from aegis_ot.vision.tips import TIPS
from aegis_ot.vision.types import TipDetection
from aegis_ot.vocabulary import KeyframeKind


@pytest.mark.parametrize("name", ["flex_50", "flex_200", "flex_1000"])
def test_a_flex_tip_is_laid_straight_where_it_hangs(name: str) -> None:
    tip, session = TIPS[name], SessionParameters.webcam(4)
    content = TipContent(liquid_ul=0.5 * tip.nominal_ul)
    state = place_tip(session, KeyframeKind.TRANSIT, tip, (content,), DYES["red"])
    jpeg, truth = render_jpeg(state, session, np.random.default_rng(2))
    true = truth.tip
    length = true.orifice[1] - true.collar[1]
    # As a detection is off: both ends a few pixels down.
    off = TipDetection(
        *true.box, 0.9,
        (true.orifice[0] + 2, true.orifice[1]),
        (true.collar[0] + 2, true.collar[1] + 0.03 * length),
    )  # fmt: skip
    look = look_at_tip(decode(jpeg), off, tip)
    assert abs(look.collar[1] - true.collar[1]) < 0.01 * length
    assert abs(look.orifice[1] - true.orifice[1]) < 0.015 * length


@pytest.mark.parametrize("name", ["flex_20", "flex_50", "flex_200", "flex_1000"])
def test_an_outline_bends_where_the_tip_does(name: str) -> None:
    tip, u = TIPS[name], np.linspace(0.02, 0.98, 30)
    outer = tip.outer_radius((1 - u) * tip.length_mm) / tip.length_mm
    assert np.abs(shape_of(tip).radius(u.astype(np.float32)) - outer).max() < 0.003
