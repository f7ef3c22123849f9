"""What a recorded run says of its plate's wells."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from aegis_ot.audit.plate_record import recorded_plate
from aegis_ot.errors import ConfigurationError
from aegis_ot.sidecar.overview import run_overview
from aegis_ot.sidecar.store import Store


def ref(labware: str, name: str, label: str, slot: str = "") -> dict[str, str]:
    return {"labware": labware, "name": name, "label": label, "slot": slot}


def moved(source: Any, target: Any, ul: float = 50.0, **more: Any) -> dict[str, Any]:
    """One delivery as the overview tells it."""
    frame = {"kind": "post_dispense", "sources": [source], "destinations": [target],
             "commanded_ul": ul, "reagent": "dye", "recovers": None}  # fmt: skip
    verdict = {"outcome": more.pop("outcome", "pass"), "route": "silent_pass"}
    return {"trajectory": 0, "keyframes": [frame], "abandoned": None, "decisions": [],
            "verdict": verdict, "recovered": False} | more  # fmt: skip


TUBE = ref("t", "A1", "tubes", "1")


def plate(well: str, slot: str = "3", key: str = "p", label: str = "96 Well Plate") -> Any:
    return ref(key, well, label, slot)


def test_each_well_got_what_was_delivered_and_unclear_questions_are_asked(passed: Path) -> None:
    told = run_overview(Store(passed), "run-1")["trajectories"]
    found = recorded_plate(told, "", 96)
    assert set(found.wells) == {f"{row}1" for row in "ABCDEFGH"}
    gained = {tuple(one.gained.items()) for one in found.wells.values()}
    assert gained == {(("red dye from A1 of dye", 150.0),)}
    for slot, wells, said in (
        ("5", 96, "none of them is '5'"),
        ("", None, "--plate-wells"),
        ("", 95, "has 95 wells"),
        ("", 6, "does not have"),
    ):
        with pytest.raises(ConfigurationError, match=said):
            recorded_plate(told, slot, wells)
    with pytest.raises(ConfigurationError, match="delivered to no plate"):
        recorded_plate([], "", 96)


def test_a_plate_is_known_by_any_slot_it_stood_in_by_its_label_or_its_key() -> None:
    told = [
        moved(TUBE, plate("A1")),
        moved(TUBE, plate("B1", "")),
        moved(TUBE, plate("A1", "5", "q", "Second 96 Well Plate")),
        moved(TUBE, ref("r", "A1", "Rack of 24 tubes", "7")),
    ]
    with pytest.raises(ConfigurationError, match="which one is it"):
        recorded_plate(told, "", None)
    for asked in ("3", "off deck", "96 well plate", "p"):
        assert set(recorded_plate(told, asked, None).wells) == {"A1", "B1"}
    # A rack is no plate: one alone beside it needs no slot.
    assert set(recorded_plate([told[0], told[3]], "", None).wells) == {"A1"}


def test_what_was_drawn_mixed_given_up_or_failed_is_told_apart() -> None:
    told = [
        moved(TUBE, plate("A1"), 100),
        moved(plate("A1"), plate("A2"), 40),
        moved(plate("H1"), plate("H2")),
        moved(TUBE, plate("B1"), abandoned="The run ended."),
        moved(TUBE, plate("C1"), outcome="fail"),
        moved(TUBE, plate("C2"), outcome="fail", recovered=True),
    ]
    wells = recorded_plate(told, "", None).wells
    dye = "dye from A1 of tubes"
    assert (wells["A1"].gained[dye], wells["A2"].gained[dye]) == (60, 40)
    assert {well for well, one in wells.items() if one.unknown} == {"H1", "B1"}
    assert {well for well, one in wells.items() if one.failed} == {"C1"}
