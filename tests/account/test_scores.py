"""Signs and limits, as the evidence of verdicts tells them."""

from __future__ import annotations

from typing import Any

from aegis_ot.account.scores import limits_in, signs_in
from aegis_ot.vocabulary import KeyframeKind


def judged(band: list[float | None] | None, liquid: str = "red", **more: Any) -> dict[str, Any]:
    return {"band": band, "calibration": {"stream": ["left p300", 300.0, liquid]}} | more


def test_the_strongest_sign_stands_first_with_its_words_and_frames() -> None:
    told = signs_in({"signs": {"overfull": 0.2, "retained": 9.0, "new_sign": 1.0}})
    assert [(sign.name, nats) for sign, nats in told] == [
        ("retained", 9.0), ("new_sign", 1.0), ("overfull", 0.2),
    ]  # fmt: skip
    assert told[0][0].words == "a column that is left after the dispense"
    assert told[0][0].frames == (KeyframeKind.DISPENSE, KeyframeKind.POST_DISPENSE)
    assert told[1][0].words == "new sign", "an evidence of another version"


def test_a_well_met_the_band_of_the_wells_before_it_in_its_liquid() -> None:
    run = [
        judged(None),
        judged([None, 3.8]),
        judged([None, 4.0], "water"),
        # It passed at a gate, and its own high score has widened the band.
        judged([None, 15.5]),
        {},
        judged([None, 15.5]),
    ]
    assert limits_in(run) == [None, None, None, 3.8, None, 15.5]


def test_of_a_row_the_gravest_tips_own_band_is_told() -> None:
    assert limits_in([judged([None, 3.0], lanes={}), judged([None, 5.0], lanes={})]) == [3.0, 5.0]
