"""Detections that one run cannot have are mended or dropped."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.vision.consistency import TipConsistency, confirms, find_again, second_look
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


def test_a_meniscus_taken_for_a_collar_is_mended_by_the_usual_length(known):
    wrong = tip(307.0, collar=257.0, length=100.0)
    settled = known.settle({K.TRANSIT: tip(), K.POST_DISPENSE: wrong}, frames(shift=7))
    mended = settled[K.POST_DISPENSE]
    assert mended.length == pytest.approx(LENGTH)
    assert mended.orifice == wrong.orifice
    assert mended.collar == pytest.approx((307.0, 157.0))


def test_collars_mistaken_in_both_frames_leave_the_tip_on_the_pipette(known):
    seen = {
        K.TRANSIT: tip(collar=250.0, length=100.0),
        K.POST_DISPENSE: tip(collar=220.0, length=130.0),
    }
    settled = known.settle(seen, frames())
    assert [settled[kind].length for kind in seen] == pytest.approx([LENGTH, LENGTH])


def test_a_tip_of_another_length_that_ends_elsewhere_is_found_by_its_partner(known):
    wrong = tip(collar=250.0, length=140.0)
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


def test_a_faint_tip_is_recognised_where_this_runs_tip_hangs(known):
    faint = {150: replace(tip(), confidence=0.05)}
    seen = {K.TRANSIT: tip(), K.POST_DISPENSE: None}

    def guess(image: np.ndarray) -> TipDetection | None:
        return faint.get(150)

    assert known.recognise(guess, seen, frames()) == {K.POST_DISPENSE: faint[150]}
    faint[150] = replace(tip(x=400.0), confidence=0.05)
    assert known.recognise(guess, seen, frames()) == {}
    faint[150] = replace(tip(collar=-30.0), confidence=0.05)
    assert known.recognise(guess, seen, frames()) == {}
    assert TipConsistency().recognise(guess, seen, frames()) == {}


def test_one_frame_without_a_tip_is_excused_if_the_others_show_it_clearly(known):
    shown = {K.TRANSIT: tip(), K.DISPENSE: tip(), K.POST_DISPENSE: None}
    seen = {**frames(), K.DISPENSE: frame()}
    assert known.excuses(K.POST_DISPENSE, shown, seen)
    assert not TipConsistency().excuses(K.POST_DISPENSE, shown, seen)
    unsure = {**shown, K.DISPENSE: replace(tip(), confidence=0.3)}
    assert not known.excuses(K.POST_DISPENSE, unsure, seen)
    assert not known.excuses(K.POST_DISPENSE, {**shown, K.TRANSIT: None}, seen)


def test_a_tip_that_a_later_frame_shows_was_on_before() -> None:
    shown = {K.TRANSIT: None, K.DISPENSE: None, K.POST_DISPENSE: tip()}
    assert TipConsistency().excuses(K.TRANSIT, shown, frames())
    assert not TipConsistency().excuses(K.TRANSIT, {**shown, K.POST_DISPENSE: None}, frames())


def test_an_overexposed_frame_is_no_sign_of_a_missing_tip():
    shown = {K.TRANSIT: tip(), K.DISPENSE: tip(), K.POST_DISPENSE: None}
    white = np.full((480, 640, 3), 250, np.uint8)
    seen = {K.TRANSIT: frame(), K.DISPENSE: frame(), K.POST_DISPENSE: white}
    assert TipConsistency().excuses(K.POST_DISPENSE, shown, seen)


def test_no_tip_is_sure_only_where_tips_are_plain_to_see(known):
    bare = [replace(tip(), confidence=0.2), None]
    assert known.clearly_absent(bare)
    assert not known.clearly_absent([replace(tip(), confidence=0.5), None])


def test_two_faint_tips_confirm_nothing_but_a_sure_one_confirms_a_faint_one() -> None:
    transit, after = K.TRANSIT, K.POST_DISPENSE
    image = np.zeros((540, 960, 3), np.uint8)
    frames, faint = {transit: image, after: image}, replace(tip(), confidence=0.35)
    assert second_look(lambda _: faint, {transit: None, after: None}, frames) == {}
    assert second_look(lambda _: faint, {transit: tip(), after: None}, frames) == {after: faint}
