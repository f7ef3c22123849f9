"""Contamination is judged in every family, by what wells are meant to hold."""

from __future__ import annotations

import textwrap

import pytest

from aegis_ot.preflight import Options, Script, load_rules, record
from aegis_ot.preflight.judging import Interpretation, Report, judge
from aegis_ot.vocabulary import Severity

DECK = """
requirements = {{"robotType": "Flex", "apiLevel": "2.19"}}

def run(protocol):
    tips = protocol.load_labware("opentrons_flex_96_tiprack_200ul", "C1")
    protocol.load_trash_bin("A3")
    plate = protocol.load_labware("nest_96_wellplate_2ml_deep", "C2", "culture plate")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", "C3")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "D2", "{trough}")
    one = protocol.load_instrument("flex_1channel_1000", "left", tip_racks=[tips])
    eight = protocol.load_instrument("flex_8channel_1000", "right", tip_racks=[tips])
    def load(well, name, volume):
        well.load_liquid(protocol.define_liquid(name, "", "#ffffff"), volume)
{body}
"""


def _report(body: str, trough: str = "reagents", assay: tuple[str, ...] = ()) -> Report:
    inside = textwrap.indent(textwrap.dedent(body).strip("\n"), "    ")
    script = Script(DECK.format(body=inside, trough=trough), "protocol.py")
    return judge(Interpretation(record(script), load_rules(), Options(assay=assay)))


def _told(report: Report) -> dict[str, Severity]:
    return {finding.rule: finding.severity for finding in report.findings}


@pytest.mark.parametrize("assay", ["pcr", "bradford", "cell_treatment", "serial_dilution"])
def test_a_tip_that_was_in_samples_and_returns_to_the_stock_is_told(assay: str) -> None:
    report = _report(
        """
        wash_buffer = trough["A4"]
        for n, well in enumerate(plate.columns()[0]):
            load(well, f"Serum {n}", 200)
        one.transfer(50, wash_buffer, plate.columns()[0], new_tip="once", mix_after=(2, 50))
        """,
        assay=(assay,),
    )
    assert set(_told(report)) & {"GEN-2", "BRD-2", "PCR-5"}


@pytest.mark.parametrize("assay", ["pcr", "bradford", "cell_treatment", "serial_dilution"])
def test_a_fresh_tip_each_time_is_decided_in_every_family(assay: str) -> None:
    report = _report(
        """
        wash_buffer = trough["A4"]
        for n, well in enumerate(plate.columns()[0]):
            load(well, f"Serum {n}", 200)
        one.transfer(50, wash_buffer, plate.columns()[0], new_tip="always", mix_after=(2, 50))
        """,
        assay=(assay,),
    )
    assert not report.findings
    assert {"GEN-1", "GEN-2"} <= set(report.judged)


def test_doses_that_rise_with_one_tip_are_the_familys_to_judge() -> None:
    report = _report(
        """
        for well in plate.rows()[0][:4]:
            load(well, "A549 cells", 200)
        for tube, dose in zip(tubes.wells(), (1, 10, 100, 1000)):
            load(tube, f"gefitinib {dose} nM", 900)
        one.pick_up_tip()
        for tube, well in zip(tubes.wells(), plate.rows()[0][:4]):
            one.transfer(20, tube, well, new_tip="never", mix_after=(1, 50))
        one.drop_tip()
        """,
        assay=("cell_treatment",),
    )
    assert not report.findings


def test_the_parts_of_a_mix_are_no_carry_over() -> None:
    report = _report(
        """
        mastermix = tubes["D1"]
        load(tubes["A1"], "primer F", 900)
        load(tubes["A2"], "polymerase", 900)
        load(tubes["A3"], "template DNA", 900)
        for part in ("A1", "A2"):
            one.transfer(300, tubes[part], mastermix, new_tip="always")
        one.distribute(20, mastermix, plate.columns()[0], new_tip="once")
        one.transfer(5, tubes["A3"], plate.columns()[0], new_tip="always")
        """,
        assay=("pcr",),
    )
    assert not report.findings


def test_one_tip_in_many_wells_is_one_finding_however_the_steps_are_written() -> None:
    wells = [f"{row}{column}" for column in (1, 2, 3) for row in "ABCDEFGH"]
    steps = "\n".join(
        f"one.aspirate(20, source['{name}'])\none.dispense(20, plate['{name}'])" for name in wells
    )
    report = _report(
        """
        source = protocol.load_labware("nest_96_wellplate_200ul_flat", "B2", "patient samples")
        for n, well in enumerate(source.wells()[:24]):
            load(well, f"Patient {n}", 100)
        one.pick_up_tip()
"""
        + textwrap.indent(steps, "        ")
        + "\n        one.drop_tip()\n"
    )
    assert 0 < len(report.findings) <= 3


def test_a_waste_row_known_by_its_first_well_is_waste_for_all_channels() -> None:
    report = _report(
        """
        liquid_waste = protocol.load_labware("nest_96_wellplate_2ml_deep", "B2").rows()[0][5:7]
        for well in plate.wells()[:16]:
            load(well, "lysate", 100)
        for well, waste in zip(plate.rows()[0][:2], liquid_waste):
            eight.pick_up_tip()
            eight.aspirate(110, well)
            eight.dispense(110, waste)
            eight.drop_tip()
        """
    )
    assert {finding.severity for finding in report.findings} == {Severity.WARNING}
    assert len(report.findings) == 1


def test_a_plate_that_leaves_the_deck_and_comes_back_is_the_same_plate() -> None:
    report = _report(
        """
        from opentrons.protocol_api import OFF_DECK
        load(plate["A1"], "Sample 1", 200)
        load(trough["A1"], "elution buffer", 9000)
        for _ in range(2):
            one.pick_up_tip(tips["A1"])
            one.transfer(50, trough["A1"], plate["A1"], new_tip="never", mix_after=(2, 100))
            one.return_tip()
            protocol.move_labware(plate, OFF_DECK)
            protocol.pause("Spin for 5 min")
            protocol.move_labware(plate, "C2")
        """
    )
    assert not report.findings
