"""Signs and bands, as the evidence of verdicts tells them."""

from __future__ import annotations

import math

import pytest

from aegis_ot.run_view.scores import band_in, signs_in
from aegis_ot.vocabulary import KeyframeKind


def test_the_strongest_sign_stands_first_with_its_words_and_frames() -> None:
    told = signs_in({"signs": {"overfull": 0.2, "retained": 9.0, "new_sign": 1.0}})
    assert [(sign.name, nats) for sign, nats in told] == [
        ("retained", 9.0), ("new_sign", 1.0), ("overfull", 0.2),
    ]  # fmt: skip
    assert told[0][0].words == "a column that is left after the dispense"
    assert told[0][0].frames == (KeyframeKind.DISPENSE, KeyframeKind.POST_DISPENSE)
    assert told[1][0].words == "new sign", "an evidence of another version"


@pytest.mark.parametrize("low", [None, -math.inf, 0.0])
def test_a_band_that_is_open_below_begins_at_nought(low: float | None) -> None:
    assert band_in({"band": [low, 3.8]}) == (0.0, 3.8)


def test_a_band_with_two_ends_keeps_them_and_none_is_none() -> None:
    assert band_in({"band": [1.5, 3.8]}) == (1.5, 3.8)
    assert band_in({"band": None}) is band_in({"band": [None, None]}) is band_in({}) is None
