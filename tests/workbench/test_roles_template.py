"""The roles to paste: a protocol with them in it is judged as it was without them."""

from __future__ import annotations

from pathlib import Path

from aegis_ot.preflight import load_rules
from aegis_ot.vocabulary import VerdictWord
from aegis_ot.workbench import CheckedProtocol, CheckSettings, check_files
from aegis_ot.workbench.roles_template import roles_template

TWO_ASSAYS = """
metadata = {"protocolName": "Serial dilution of a DNA standard, and qPCR", "apiLevel": "2.15"}

def run(protocol):
    tips = [protocol.load_labware("opentrons_96_filtertiprack_200ul", slot) for slot in (1, 5)]
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    dilution = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 4)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3, label="qPCR plate")
    pipette = protocol.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    master_mix, diluent, template = tubes["A1"], tubes["A2"], tubes["B1"]
    series = dilution.rows()[0][:6]
    ntc = plate["H12"]
    pipette.transfer(90, diluent, series[1:])
    pipette.transfer(100, template, series[0])
    pipette.transfer(20, series[:-1], series[1:], new_tip="always", mix_after=(3, 50))
    pipette.transfer(20, master_mix, [*plate.rows()[0][:6], ntc])
    pipette.transfer(20, series, plate.rows()[0][:6], new_tip="always")
    pipette.transfer(20, series[0], ntc)
    pipette.transfer(20, diluent, ntc)
"""
NOTHING_NAMED = """
metadata = {"protocolName": "Move", "apiLevel": "2.15"}

def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    pipette = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    pipette.pick_up_tip()
    for tube, well in zip(rack.wells()[:4], plate.wells()):
        pipette.aspirate(100, tube)
        pipette.dispense(100, well)
    pipette.aspirate(100, plate["A1"])
    pipette.dispense(100, rack["A1"])
    pipette.drop_tip()
"""


def _checked(folder: Path, text: str) -> CheckedProtocol:
    path = folder / "protocol.py"
    path.write_text(text)
    return check_files([path], CheckSettings(timeout_s=60), load_rules()).protocols[0]


def _pasted(text: str, template: str) -> str:
    return "from aegis_ot import guard\n" + text.replace("def run(", f"{template}def run(")


def _told(checked: CheckedProtocol) -> list[tuple]:
    return [(f.rule, f.severity, len(f.lines), f.wells) for f in checked.findings]


def test_what_was_found_is_found_with_the_roles_of_two_assays_pasted(tmp_path: Path) -> None:
    before = _checked(tmp_path, TWO_ASSAYS)
    assert before.verdict is VerdictWord.FAIL
    template = roles_template(before, load_rules())
    assert "assay=" not in template
    assert '"ntc": ["3:H12"],  # no-template control: name `ntc` at line 12' in template
    assert '"series": ["4:A2-A6,A1"]' in template
    after = _checked(tmp_path, _pasted(TWO_ASSAYS, template))
    assert _told(after) == _told(before)


def test_what_only_follows_is_not_written_as_if_it_were_known(tmp_path: Path) -> None:
    before = _checked(tmp_path, NOTHING_NAMED)
    assert before.verdict is VerdictWord.WARN
    template = roles_template(before, load_rules())
    assert '        # "source": [],  # source: which wells?' in template
    assert "#   2:A1-D1" in template
    after = _checked(tmp_path, _pasted(NOTHING_NAMED, template))
    assert _told(after) == _told(before)


BESIDE_A_SERIES = """
metadata = {"protocolName": "Serial dilution", "apiLevel": "2.15"}

def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3)
    assay = protocol.load_labware("corning_96_wellplate_360ul_flat", 4)
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    pipette = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    diluent, stock = trough["A1"], trough["A2"]
    series = plate.rows()[0][:7]
    sera = tubes.wells()[:4]
    pipette.transfer(100, diluent, series[1:], new_tip="once")
    pipette.transfer(200, stock, series[0])
    pipette.transfer(100, series[:-1], series[1:], mix_after=(3, 50), new_tip="always")
    pipette.transfer(20, sera, assay.rows()[0][:4], new_tip="once")
"""


def test_what_is_wrong_beside_a_series_is_told_with_the_roles_pasted_too(tmp_path: Path) -> None:
    before = _checked(tmp_path, BESIDE_A_SERIES)
    assert {one.rule for one in before.findings} == {"GEN-1"}
    assert 17 in before.findings[0].lines
    template = roles_template(before, load_rules())
    after = _checked(tmp_path, _pasted(BESIDE_A_SERIES, template))
    assert _told(after) == _told(before)
