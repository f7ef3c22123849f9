from __future__ import annotations

import json

import pytest

from aegis_ot.sidecar.bodies import parse
from aegis_ot.sidecar.wire import WireError
from aegis_ot.vocabulary import (
    ChannelOutcome,
    ChannelVerdict,
    Keyframe,
    KeyframeKind,
    Outcome,
    Route,
    Verdict,
    WellRef,
    from_json,
    is_row,
    named_wells,
    to_json,
)

COLUMN = tuple(f"{row}1" for row in "ABCDEFGH")


def seen(nozzle: str, well: str | None, outcome: str = "pass") -> ChannelVerdict:
    ref = None if well is None else WellRef("plate", well)
    return ChannelVerdict(nozzle, ref, ChannelOutcome(outcome))


@pytest.mark.parametrize(
    ("nozzles", "row"),
    [
        (COLUMN, True),
        (COLUMN[2:], True),
        (tuple(f"A{n}" for n in range(1, 13)), True),
        (("A1", "A2", "B1", "B2"), False),
        (("A1",), False),
        (("0", "1"), False),
    ],
)
def test_a_row_of_nozzles_shares_letter_or_number(nozzles: tuple[str, ...], row: bool) -> None:
    assert is_row(nozzles) is row


def test_neighbouring_wells_are_named_as_one() -> None:
    wells = [seen(f"{row}1", f"{row}3") for row in "ABCDEGH"]
    assert named_wells(wells) == "A3 to E3, G3, H3"
    assert named_wells([seen("B1", None)]) == "nozzle B1"


def test_a_verdict_with_channels_passes_the_wire() -> None:
    channels = (seen("A1", "A3", "fail"), seen("B1", None, "unobserved"))
    verdict = Verdict("run", 3, Outcome.FAIL, Route.GREY_ZONE, channels=channels)
    assert from_json(Verdict, json.loads(json.dumps(to_json(verdict)))) == verdict


def keyframe(**more: object) -> Keyframe:
    wells = tuple(WellRef("plate", f"{row}3") for row in "ABCDEFGH")
    given: dict = {"nozzles": COLUMN, "targets": (None, *wells[1:])} | more
    return Keyframe(
        "run", 0, 0, KeyframeKind.TRANSIT, "p300_multi_gen2", "left", 8, "1:A1", (), wells[1:],
        50.0, 50.0, 300.0, **given,
    )  # fmt: skip


def test_a_keyframe_with_nozzles_over_no_well_passes_the_wire() -> None:
    sent = keyframe()
    assert parse(Keyframe, json.dumps(to_json(sent)).encode()) == sent
    assert from_json(Keyframe, json.loads(json.dumps(to_json(sent)))) == sent


def test_a_keyframe_names_every_nozzle_or_none() -> None:
    wrong = keyframe(nozzles=COLUMN[:3])
    with pytest.raises(WireError, match="one per channel"):
        parse(Keyframe, json.dumps(to_json(wrong)).encode())
