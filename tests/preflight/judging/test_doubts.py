"""What an undecided rule asks for, and that the answer decides it."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence

import pytest

from aegis_ot.preflight import Options, Script, load_rules, record
from aegis_ot.preflight.judging import Interpretation, Report, judge
from aegis_ot.settings import Settings
from aegis_ot.vocabulary import VerdictWord

DECK = """
{head}
metadata = {{"protocolName": "{title}", "apiLevel": "2.15"}}

def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (7, 8)]
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 3)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 4)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=tips)
{body}
"""
PCR = """
p300.transfer(40, rack["D6"], plate.columns()[0][:4], new_tip="once")
p300.transfer(20, rack.columns()[0], plate.columns()[0][:4], new_tip="always")
"""
PCR_ROLES = {"template": ["2:A1-D1"], "master_mix": ["2:D6"], "reaction": ["3:A1-D1"]}
ONE_TIP_FOR_TUBES = """
p300.pick_up_tip()
for n in range(6):
    p300.aspirate(50, rack.rows()[0][n])
    p300.dispense(50, plate.rows()[0][n])
p300.drop_tip()
"""


def checked(
    body: str,
    title: str = "Set-up",
    head: str = "",
    assay: Sequence[str] = (),
    roles: Mapping[str, Sequence[str]] | None = None,
) -> Report:
    text = DECK.format(head=head, title=title, body=textwrap.indent(body.strip("\n"), "    "))
    options = Options(assay=tuple(assay), roles=roles or {})
    return judge(Interpretation(record(Script(text, "protocol.py")), load_rules(), options))


def test_a_role_that_no_well_has_is_said_by_an_empty_list() -> None:
    report = checked(PCR, assay=["pcr"], roles=PCR_ROLES)
    assert {one.rule for one in report.undecided} == {"PCR-2", "PCR-4"}
    report = checked(PCR, assay=["pcr"], roles={**PCR_ROLES, "ntc": []})
    assert report.undecided == ()
    assert report.verdict is VerdictWord.PASS
    assert {"PCR-2", "PCR-4"} <= set(report.judged)


def test_what_a_name_says_is_judged_even_where_the_guard_is_told_that_there_is_none() -> None:
    into_the_ntc = 'ntc = plate["H12"]\np300.transfer(20, rack["A1"], ntc)\n'
    report = checked(PCR + into_the_ntc, assay=["pcr"], roles={**PCR_ROLES, "ntc": []})
    assert {one.rule for one in report.findings} == {"PCR-1", "PCR-4"}


@pytest.mark.parametrize(
    ("assay", "rule", "roles"),
    [
        ("pcr", "PCR-1", {"reaction": ["3:A1-D1"], "template": ["2:A1-D1"], "master_mix": []}),
        ("bradford", "BRD-3", {"sample": ["2:A1-D1"], "dye": []}),
        ("cell_treatment", "CELL-2", {"vehicle_control": ["3:A1-D1"], "vehicle": []}),
    ],
)
def test_a_liquid_that_wells_must_get_is_missed_where_there_is_none(
    assay: str, rule: str, roles: dict[str, list[str]]
) -> None:
    report = checked(PCR, assay=[assay], roles=roles)
    assert rule in {one.rule for one in report.undecided}


ZERO_DOSE = """
vehicle_control = plate.columns()[0][:3]
for dose, drug, column in zip([0, 1, 10], rack.rows()[0], plate.columns()):
    for well in column[:3]:
        p300.transfer(20, drug, well, new_tip="always")
"""


def test_a_loop_s_name_does_not_accuse_the_tube_that_controls_alone_are_given() -> None:
    report = checked(ZERO_DOSE, title="Drug treatment of cells")
    assert report.verdict is VerdictWord.PASS
    asked = {one.rule: one for one in report.undecided}["CELL-1"]
    assert asked.reason == (
        "only the name of its labware, or one that held other wells too, calls A1 of Opentrons 24 "
        "Tube Rack with NEST 1.5 mL Snapcap (slot 2) drug, and it goes into vehicle controls alone"
    )
    again = 'p300.transfer(20, rack["A2"], vehicle_control[0])\n'
    (found,) = checked(ZERO_DOSE + again, title="Drug treatment of cells").findings
    assert found.rule == "CELL-1"
    assert "drawn from drug in A2 of " in found.message


POURED = """
samples, buffer, stock = rack.rows()[0][:4], trough["A1"], trough["A5"]
p300.transfer(50, samples, plate.rows()[0][:4], new_tip="always")
p300.transfer(200, buffer, stock)
p300.transfer(30, plate["A1"], stock)
p300.transfer(20, stock, plate.rows()[0][:4], new_tip="always")
"""


def test_a_sample_poured_into_a_stock_that_is_being_made_is_an_error() -> None:
    report = checked(POURED, title="Transfer")
    assert report.verdict is VerdictWord.FAIL
    assert "GEN-2" in {one.rule for one in report.findings}


def test_tubes_that_nothing_names_share_no_tip_unasked() -> None:
    named = """
samples = rack.rows()[1][:3]
p300.transfer(50, samples, plate.rows()[1][:3], new_tip="always")
"""
    report = checked(named + ONE_TIP_FOR_TUBES)
    (asked,) = {one for one in report.undecided if one.rule == "GEN-1"}
    assert "nothing says what A2 of " in asked.reason
    assert "and the tip that met A1 of " in asked.reason
    assert asked.paste == '@guard(roles={"source": ["2:A1-A6"], "stock": ["2:A1-A6"]})'
    assert asked.to_write == "write, with each of these wells in its one role"
    roles = {"material": ["2:A1-A6", "2:B1-B3"]}
    report = checked(named + ONE_TIP_FOR_TUBES, roles=roles)
    assert {one.rule for one in report.findings} == {"GEN-1"}
    assert report.verdict is VerdictWord.FAIL
    report = checked(named + ONE_TIP_FOR_TUBES, roles={"stock": ["2:A1-A6"]})
    assert report.verdict is VerdictWord.PASS


def test_an_unknown_end_of_a_series_is_offered_at_both() -> None:
    body = """
row = plate.rows()[0][:5]
p300.transfer(50, trough["A1"], row, new_tip="once")
p300.transfer(50, row[:-1], row[1:], new_tip="always", mix_after=(2, 20))
"""
    report = checked(body, title="Serial dilution")
    asked = {one.rule: one for one in report.undecided}["SD-2"]
    assert asked.reason == "nothing says which end of the series holds the stock"
    assert asked.paste == '@guard(roles={"stock": ["3:A1,A5"]})'


def test_what_no_assay_is_needed_for_is_judged_where_the_assay_is_a_guess() -> None:
    report = checked(
        """
protocol.comment("magnetic module: wash, elute and incubate")
p300.transfer(50, trough["A1"], plate.wells()[:3])
"""
    )
    assert {"GEN-1", "GEN-2", "GEN-3"} <= set(report.judged)
    assert not report.undecided


NEAR_THE_SAMPLES = """
samples = rack.rows()[1][:3]
water = trough["A1"]
{loads}
p300.transfer(100, samples, plate.rows()[1][:3], new_tip="always")
p300.pick_up_tip()
for well in plate.rows()[1][:3]:
    p300.aspirate(40, water)
    p300.dispense(40, well.bottom(12))
p300.drop_tip()
"""
LOADS = """
for number, tube in enumerate(samples):
    tube.load_liquid(protocol.define_liquid(f"Sample {number}", "", "#ffffff"), 500)
water.load_liquid(protocol.define_liquid("Water", "", "#ffffff"), 10000)
"""


def test_a_tip_near_a_known_level_warns_where_liquids_are_declared() -> None:
    report = checked(NEAR_THE_SAMPLES.format(loads=LOADS))
    assert report.verdict is VerdictWord.WARN
    (found,) = (one for one in report.findings if one.rule == "GEN-2")
    assert found.message.endswith("came near the liquid there and may have stayed clear of it.")
    report = checked(NEAR_THE_SAMPLES.format(loads=""))
    assert report.verdict is VerdictWord.PASS
    reason = {one.rule: one for one in report.undecided}["GEN-2"].reason
    assert "line 17, or only came near the liquid: it is not sure how high that stands" in reason


HIGH_OVER_THE_TUBES = """
buffer_stock = trough["A1"]
magnesium_stock = trough["A2"]
{names}
for stock in (buffer_stock, magnesium_stock):
    p300.pick_up_tip()
    for tube in rack.rows()[0][:3]:
        p300.aspirate(40, stock)
        p300.dispense(40, tube.bottom({height}))
    p300.drop_tip()
{then}
"""
BY_VARIABLE = "sample1, sample2, sample3 = rack.rows()[0][:3]"
DRAWN = """
for tube in rack.rows()[0][:3]:
    p300.pick_up_tip()
    p300.mix(3, 200, tube)
    p300.drop_tip()
"""


@pytest.mark.parametrize(
    ("names", "height", "then", "warned"),
    [
        (BY_VARIABLE, 20, "", False),
        (BY_VARIABLE, 20, DRAWN, True),
        (BY_VARIABLE, 1, "", True),
    ],
    ids=["nothing shows liquid", "more is mixed than was given", "at the bottom"],
)
def test_what_is_no_more_than_called_a_sample_may_be_empty_under_a_tip_that_stands_high(
    names: str, height: int, then: str, warned: bool
) -> None:
    body = HIGH_OVER_THE_TUBES.format(names=names, height=height, then=then)
    report = checked(body, assay=["generic"])
    told = {one.rule for one in report.findings}
    assert ({"GEN-1", "GEN-2"} <= told) is warned
    if not warned:
        assert not told
        reasons = {one.rule: one.reason for one in report.undecided}
        assert "sure how high that stands" in reasons["GEN-1"]


def test_a_tip_high_over_the_samples_warns_where_the_guard_is_told_of_them() -> None:
    body = HIGH_OVER_THE_TUBES.format(names=BY_VARIABLE, height=20, then="")
    report = checked(body, assay=["generic"], roles={"sample_well": ["2:A1-A3"]})
    assert {"GEN-1", "GEN-2"} <= {one.rule for one in report.findings}
    assert report.verdict is VerdictWord.WARN


SERIES = """
row = plate.rows()[0][:5]
{filler} = trough["A2"]
p300.transfer(50, {filler}, row[1:], new_tip="once")
p300.transfer(100, rack["A1"], row[0])
p300.transfer(50, row[:-1], row[1:], new_tip="always", mix_after=(3, 40))
"""


def test_a_diluent_that_use_alone_tells_may_be_the_wrong_reservoir() -> None:
    report = checked(SERIES.format(filler="filler"), title="Serial dilution")
    asked = {one.rule: one for one in report.undecided}["SD-4"]
    assert asked.reason == (
        "nothing says that A2 of NEST 12 Well Reservoir 15 mL (slot 4), which fills the series, is "
        "the diluent"
    )
    assert '": ["4:A2"]' in asked.paste
    report = checked(SERIES.format(filler="diluent"), title="Serial dilution")
    assert "SD-4" not in {one.rule for one in report.undecided}


def test_wells_that_get_the_mix_and_have_no_role_are_asked_for() -> None:
    body = 'master_mix = rack["A1"]\np300.transfer(40, master_mix, plate.columns()[0][:3])\n'
    report = checked(body, title="qPCR")
    asked = {one.rule: one for one in report.undecided}["PCR-1"]
    assert asked.reason == "nothing says which well is the reaction"
    assert asked.paste == '@guard(roles={"reaction": ["3:A1-C1"]})'


def test_an_assay_may_be_several() -> None:
    options = Options.from_settings(Settings(assay="serial_dilution, generic"))
    assert options.assay == ("serial_dilution", "generic")
    assert Options.from_settings(Settings()).assay == ()


def test_what_moves_beside_a_series_is_judged_whatever_assay_is_given() -> None:
    beside = SERIES.format(filler="diluent") + (
        'p300.transfer(20, rack.rows()[3][:4], plate.rows()[7][:4], new_tip="once")\n'
    )
    for assay in ((), ("serial_dilution",)):
        report = checked(beside, title="Serial dilution", assay=assay)
        assert "GEN-1" in {one.rule for one in (*report.findings, *report.undecided)}
