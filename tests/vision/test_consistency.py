"""Detections that one run cannot have are mended or dropped."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.vision.consistency import TipConsistency, confirms, find_again
from aegis_ot.vision.types import TipDetection
from aegis_ot.vocabulary import KeyframeKind as K

LENGTH = 200.0


def tip(x: float = 300.0, collar: float = 150.0, length: float = LENGTH) -> TipDetection:
    bottom = collar + length
    return TipDetection(x - 10, collar, 20, length, 0.6, (x, bottom), (x, collar))


def frame(x: int = 300, collar: int = 150) -> np.ndarray:
    """A grey picture with a shaft, a darker collar and a thin tip below it."""
    image = np.full((480, 640, 3), 120, np.uint8)
    image[:collar, x - 8 : x + 8] = 60
    image[collar : collar + 20, x - 10 : x + 10] = 30
    image[collar + 20 : collar + 200, x - 4 : x + 4] = 150
    return image


def frames(shift: int = 0) -> dict[K, np.ndarray]:
    return {K.TRANSIT: frame(), K.POST_DISPENSE: frame(300 + shift, 150 + shift)}


@pytest.fixture
def known() -> TipConsistency:
    consistency = TipConsistency()
    for _ in range(4):
        consistency.settle({K.TRANSIT: tip(), K.POST_DISPENSE: tip()}, frames())
    return consistency


def test_agreeing_detections_are_left_alone(known):
    seen = {K.TRANSIT: tip(), K.POST_DISPENSE: tip(302.0, 153.0)}
    assert known.settle(seen, frames()) == seen


def test_a_meniscus_taken_for_a_collar_is_mended_by_the_partner(known):
    wrong = tip(collar=250.0, length=100.0)
    settled = known.settle({K.TRANSIT: tip(), K.POST_DISPENSE: wrong}, frames(shift=7))
    mended = settled[K.POST_DISPENSE]
    assert mended.length == pytest.approx(LENGTH)
    assert mended.collar == pytest.approx((307.0, 157.0), abs=1.0)


def test_a_shaft_taken_for_a_tip_is_dropped(known):
    shaft = tip(collar=-60.0)
    settled = known.settle({K.TRANSIT: None, K.POST_DISPENSE: shaft}, frames())
    assert settled[K.POST_DISPENSE] is None


def test_a_missing_tip_is_never_made_up(known):
    settled = known.settle({K.TRANSIT: tip(), K.POST_DISPENSE: None}, frames())
    assert settled[K.POST_DISPENSE] is None


def test_nothing_is_refused_before_the_tip_is_known():
    odd = tip(length=90.0)
    settled = TipConsistency().settle({K.TRANSIT: None, K.POST_DISPENSE: odd}, frames())
    assert settled[K.POST_DISPENSE] is odd


def test_a_tip_in_a_well_may_look_shorter(known):
    hidden = tip(length=120.0)
    assert known.settle({K.ASPIRATE: hidden}, {})[K.ASPIRATE] is hidden


def test_no_match_is_no_tip():
    blank = np.full((480, 640, 3), 90, np.uint8)
    blank[::7] = 95
    assert find_again(tip(), frame(), blank) is None


def test_a_tip_at_the_edge_of_the_frame_is_not_looked_for():
    assert find_again(replace(tip(), collar=(3.0, 2.0)), frame(), frame()) is None


def test_a_faint_tip_is_believed_beside_a_clear_one_alike():
    faint = replace(tip(302.0, 158.0), confidence=0.24)
    assert confirms(faint, tip(), 0.2)
    assert not confirms(replace(faint, confidence=0.18), tip(), 0.2)
    assert not confirms(replace(tip(collar=-40.0), confidence=0.24), tip(), 0.2)
    assert not confirms(replace(tip(length=120.0), confidence=0.24), tip(), 0.2)
    assert not confirms(None, tip(), 0.2)
