"""Which evidence decides what a well is for."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import Options, Script, load_rules, record
from aegis_ot.preflight.judging import Interpretation

from ..reading import read, roles_by_well


def test_a_loaded_liquid_beats_a_name() -> None:
    reading = read(
        """
        water = tubes["A1"]
        water.load_liquid(protocol.define_liquid("Master mix", "", "#ffffff"), 100)
        p20.transfer(2, water, plate["A1"])
        """
    )
    assert roles_by_well(reading)["2:A1"] == "master_mix"


def test_what_the_guard_is_given_beats_all() -> None:
    text = read("ntc = plate['A1']\np20.transfer(2, tubes['A1'], ntc)").recording.text
    options = Options(assay=("pcr",), roles={"positive_reaction": ["1:A1"]})
    reading = Interpretation(record(Script(text, "p.py")), load_rules(), options)
    assert roles_by_well(reading)["1:A1"] == "positive_reaction"


def test_the_label_of_a_plate_speaks_for_wells_that_nothing_else_speaks_for() -> None:
    reading = read(
        """
        ntc = plate["H12"]
        p20.transfer(2, tubes["A1"], [plate["A1"], ntc])
        """,
        label='"sample reactions"',
    )
    assert roles_by_well(reading) == {"1:A1": "reaction", "1:H12": "ntc"}


def test_the_last_word_is_the_head_of_a_name() -> None:
    reading = read(
        """
        template_buffer_water = tubes["A1"]
        p20.transfer(2, template_buffer_water, plate["A1"])
        """
    )
    assert roles_by_well(reading)["2:A1"] == "water"


@pytest.mark.parametrize(
    ("assay", "label"),
    [
        ("bradford", "Standards and blank"),
        ("cell_treatment", "Compound / vehicle"),
        ("pcr", "Samples and positive control"),
    ],
)
def test_a_label_that_joins_a_kind_with_its_general_role_says_of_no_well_which(
    assay: str, label: str
) -> None:
    reading = read(
        'p20.transfer(2, plate.wells()[:2], tubes["A1"])', label=f'"{label}"', assay=assay
    )
    assert roles_by_well(reading) == {}


def test_a_name_that_joins_several_things_says_of_no_well_which() -> None:
    reading = read(
        """
        p20.transfer(2, tubes["A1"], plate.wells()[:2])
        """,
        label='"samples and NTC"',
    )
    assert roles_by_well(reading) == {}


def test_what_a_map_of_reagents_calls_otherwise_is_no_reagent() -> None:
    head = """REAGENTS = {"Standard": "A1", "Control RNA": "A2", "working reagent": "A3"}"""
    body = """
        for name, place in REAGENTS.items():
            p20.transfer(2, tubes[place], plate["A1"])
        """
    roles = roles_by_well(read(body, head, assay="bradford"))
    assert roles["2:A1"] == "standard"
    assert "2:A2" not in roles
    assert roles["2:A3"] == "dye"


def test_names_that_contradict_each_other_are_told() -> None:
    reading = read(
        """
        ntc = plate["H12"]
        positive_control = plate["H12"]
        p20.transfer(2, tubes["A1"], ntc)
        """
    )
    (roles,) = reading.roles
    (conflict,) = roles.conflicts
    assert "`ntc`" in conflict
    assert "`positive_control`" in conflict


def test_a_dose_of_zero_is_no_drug() -> None:
    reading = read(
        """
        tubes_by_dose = {"drug 0 uM": tubes["A1"], "drug 10 uM": tubes["A2"]}
        p20.transfer(2, tubes_by_dose["drug 0 uM"], plate["A1"])
        p20.transfer(2, tubes_by_dose["drug 10 uM"], plate["B1"])
        """,
        assay="cell_treatment",
    )
    assert roles_by_well(reading) == {"2:A2": "drug"}


def test_a_mix_that_is_filled_and_given_on_is_a_mix() -> None:
    reading = read(
        """
        dna_mix = tubes["C1"]
        template = tubes["A1"]
        p20.transfer(10, template, dna_mix)
        p20.transfer(5, dna_mix, plate["A1"])
        """
    )
    assert roles_by_well(reading)["2:C1"] == "master_mix"


@pytest.mark.parametrize(("named", "sample"), [("[:1]", True), ("[:6]", False)])
def test_a_column_named_well_by_well_leaves_out_what_is_not_named(named: str, sample: bool) -> None:
    reading = read(
        f"""
        m300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[tips])
        samples = plate.columns()[0]{named}
        protocol.comment(str(samples))
        m300.transfer(20, tubes["A1"], plate["A1"])
        """
    )
    roles = roles_by_well(reading)
    assert roles["1:A1"] == "reaction"
    assert ("1:H1" in roles) is sample


def test_a_name_that_means_the_plate_of_a_series_is_no_diluent() -> None:
    reading = read(
        """
        dil, water = plate, tubes["A1"]
        p20.transfer(18, water, dil.rows()[0][1:4])
        for source, well in zip(dil.rows()[0][:3], dil.rows()[0][1:4]):
            p20.transfer(2, source, well, mix_after=(3, 10))
        """,
        assay="serial_dilution",
    )
    roles = roles_by_well(reading)
    assert roles["2:A1"] == "diluent"
    assert roles["1:A2"] == "series"
    assert "1:A1" not in roles
