"""Comments of the run speak of what is done until the next one, or of nothing."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import Database, Options, Script, check_script, load_database

PROTOCOL = """
metadata = {{"protocolName": "PCR set-up", "apiLevel": "2.15"}}


def run(protocol):
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 4)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 1)
    p20 = protocol.load_instrument("p20_single_gen2", "left", [tips])
    {said}
    {first}
    {second}
"""


@pytest.fixture(scope="module")
def database() -> Database:
    return load_database()


def roles(database: Database, said: str, second: str = "") -> dict[str, str]:
    text = PROTOCOL.format(
        said=f"protocol.comment({said!r})",
        first='p20.transfer(5, rack["D1"], plate["H1"])',
        second=second,
    )
    report = check_script(Script(text, "p.py"), database, Options(assay=("pcr",)))
    return {
        f"{evidence.well.name}": evidence.role
        for evidence in report.roles
        if "of the run" in evidence.evidence[0]
    }


@pytest.mark.parametrize(
    ("said", "expected"),
    [
        ("water", {"D1": "water"}),
        ("NTC", {"D1": "ntc", "H1": "ntc"}),
        ("nuclease-free water -> NTC", {"D1": "water", "H1": "ntc"}),
        ("Adding water to the negative control", {"D1": "water", "H1": "ntc"}),
        ("H2O (NTC)", {"H1": "ntc"}),
        ("master mix done, next the samples", {}),
        ("do not forget the template", {}),
        ("master mix and water", {}),
        ("plate 2", {}),
    ],
)
def test_a_comment_names_what_is_drawn_and_where_it_goes(
    database: Database, said: str, expected: dict[str, str]
) -> None:
    assert roles(database, said) == expected


def test_a_comment_above_a_whole_section_names_nothing(database: Database) -> None:
    second = 'p20.transfer(5, rack["A1"], plate["A1"])'
    assert roles(database, "water", second) == {}


def test_a_comment_holds_until_the_next_comment_or_pause(database: Database) -> None:
    for end in ('protocol.comment("go on")', 'protocol.pause("go on")'):
        second = f'{end}\n    p20.transfer(5, rack["A1"], plate["A1"])'
        assert roles(database, "water", second) == {"D1": "water"}


def test_a_comment_at_the_end_of_a_turn_is_not_about_the_next_one(database: Database) -> None:
    second = """for what, tube, well in (("DNA", "A1", "A1"), ("water", "D2", "H2")):
        p20.transfer(5, rack[tube], plate[well])
        protocol.comment(what)"""
    assert roles(database, "go", second) == {}
