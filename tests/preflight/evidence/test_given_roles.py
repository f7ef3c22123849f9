"""Roles that are given for places that the deck does not have are told, never passed over."""

from __future__ import annotations

import functools
import textwrap
from dataclasses import replace

import pytest

from aegis_ot.adapters.opentrons.rehearsal import Recording
from aegis_ot.errors import ConfigurationError
from aegis_ot.preflight import Interpretation, Options, Report, Script, judge, load_rules, record
from aegis_ot.preflight.check_protocol import summary

PROTOCOL = """
    metadata = {"apiLevel": "2.15", "protocolName": "qPCR set-up"}

    def run(protocol):
        tips = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
        plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2, "PCR plate")
        rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
        protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4, "Slot of tubes")
        p20 = protocol.load_instrument("p20_single_gen2", "left", [tips])
        p20.transfer(15, rack["A1"], plate.columns()[0], new_tip="once")
        p20.transfer(5, rack.columns()[1][:3], plate.columns()[0][:3], new_tip="once")
"""


@functools.cache
def recording() -> Recording:
    return record(Script(textwrap.dedent(PROTOCOL), "protocol.py"))


def told(**roles: str) -> Report:
    given = {role: (place,) for role, place in roles.items()}
    return judge(Interpretation(recording(), load_rules(), Options(roles=given)))


@pytest.mark.parametrize(
    ("place", "wrong"),
    [
        ("PCR plate:Z99", "'Z99' is no well"),
        ("PCR plate:A1-Z3", "'A1-Z3' is no well"),
        ("PCR plate:A1-H13", "'A1-H13' is no well"),
        ("3:column 9", "'column 9' is no well"),
        ("3:A1, B9", "'B9' is no well"),
        (
            "PCR plat:A1",
            "no labware is called 'PCR plat' (did you mean 'PCR plate'?); there are 'PCR plate', "
            "'3', 'Slot of tubes'",
        ),
        ("5:A1", "no labware is called '5'"),
        ("A1", "no labware is called ''"),
        ("PCR plate:A1 = much", "'much' is no concentration or dose"),
        ("PCR plate:A1 = nan", "'nan' is no concentration or dose"),
        ("PCR plate:A1 = 1e999", "'1e999' is no concentration or dose"),
    ],
)
def test_a_place_that_is_not_there_is_refused(place: str, wrong: str) -> None:
    with pytest.raises(ConfigurationError) as caught:
        told(ntc=place)
    assert f"'{place}'" in str(caught.value)
    assert wrong in str(caught.value)


def test_of_a_typo_the_nearest_names_are_told() -> None:
    with pytest.raises(ConfigurationError, match=r"no well of that labware \(did you mean 'H"):
        told(ntc="PCR plate:H13")
    with pytest.raises(ConfigurationError, match=r"there is no role 'ntcs' \(did you mean 'ntc'\?"):
        told(ntcs="PCR plate:H12")


def test_labware_that_a_parameter_may_bring_is_only_remarked() -> None:
    text = f"{recording().text}\n\ndef add_parameters(parameters): pass\n"
    options = Options(roles={"ntc": ("second plate:A1",)})
    report = judge(Interpretation(replace(recording(), text=text), load_rules(), options))
    assert ["second plate" in remark.message for remark in report.remarks] == [True]
    assert "1 remark" in summary(report)


def test_a_run_that_goes_on_is_not_ended_by_a_typo() -> None:
    options = Options(roles={"ntc": ("PCR plate:H13",)})
    for so_far in (True, False):
        report = judge(Interpretation(recording(), load_rules(), options), so_far=so_far)
        assert any("H13" in remark.message for remark in report.remarks)


@pytest.mark.parametrize(
    "place",
    [
        *("PCR plate:H12", "2:A1-H1,A3", "plate:*", "PCR plate:row H", "2:columns 1-3, A12"),
        *("slot 2:H12", "Slot 2 : H12", "Slot of tubes:A1"),
    ],
)
def test_a_place_that_is_there_is_taken(place: str) -> None:
    assert told(ntc=place).remarks == ()


def test_the_line_to_paste_offers_only_wells_of_which_nothing_is_known() -> None:
    """Not the plate's: its label makes them reactions. An NTC's tube makes its wells the NTC."""
    (open_,) = (one for one in told().undecided if one.rule == "PCR-4")
    assert open_.paste == '@guard(roles={"ntc": ["3:A1,A2-C2"], "template": ["3:A1,A2-C2"]})'


def test_the_line_to_paste_is_never_without_wells() -> None:
    everything = told(reaction="2:A1-H1", water="3:*")
    assert not [one for one in everything.undecided if "[]" in one.paste]
