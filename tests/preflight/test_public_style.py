"""Protocols in the style of public ones: silent about roles, correct, and never accused."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aegis_ot.adapters.opentrons.rehearsal import Script
from aegis_ot.preflight import check_script, load_rules
from aegis_ot.vocabulary import Severity

HERE = Path(__file__).parent.parent / "protocols" / "public_style"
EXPECTED = json.loads((HERE / "expected.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", sorted(EXPECTED))
def test_a_protocol_in_public_style_is_not_accused(name: str) -> None:
    script = Script((HERE / name).read_text(encoding="utf-8"), name)

    report = check_script(script, load_rules())

    errors = {
        found.rule: found.message for found in report.findings if found.severity is Severity.ERROR
    }
    assert set(errors) <= set(EXPECTED[name]["may_fire"]), errors


SAMPLE_PLATE = """
metadata = {"apiLevel": "2.15"}

def run(protocol):
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 1)
    sample_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 2{label})
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    water = tubes["C1"]
    for column in range(8):
        p300.transfer(20, water, sample_plate.rows()[0][column]{mixed})
    p300.pick_up_tip()
    p300.aspirate(200, water)
    for well in sample_plate.rows()[0][:8]:
        p300.dispense(20, well.bottom(0.5))
    p300.drop_tip()
"""


@pytest.mark.parametrize(
    ("mixed", "label", "severity"),
    [
        ("", ', label="samples"', Severity.WARNING),
        (", mix_after=(2, 20)", "", Severity.WARNING),
        (", mix_after=(2, 20)", ', label="samples"', Severity.ERROR),
    ],
)
def test_a_sample_plate_that_is_only_filled_may_be_one_for_samples(
    mixed: str, label: str, severity: Severity
) -> None:
    text = SAMPLE_PLATE.replace("{mixed}", mixed).replace("{label}", label)
    script = Script(text, "protocol.py")

    report = check_script(script, load_rules())

    assert {f.severity for f in report.findings if f.rule == "GEN-1"} == {severity}
