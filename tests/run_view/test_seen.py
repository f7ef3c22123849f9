"""What a delivery is called wherever it is shown."""

from __future__ import annotations

import pytest

from aegis_ot.run_view.delivery_view import seen_well
from aegis_ot.vocabulary import KeyframeKind

from .overviews import delivery


@pytest.mark.parametrize(
    ("found", "words"),
    [
        (True, "; the sensor found liquid"),
        (False, "; the sensor found no liquid"),
        (None, ""),
        ("an older sidecar's", ""),
    ],
)
def test_the_sensors_word_on_the_source_stands_with_the_delivery(found: object, words: str) -> None:
    entry = delivery(0)
    for keyframe in entry["keyframes"]:
        keyframe["liquid_found"] = found
        if isinstance(found, str):
            del keyframe["liquid_found"]
    assert seen_well("run", entry).title == f"A1 of plate (slot 4), 100 µL{words}"


def test_what_spoke_against_a_delivery_stands_with_it() -> None:
    entry = delivery(0, evidence={"signs": {"pair": 0.4, "retained": 9.0}})
    told = seen_well("run", entry).signs
    assert [(sign.name, nats) for sign, nats in told] == [("retained", 9.0), ("pair", 0.4)]


def test_the_expected_column_is_marked_where_the_run_has_it() -> None:
    boxes = {"boxes": {"transit": [40.0, 0.0, 20.0, 100.0]}}
    known = delivery(0, evidence=boxes | {"expected_top": {"transit": 0.25}})
    expected = seen_well("run", known).frames[KeyframeKind.TRANSIT].expected
    assert expected is not None
    assert expected.mark is not None
    assert expected.mark[0][1] == pytest.approx(75.0)
    guessed = seen_well("run", delivery(0, evidence=boxes)).frames[KeyframeKind.TRANSIT].expected
    assert guessed is not None
    assert guessed.mark is None
