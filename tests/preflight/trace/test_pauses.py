"""What a pause message says to be replaced: plates, tips, or things that are none of the deck's."""

from __future__ import annotations

import time
from dataclasses import replace

import pytest

from aegis_ot.adapters.opentrons.instrumentation import LabwareInfo, WellInfo
from aegis_ot.preflight import Report, Script, check_script, load_rules
from aegis_ot.preflight.trace.pauses import Intervention, read_pause

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
    report: Report = check_script(Script(PROTOCOL.format(message=message), "pcr.py"), load_rules())
    return {finding.rule for finding in report.findings}


@pytest.mark.parametrize(
    "message",
    [
        "Put on fresh gloves",
        "Change gloves, then resume",
        "Thaw a new tube of master mix and put it in A1",
        "Please check the new samples",
        "Remove the lid of the reservoir",
        "Remove the foil from the plate",
        "Replace the plate seal and resume",
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
        "Swap what is in slots 2 and 3",
        "Remove the dish",
        "Neue Platte, dann weiter",
        "Replace the master mix plate",
        "Replace tips and plate",
        "Replace the lid and the plate",
        "Exchange the source",
        "Put new PCR tubes into the block",
        "Die Platte auf Eis stellen und eine neue einsetzen",
        "Discard the plate in the bin and load a new one",
    ],
)
def test_another_plate_holds_nothing_of_the_first(message: str) -> None:
    assert "PCR-2" not in _check(message)


def _read(message: str) -> Intervention:
    tips = LabwareInfo("tips", "opentrons_96_tiprack_20ul", "Tips", "", "1", True, False)
    wells = dict.fromkeys("ABCDEF", WellInfo(100, 10))
    plate = LabwareInfo("plate", "plate", "Plate", "", "2", False, False, wells=wells)
    trough = replace(plate, key="trough", slot="3", centers_channels=True)
    labware = {info.key: info for info in (tips, plate, trough)}
    slots = {key: info.slot for key, info in labware.items()}
    return read_pause(message, load_rules().common.pauses, labware, slots)


def test_a_plate_and_tips_may_be_told_together() -> None:
    said = _read("Replace the tips. Put a new plate in.")
    assert said.tips
    assert said.volumes_unsure
    assert said.replaced == {"plate"}


def test_a_refilled_trough_is_no_plate() -> None:
    said = _read("Refill the reservoir with fresh buffer and replace the tips")
    assert said.tips
    assert said.volumes_unsure
    assert said.replaced == {"trough"}


@pytest.mark.parametrize(
    "message", ["Replace the empty tip racks", "Refill the tip boxes, empty the trash"]
)
def test_tips_and_trash_change_no_volumes(message: str) -> None:
    said = _read(message)
    assert said.tips
    assert not said.volumes_unsure
    assert not said.replaced


def test_shaking_is_heard() -> None:
    assert _read("Vortex the plate, put it back").shaken
    assert not _read("Put the plate back").shaken


def test_a_long_message_is_read_in_no_time() -> None:
    begun = time.process_time()
    _read("new tube " * 20_000)
    assert time.process_time() - begun < 5
