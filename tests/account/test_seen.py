"""What a delivery is called wherever it is shown."""

from __future__ import annotations

import pytest

from aegis_ot.account.seen import seen_well

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
