"""What makes an error: names of variables alone do not, and one liquid in several wells is one."""

from __future__ import annotations

import textwrap

import pytest

from aegis_ot.preflight import Report, Script, check_script, load_rules

DECK = """
metadata = {"apiLevel": "2.15"}

def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1)
    deep = protocol.load_labware("nest_96_wellplate_2ml_deep", 2)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (4, 5)]
    eight = protocol.load_instrument("p300_multi_gen2", "left", tip_racks=tips)
    one = protocol.load_instrument("p300_single_gen2", "right", tip_racks=tips)
    def load(wells, name):
        for well in wells:
            well.load_liquid(protocol.define_liquid(name, "", "#ffffff"), 900)
"""


def _report(body: str) -> Report:
    text = DECK + textwrap.indent(textwrap.dedent(body), "    ")
    return check_script(Script(text, "p.py"), load_rules())


@pytest.mark.parametrize("name", ["IPTG", "antibody", "M13 phage"])
def test_one_liquid_in_two_columns_is_no_carry_over(name: str) -> None:
    report = _report(
        f"""
        load(deep.columns()[0] + deep.columns()[1], "{name}")
        eight.pick_up_tip()
        for n in range(2):
            eight.transfer(30, deep.columns()[n], plate.columns()[n], new_tip="never")
        eight.drop_tip()
        """
    )
    assert not report.findings
    assert "GEN-1" in {one.rule for one in report.undecided}  # it may be one liquid, or two


@pytest.mark.parametrize("name", ["source", "samples", "my_dna"])
def test_the_name_of_a_variable_alone_makes_no_error(name: str) -> None:
    report = _report(
        f"""
        {name} = deep.rows()[0][:4]
        one.transfer(50, {name}, plate.rows()[0][:4], new_tip="once")
        """
    )
    assert {one.severity.value for one in report.findings} == {"warning"}
    assert "No more than a name" in report.findings[0].message


def test_tips_that_are_washed_are_told_once() -> None:
    report = _report(
        """
        waste, water, second = trough["A12"], trough["A1"], trough["A2"]
        for n, well in enumerate(deep.rows()[0]):
            load([well], f"Sample {n}")
        one.pick_up_tip()
        for row in (0, 1):
            for sample, well in zip(deep.rows()[0], plate.rows()[row]):
                one.aspirate(50, sample)
                one.dispense(50, well)
                for wash in (water, second):
                    one.aspirate(200, wash)
                    one.dispense(200, waste)
        one.drop_tip()
        """
    )
    rinsed = [one for one in report.findings if "was rinsed" in one.message]
    assert 0 < len(rinsed) <= 2  # into the samples, and into the wells that they go to


@pytest.mark.parametrize(
    ("bath", "severity"),
    [("one.mix(3, 200, ethanol)", "warning"), ("one.mix(3, 200, sample)", "error")],
)
def test_a_tip_is_washed_by_mixing_in_what_serves_nothing_else(bath: str, severity: str) -> None:
    report = _report(
        f"""
        ethanol = trough["A12"]
        load([ethanol], "ethanol")
        for n, well in enumerate(deep.rows()[0]):
            load([well], f"Sample {{n}}")
        one.pick_up_tip()
        for sample, well in zip(deep.rows()[0], plate.rows()[0]):
            one.transfer(50, sample, well, new_tip="never")
            {bath}
        one.drop_tip()
        """
    )
    assert {one.severity.value for one in report.findings if one.rule == "GEN-1"} == {severity}
    assert ("was rinsed" in "".join(one.message for one in report.findings)) is (
        severity == "warning"
    )


def test_only_a_comment_tells_the_assay_and_handling_does_not_care() -> None:
    report = _report(
        '''
        """PCR set-up: template DNA, master mix and primers into the PCR plate; NTC in H12."""
        one.transfer(2, trough["A1"], plate.rows()[0][:4], new_tip="always")
        '''
    )
    assert not any("docstring" in one.message for one in report.findings if one.rule[:3] == "HND")


PCR = """
load([deep["A1"]], "PCR master mix")
mastermix, ntc = deep["A1"], plate["H1"]
templates = deep.columns()[3]
for n, well in enumerate(templates):
    load([well], f"template DNA {{n}}")
{step}
for template, well in zip(templates[:7], plate.columns()[0]):
    one.transfer(25, template, well)
"""


@pytest.mark.parametrize(
    ("step", "accused"),
    [
        ("", True),
        ("# one.transfer(25, mastermix, plate.columns()[0])", False),
        ("if not mastermix:\n    one.transfer(25, mastermix, plate.columns()[0])", False),
        ("'''\none.distribute(25, mastermix, plate.columns()[0])\n'''", False),
        ("# one.transfer(25, templates, plate.columns()[0])", True),
    ],
)
def test_a_step_that_is_left_out_accuses_nobody(step: str, accused: bool) -> None:
    report = _report(PCR.format(step=step))
    assert ("PCR-1" in {one.rule for one in report.findings}) is accused
    assert ("PCR-1" in {one.rule for one in report.undecided}) is not accused


@pytest.mark.parametrize("also", ["", "one.transfer(50, water, deep['H12'])"])
def test_what_tips_are_rinsed_with_is_no_carry_over(also: str) -> None:
    report = _report(
        f"""
        waste, water, second = trough["A12"], trough["A1"], trough["A2"]
        {also}
        load([water, second], "water")
        for n, well in enumerate(deep.rows()[0]):
            load([well], f"Sample {{n}}")
        one.pick_up_tip()
        for sample, well in zip(deep.rows()[0], plate.rows()[0]):
            one.transfer(50, sample, well, new_tip="never")
            for wash in (water, second):
                one.transfer(200, wash, waste, new_tip="never")
        one.drop_tip()
        """
    )
    assert not any("met shared stock" in one.message for one in report.findings)


def test_a_buffer_of_one_sample_alone_may_be_met_with_its_tip() -> None:
    report = _report(
        """
        load([plate["A1"]], "bead sample")
        load([trough["A1"]], "elution buffer")
        for _ in range(2):
            one.pick_up_tip(tips[0]["A1"])
            one.transfer(50, trough["A1"], plate["A1"], new_tip="never", mix_after=(2, 100))
            one.return_tip()
        """
    )
    assert not [one for one in report.findings if one.rule in ("GEN-1", "GEN-2", "CLN-3")]


@pytest.mark.parametrize(("name", "severity"), [("sample", "warning"), ("samples", "error")])
def test_one_liquid_declared_for_all_wells_may_be_one(name: str, severity: str) -> None:
    report = _report(
        f"""
        fixative = trough["A1"]
        load(deep.columns()[0] + deep.columns()[1], "{name}")
        fixative.load_liquid(protocol.define_liquid("8% PFA", "", "#ffffff"), 9000)
        eight.pick_up_tip()
        for column in deep.columns()[:3]:  # the third holds nothing
            eight.aspirate(60, fixative)
            eight.dispense(50, column[0])
            eight.dispense(10, fixative)
        eight.drop_tip()
        """
    )
    told = {one.rule: one.severity.value for one in report.findings}
    assert told == {"GEN-1": severity, "GEN-2": severity}
    assert ("All that it reaches" in report.findings[0].message) == (severity == "warning")
