"""What code verifies of the roles that a model proposes, case by case."""

from __future__ import annotations

import functools

import pytest

from aegis_ot.adapters.opentrons.rehearsal import Script
from aegis_ot.preflight import Options, load_rules, record
from aegis_ot.preflight.evidence import Evidence, Kind
from aegis_ot.preflight.judging import Interpretation
from aegis_ot.preflight.opinion.proposals import verify_proposals
from aegis_ot.vocabulary import Citation, RoleProposal

PROTOCOL = """metadata = {"apiLevel": "2.15", "protocolName": "PCR set-up"}
# In the rack: first comes the   polymerase mix, then genomic DNA,
# then water. H12 of the plate stays without DNA.
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 4, "PCR plate")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    primers = rack["B1"]
    p20.transfer(15, rack["A1"], [plate["A1"], plate["H12"]])
    p20.transfer(2, primers, [plate["A1"], plate["H12"]])
    p20.transfer(5, rack["A2"], plate["A1"])
    p20.transfer(5, rack["A3"], plate["H12"])
"""

STANDARDS = """metadata = {"apiLevel": "2.15", "protocolName": "Bradford assay"}
# Column 1 of the plate gets the BSA standards: 2000, 1000, 500 and 250 ug/mL,
# and the blank below them. Well B11 counts 12.
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 4)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    p300.transfer(20, rack.wells()[:5], plate.wells()[:5], new_tip="always")
"""


@functools.cache
def read(text: str) -> Interpretation:
    return Interpretation(record(Script(text, "protocol.py")), load_rules(), Options())


def verified(*proposals: RoleProposal, text: str = PROTOCOL) -> tuple[list[Evidence], list[str]]:
    accepted, rejected = verify_proposals(proposals, read(text), "m")
    return list(accepted), rejected


def said(
    role: str, wells: str, line: int = 2, quote: str = "genomic DNA", levels: tuple[str, ...] = ()
) -> RoleProposal:
    return RoleProposal(role, tuple(wells.split()), levels, (Citation(line, quote),))


def reason(proposal: RoleProposal, text: str = PROTOCOL) -> str:
    accepted, rejected = verified(proposal, text=text)
    assert accepted == []
    (told,) = rejected
    return told


def test_what_stands_becomes_evidence_of_the_weakest_kind() -> None:
    (one,), rejected = verified(said("template", "2:A2"))
    assert rejected == []
    assert (one.kind, one.role) == (Kind.MODEL, "template")
    assert [ref.address for ref in one.wells] == ["2:A2"]
    assert one.citation == "read by m at line 2: 'genomic DNA'"


@pytest.mark.parametrize("place", ["2:A2", "slot 2:A2", "Slot 2: A2", "rack:A2"])
def test_a_well_may_be_named_by_slot_or_by_the_labwares_name(place: str) -> None:
    accepted, _ = verify_proposals(
        [RoleProposal("template", (place,), (), (Citation(2, "genomic DNA"),))], read(PROTOCOL), "m"
    )
    assert [ref.address for one in accepted for ref in one.wells] == ["2:A2"]


def test_blanks_in_a_quote_do_not_matter() -> None:
    accepted, _ = verified(said("master_mix", "2:A1", 2, "comes the polymerase  mix"))
    assert len(accepted) == 1


@pytest.mark.parametrize(
    ("line", "quote", "why"),
    [
        (3, "genomic DNA", "does not stand at line 3"),
        (1, "genomic DNA", "does not stand at line 1"),
        (2, "Genomic DNA", "does not stand at line 2"),
        (2, "genomic DNA, then water", "does not stand at line 2"),
        (0, "genomic DNA", "does not stand at line 0"),
        (-1, "genomic DNA", "does not stand at line -1"),
        (999, "genomic DNA", "does not stand at line 999"),
        (2, "", "says nothing"),
        (2, " ,", "says nothing"),
    ],
)
def test_a_quote_stands_verbatim_at_its_line(line: int, quote: str, why: str) -> None:
    assert why in reason(said("template", "2:A2", line, quote))


def test_every_quote_has_to_stand() -> None:
    both = (Citation(2, "genomic DNA"), Citation(3, "made up"))
    assert "'made up' does not stand at line 3" in reason(
        RoleProposal("template", ("2:A2",), (), both)
    )


def test_without_a_citation_there_is_no_role() -> None:
    assert "cites nothing" in reason(RoleProposal("template", ("2:A2",)))


@pytest.mark.parametrize("place", ["9:A1", "2:E1", "2:Z99", "A2", "4:", "", ":", "the rack"])
def test_wells_exist(place: str) -> None:
    told = reason(RoleProposal("template", (place,), (), (Citation(2, "genomic DNA"),)))
    assert f"there is no well {place!r} on the deck" in told


def test_wells_are_of_one_labware() -> None:
    assert "several labware" in reason(said("water", "2:A3 4:H12"))


def test_a_well_that_the_run_forgets_may_be_named() -> None:
    (one,), _ = verified(said("ntc", "4:G12 4:H12", 3, "H12 of the plate stays without DNA"))
    assert [ref.address for ref in one.wells] == ["4:G12", "4:H12"]


def test_the_run_uses_their_labware() -> None:
    idle = PROTOCOL.replace(
        "    p20 =", '    protocol.load_labware("biorad_96_wellplate_200ul_pcr", 5)\n    p20 ='
    )
    assert "the run does not use this labware" in reason(said("template", "5:A1"), idle)
    assert "it names no well" in reason(said("template", ""))


def test_the_role_is_one_of_a_family_in_force() -> None:
    assert "pcr knows no such role" in reason(said("vehicle", "2:A2"))
    assert "pcr knows no such role" in reason(said("", "2:A2"))


def test_its_side_agrees_with_the_use() -> None:
    told = reason(said("water", "4:H12", 3, "then water"))
    assert "4:H12 is filled first, and a water is drawn from" in told
    told = reason(said("reaction", "2:A3", 3, "then water"))
    assert "2:A3 is drawn from first, and a reaction is filled" in told
    accepted, _ = verified(said("ntc", "4:H12", 3, "H12 of the plate stays without DNA"))
    assert len(accepted) == 1


def test_stronger_evidence_does_not_contradict_it() -> None:
    told = reason(said("template", "2:B1"))
    assert told == ("2:B1 as template, not accepted: 2:B1 is primer by name `primers` at line 9")


def test_two_proposals_for_one_well_do_not_both_stand() -> None:
    accepted, rejected = verified(said("template", "2:A2"), said("water", "2:A2", 3, "then water"))
    assert [one.role for one in accepted] == ["template"]
    assert rejected == ["2:A2 as water, not accepted: 2:A2 is proposed as template as well"]


def levels(*told: str, line: int = 2, quote: str = "", wells: str = "4:A1-D1") -> RoleProposal:
    quote = quote or "the BSA standards: 2000, 1000, 500 and 250 ug/mL"
    return said("standard_well", wells, line, quote, told)


def test_levels_stand_in_the_quote() -> None:
    (one,), rejected = verified(levels("2000", "1000", "500", "250"), text=STANDARDS)
    assert rejected == []
    assert one.levels == (2000.0, 1000.0, 500.0, 250.0)
    assert [ref.name for ref in one.wells] == ["A1", "B1", "C1", "D1"]


def test_one_level_is_of_all_wells() -> None:
    (one,), _ = verified(levels("250 ug/mL"), text=STANDARDS)
    assert len(one.levels) == 4
    assert len(set(one.levels)) == 1


def test_a_unit_may_stand_once_for_all() -> None:
    (one,), _ = verified(
        levels("2000 ug/mL", "1000 ug/mL", "500 ug/mL", "250 ug/mL"), text=STANDARDS
    )
    assert one.levels == (2.0, 1.0, 0.5, 0.25)


def test_a_level_may_be_a_word() -> None:
    (one,), _ = verified(
        said("blank_well", "4:E1", 3, "the blank below them", ("blank",)), text=STANDARDS
    )
    assert one.levels == (0.0,)


@pytest.mark.parametrize(
    ("told", "why"),
    [
        (("125",), "the level '125' stands in no quote"),
        (("50",), "the level '50' stands in no quote"),
        (("250 mg/mL",), "the level '250 mg/mL' stands in no quote"),
        (("2000", "1000"), "it tells 2 levels for 4 wells"),
        (("much",), "'much' is no concentration or dose"),
        (("nan",), "'nan' is no concentration or dose"),
        (("-1",), "'-1' is no concentration or dose"),
    ],
)
def test_levels_that_do_not_stand(told: tuple[str, ...], why: str) -> None:
    assert why in reason(levels(*told), STANDARDS)


def test_the_number_of_a_well_is_no_level() -> None:
    told = reason(levels("11", line=3, quote="Well B11 counts 12"), STANDARDS)
    assert "the level '11' stands in no quote" in told


def test_levels_may_be_told_once_for_each_column() -> None:
    quote = "BSA standards: 2000, 1000, 500 and 250 ug/mL"
    text = STANDARDS.replace(
        "rack.wells()[:5], plate.wells()[:5]", "rack['A1'], plate.wells()[:16]"
    )
    one = said("standard_well", "4:A1-H2", 2, quote, ("2000 ug/mL", "1000 ug/mL"))
    (evidence,), rejected = verified(one, text=text)
    assert rejected == []
    assert evidence.levels == (2.0,) * 8 + (1.0,) * 8
    two_columns_three_levels = said("standard_well", "4:A1-H2", 2, quote, ("2000", "1000", "500"))
    assert "3 levels for 16 wells" in reason(two_columns_three_levels, text)


def test_a_quote_one_line_off_is_told_where_it_stands() -> None:
    told = reason(said("template", "2:A2", line=3))
    assert told.endswith("'genomic DNA' does not stand at line 3; it stands at line 2")
