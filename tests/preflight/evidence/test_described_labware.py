"""Texts describe labware by its slot, and speak of it in headings and sentences further below."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import Database, Options, Report, Script, check_script, load_database

PROTOCOL = '''"""{said}"""

metadata = {{"protocolName": "PCR set-up", "apiLevel": "2.15"}}


def run(protocol):
    a = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    b = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 4)
    c = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 5)
    d = protocol.load_labware("nest_12_reservoir_15ml", 6)
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    p20 = protocol.load_instrument("p20_single_gen2", "left", [tips])
    for name in ("A1", "A2", "A3"):
        p20.transfer(5, b[name], a[name])
        p20.transfer(5, c[name], a[name])
        p20.transfer(5, d["A2"], a[name])
'''

PLATE, KIT, TUBES, TROUGH = "2", "4", "5", "6"
DNA = {f"{TUBES}:A{number}": "template" for number in (1, 2, 3)}


@pytest.fixture(scope="module")
def database() -> Database:
    return load_database()


def check(database: Database, said: str) -> Report:
    script = Script(PROTOCOL.format(said=said), "p.py")
    return check_script(script, database, Options(assay=("pcr",)))


def roles(database: Database, said: str) -> dict[str, str]:
    """The roles of all wells but those that only follow from others."""
    report = check(database, said)
    found = {f"{told.well.slot}:{told.well.name}": told.role for told in report.roles}
    return {well: role for well, role in found.items() if role != "reaction"}


@pytest.mark.parametrize(
    "said",
    [
        "Kit rack (slot 4)\nOther rack (slot 5)\n\nKit rack: A1 master mix, A2 water",
        "2.1 Kit rack (slot 4, on ice)\n2.2 Others (slot 5)\n\n"
        "Kit rack\n  A1 master mix\n  A2 water",
        "Slot 4: kit rack\nSlot 5: rack\n\nKIT RACK\n  A1 master mix\n  A2 water",
        "Kit rack, slot 4\nOther rack, slot 5\n\nkit racks\n  A1 master mix\n  A2 water",
        "Kit rack with ice: slot 4\n\nFirst we spin.\n\nKit rack: A1 master mix, A2 water",
    ],
)
def test_a_description_names_the_labware_for_later_headings(database: Database, said: str) -> None:
    assert roles(database, said) == {f"{KIT}:A1": "master_mix", f"{KIT}:A2": "water"}


@pytest.mark.parametrize(
    "said",
    [
        "Yeast DNA rack (slot 5)",
        "Slot 5: tube rack, yeast DNA",
        "Yeast DNA: slot 5",
        "3. Yeast DNA, slot 5",
        "Steckplatz 5: Hefe-DNA",
    ],
)
def test_a_description_gives_all_wells_in_use_a_role(database: Database, said: str) -> None:
    assert roles(database, said) == DNA


def test_a_heading_with_a_slot_and_a_row_says_what_the_wells_after_it_hold(
    database: Database,
) -> None:
    assert roles(database, "Yeast DNA (slot 5, row A of the rack): A1-A3") == DNA
    assert roles(database, "Yeast DNA (slot 5, row A of the rack): A1, A2") == {
        f"{TUBES}:A1": "template",
        f"{TUBES}:A2": "template",
    }


def test_what_is_said_of_a_well_counts_more(database: Database) -> None:
    said = "Slot 5: tube rack, yeast DNA\n\nslot 5: A3 water"
    assert roles(database, said) == {**DNA, f"{TUBES}:A3": "water"}


@pytest.mark.parametrize(
    "said",
    [
        "Both (slot 4 and slot 5) hold yeast DNA",
        "Yeast DNA (slot 8)",  # nothing is there
        "Yeast DNA (slot 1)",  # tips
    ],
)
def test_other_descriptions_say_nothing(database: Database, said: str) -> None:
    assert roles(database, said) == {}


@pytest.mark.parametrize(
    ("said", "expected"),
    [
        ("The trough on slot 6 holds the master mix.", {f"{TROUGH}:A2": "master_mix"}),
        (
            "The run is done with one pipette, and the trough that stands on\n"
            "slot 6 holds the master mix.",
            {f"{TROUGH}:A2": "master_mix"},
        ),
        # There are three tubes in use.
        ("The rack on slot 4 holds the master mix.", {}),
        # Which of the two has it?
        ("The trough on slot 6 and the rack on slot 4 hold the master mix.", {}),
    ],
)
def test_a_sentence_says_what_the_one_well_in_use_holds(
    database: Database, said: str, expected: dict[str, str]
) -> None:
    assert roles(database, said) == expected


@pytest.mark.parametrize(
    ("said", "expected"),
    [
        ("The rack in slot 4 has the kit.\nWater is in A2.", {f"{KIT}:A2": "water"}),
        (
            "The rack in slot 4 has what we bought of the company, and\n"
            "it is kept cold. Water is in A2.",
            {f"{KIT}:A2": "water"},
        ),
        ("The rack in slot 4 has the kit.\nIn both plates A2 is the NTC.", {f"{PLATE}:A2": "ntc"}),
        ("The rack in slot 4 has the kit.\n\nA2 is the NTC.", {f"{PLATE}:A2": "ntc"}),
        (
            "Rack in slot 4 (three tubes, glass, cold):\n  A1 master mix\n  A2 water",
            {f"{KIT}:A1": "master_mix", f"{KIT}:A2": "water"},
        ),
        (
            "Rack in slot 4 (three tubes, glass, cold, on the left side)\n  A1 master mix",
            {f"{KIT}:A1": "master_mix"},
        ),
    ],
)
def test_a_sentence_without_labware_speaks_of_that_of_the_sentence_before(
    database: Database, said: str, expected: dict[str, str]
) -> None:
    assert roles(database, said) == expected


def test_a_variable_of_one_letter_is_not_named_by_a_well(database: Database) -> None:
    said = "The rack in slot 5: D1 is empty, C1 too\n  A1 yeast DNA"
    assert roles(database, said) == {f"{TUBES}:A1": "template"}
    assert roles(database, "rack (slot 4)\n  A1: master mix\n  A2: water") == {
        f"{KIT}:A1": "master_mix",
        f"{KIT}:A2": "water",
    }


@pytest.mark.parametrize(
    ("said", "expected"),
    [
        ("On the plate A2 gets master mix and water only, it is the NTC.", {f"{PLATE}:A2": "ntc"}),
        ("plate, A2: left for the NTC and filled with water", {f"{PLATE}:A2": "ntc"}),
        # A tube is drawn from, perhaps for more than one thing.
        ("rack in slot 4: A2 water and NTC", {}),
    ],
)
def test_one_well_is_one_thing_whatever_it_is_made_of(
    database: Database, said: str, expected: dict[str, str]
) -> None:
    assert roles(database, said) == expected


def test_water_and_ntc_in_one_tube_accuse_no_well(database: Database) -> None:
    said = "Rack in slot 4\n  A1 master mix\n  A2 water and NTC\nRack in slot 5\n  A2 yeast DNA"
    assert check(database, said).findings == ()


@pytest.mark.parametrize(
    "blank",
    [
        "negative extraction control",
        "extraction blank",
        "filtration blank",
        "field blank",
        "Extraktionsleerwert",
        "blanc d'extraction",
    ],
)
def test_a_blank_of_an_earlier_step_is_no_ntc(database: Database, blank: str) -> None:
    said = f"Plate: A1 {blank}, A3 NTC\n\nSlot 5: A1, A3 yeast DNA"
    told = roles(database, said)
    assert f"{PLATE}:A1" not in told
    assert told[f"{PLATE}:A3"] == "ntc"
    wells = {
        well.name
        for finding in check(database, said).findings
        if finding.rule == "PCR-4"
        for well in finding.wells
        if well.slot == PLATE
    }
    assert wells == {"A3"}
