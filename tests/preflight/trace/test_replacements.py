"""What a pause message says to be replaced: plates, tips, or things that are none of the deck's."""

from __future__ import annotations

import time

import pytest

from aegis_ot.instrumentation import LabwareInfo
from aegis_ot.preflight import Report, Script, check_script, load_database
from aegis_ot.preflight.trace import Intervention, Replacements

PROTOCOL = """
metadata = {{"apiLevel": "2.15"}}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_20ul", 1)
    p20 = ctx.load_instrument("p20_single_gen2", "right", tip_racks=[tips])
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "Reagents")
    plate = ctx.load_labware("biorad_96_wellplate_200ul_pcr", 3, "PCR plate")
    master_mix, water, template = tubes["A1"], tubes["A2"], tubes["B1"]
    sample, ntc = plate["A1"], plate["H1"]
    p20.transfer(5, template, sample)
    p20.transfer(5, water, ntc)
    ctx.pause("{message}")
    p20.transfer(15, master_mix, [sample, ntc], new_tip="once")
"""


def _check(message: str) -> set[str]:
    report: Report = check_script(
        Script(PROTOCOL.format(message=message), "pcr.py"), load_database()
    )
    return {finding.rule for finding in report.findings}


@pytest.mark.parametrize(
    "message",
    [
        "Put on fresh gloves",
        "Change gloves, then resume",
        "Thaw a new tube of master mix and put it in A1",
        "Please check the new samples",
        "Swap the ice block",
        "Take out the primer tube",
        "Remove the lid of the reservoir",
        "Remove the foil from the plate",
        "Spin the plate, add a fresh seal",
        "Replace the plate seal and resume",
        "Switch off the UV lamp",
        "Let's change the flow rate",
        "Wechseln Sie die Handschuhe",
        "Changer de gants",
        "Remove 0.5 mL, vortex",
    ],
)
def test_other_things_are_no_new_plates(message: str) -> None:
    assert "PCR-2" in _check(message)


@pytest.mark.parametrize(
    "message",
    [
        "Replace the PCR plate",
        "Put a new 96-well plate on the cycler",
        "Plate is full, change it and resume",
        "Replace and resume",
        "Take the plate away and put on fresh gloves",
        "Swap what is in slot 3",
        "Remove the dish",
        "Neue Platte, dann weiter",
        "Replace the master mix plate",
        "Change the sheet on the deck",
        "Place the column into a new collection tube",
        "Replace tips and plate",
        "Replace the lid and the plate",
        "Exchange the source",
        "Insert a fresh 96-well block",
        "Put new PCR tubes into the block",
        "Die Platte auf Eis stellen und eine neue einsetzen",
        "Discard the plate in the bin and load a new one",
        "Neue Zielplatte einsetzen",
    ],
)
def test_another_plate_holds_nothing_of_the_first(message: str) -> None:
    assert "PCR-2" not in _check(message)


def _read(message: str) -> Intervention:
    common = load_database().common
    info = LabwareInfo("one", "opentrons_96_tiprack_20ul", "Tips", "", "1", True, False)
    return Replacements(common.pauses, common.joining).read(message, {"one": info}, {"one": "1"})


def test_a_new_tube_and_new_tips_may_be_told_together() -> None:
    said = _read("Replace the tips. Put a new tube of enzyme in the rack.")
    assert said.all_tips
    assert said.volumes_unsure
    assert not said.replaced


def test_tips_and_a_trough_may_be_told_together() -> None:
    said = _read("Refill the reservoir and replace the tips")
    assert said.all_tips
    assert said.volumes_unsure


@pytest.mark.parametrize(
    "message", ["Replace the empty tip racks", "Refill the tip boxes, empty the trash"]
)
def test_tips_and_trash_change_no_volumes(message: str) -> None:
    said = _read(message)
    assert said.all_tips
    assert not said.volumes_unsure


def test_a_long_message_is_read_in_no_time() -> None:
    begun = time.process_time()
    _read("new tube " * 20_000)
    assert time.process_time() - begun < 5
