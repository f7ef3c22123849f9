"""What the frames of a trajectory say of each other's tip."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.vision.consistency import (
    TipConsistency,
    confirms,
    guesses_in,
    second_look,
)
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
        consistency.note({K.TRANSIT: tip(), K.POST_DISPENSE: tip()})
    return consistency


def test_a_run_learns_from_frames_that_agree_alone(known: TipConsistency) -> None:
    unlike = TipConsistency()
    for _ in range(4):
        unlike.note({K.TRANSIT: tip(), K.POST_DISPENSE: tip(length=120.0)})
        unlike.note({K.TRANSIT: tip(), K.POST_DISPENSE: None})
    # It knows no tip yet: that the camera shows none proves nothing.
    assert not unlike.clearly_absent([None])
    assert known.clearly_absent([None])
    assert not known.clearly_absent([tip()])


def test_a_faint_tip_is_believed_beside_a_clear_one_alike():
    faint = replace(tip(302.0, 158.0), confidence=0.24)
    assert confirms(faint, tip(), 0.2)
    assert not confirms(replace(faint, confidence=0.18), tip(), 0.2)
    assert not confirms(replace(tip(collar=-40.0), confidence=0.24), tip(), 0.2)
    assert not confirms(replace(tip(length=120.0), confidence=0.24), tip(), 0.2)
    assert not confirms(None, tip(), 0.2)


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
    faint = replace(tip(), confidence=0.35)
    assert second_look(lambda _: faint, {transit: None, after: None}) == {}
    assert second_look(lambda _: faint, {transit: tip(), after: None}) == {after: faint}


def test_a_frame_is_looked_at_once_and_one_that_is_missing_not_at_all() -> None:
    class Guessing:
        looked = 0

        def detect(self, image: np.ndarray) -> TipDetection | None:
            return None

        def best_guess(self, image: np.ndarray) -> TipDetection | None:
            self.looked += 1
            return tip()

    detector = Guessing()
    guess = guesses_in(detector, {K.TRANSIT: np.zeros((540, 960, 3), np.uint8)})
    assert guess is not None
    assert guess(K.TRANSIT) == guess(K.TRANSIT) == tip()
    assert guess(K.POST_DISPENSE) is None
    assert detector.looked == 1
