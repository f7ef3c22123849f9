"""What runs through a filter or a column is not held there."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import Script, check_script

PROTOCOL = """
metadata = {{"apiLevel": "2.15"}}

def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 2, "{label}")
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    pipette = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    wash = trough["A1"]
    for _ in range(3):
        pipette.transfer(150, wash, plate["A1"], new_tip="once")
"""


@pytest.mark.parametrize(("label", "full"), [("Filter plate", False), ("Culture plate", True)])
def test_a_filter_is_never_full(label: str, full: bool) -> None:
    report = check_script(Script(PROTOCOL.format(label=label), "protocol.py"))
    assert bool(report.findings) is full
