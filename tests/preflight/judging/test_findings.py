"""What a finding says of the place where it was done."""

from __future__ import annotations

from aegis_ot.preflight import Options, Script, load_rules, record
from aegis_ot.preflight.judging import Interpretation, Report, judge
from aegis_ot.vocabulary import VerdictWord

HELPER = """
metadata = {{"protocolName": "qPCR", "apiLevel": "2.15"}}

def move(pipette, source, target):
    pipette.aspirate(5, source)
    pipette.dispense(5, target)

def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    master_mix, template, water, ntc = tubes["A1"], tubes["A2"], tubes["A3"], plate["H12"]
    p20.pick_up_tip()
    for well in (plate["A1"], ntc):
        move(p20, master_mix, well)
    p20.drop_tip()
    p20.pick_up_tip()
    move(p20, template, plate["A1"]){waiver}
    move(p20, water, ntc)
    p20.drop_tip()
"""


def checked(text: str) -> Report:
    recording = record(Script(text, "protocol.py"))
    return judge(Interpretation(recording, load_rules(), Options(assay=("pcr",))))


def test_of_a_function_that_several_lines_call_the_call_is_told() -> None:
    report = checked(HELPER.format(waiver=""))
    (found,) = (one for one in report.findings if one.rule == "PCR-2")
    assert "at line 5 (called at line 19)" in found.message
    assert "at line 6 (called at line 20)" in found.message
    assert found.lines == (5, 6)


def test_a_waiver_beside_a_call_waives_nothing_that_the_function_did_for_others() -> None:
    waiver = "  # aegis: ignore[PCR-2] the template is meant for A1"
    report = checked(HELPER.format(waiver=waiver))
    assert report.verdict is VerdictWord.FAIL
    assert "PCR-2" in {one.rule for one in report.findings}


def test_a_function_that_one_line_calls_needs_no_more_than_its_own_line() -> None:
    text = HELPER.format(waiver="")
    body, _, rest = text.partition("def run(protocol):")
    text = f"{body}def set_up(protocol):{rest}\n\ndef run(protocol):\n    set_up(protocol)\n"
    report = checked(text)
    (found,) = (one for one in report.findings if one.rule == "PCR-2")
    assert "at line 5 (called at line 19)" in found.message
