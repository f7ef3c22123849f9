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
from aegis_ot.vision.column.measure import shape_of, shapes_of
from aegis_ot.vision.column.strip import TipShape
from aegis_ot.vision.tips import TIPS
from aegis_ot.vision.types import Image, TipDetection
from aegis_ot.vocabulary import KeyframeKind


@pytest.mark.parametrize("name", ["flex_50", "flex_200", "flex_1000", "ot2_20", "ot2_300"])
def test_a_tip_is_laid_straight_where_it_hangs(name: str) -> None:
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


@pytest.mark.parametrize(
    ("radii", "kind"), [("straight", 0), ("narrow below", 1)], ids=["straight", "narrow below"]
)
def test_of_the_outlines_that_a_small_tip_may_have_the_one_that_fits_is_taken(
    radii: str, kind: int
) -> None:
    shape = shapes_of(TIPS["ot2_20"])[kind]
    found = look_at_tip(tip_in_front_of_grey(shape), TALL, TIPS["ot2_20"])
    assert found.shape == shape, radii
    assert np.abs(np.subtract(found.orifice, TALL.orifice)[0]) < 1.0
    assert np.abs(np.subtract(found.collar, TALL.collar)[0]) < 1.0


TALL = TipDetection(240.0, 100.0, 30.0, 200.0, 0.9, (254.0, 300.0), (254.0, 100.0))


def tip_in_front_of_grey(shape: TipShape) -> Image:
    """A bright tip of an outline, 200 px long, before a darker wall."""
    image = np.full((420, 500, 3), 90, np.uint8)
    u = (np.arange(200, dtype=np.float32) + 0.5) / 200
    for row, radius in enumerate(shape.radius(u) * 200):
        image[100 + row, round(254 - radius) : round(254 + radius)] = 170
    image[70:100, 240:268] = 200  # the nozzle
    return image
