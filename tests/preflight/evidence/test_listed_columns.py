"""Lists with one entry for each column or row of a plate, and which plate they speak of."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import Database, Script, check_script, load_database

PROTOCOL = '''
"""Staurosporine on cells. U = untreated, V = vehicle, S = staurosporine"""
metadata = {"apiLevel": "2.13"}
LIST


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3, "cells")
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    for number, code in enumerate(CODES):
        if code != "U":
            well = plate.AXIS()[number][0]
            p20.transfer(5, rack["A1"] if code == "V" else rack["A2"], well)
'''


@pytest.fixture(scope="module")
def database() -> Database:
    return load_database()


def named(written: str, axis: str, database: Database) -> dict[str, str]:
    """The roles of wells in the plate that come from the list, by the name of the well."""
    text = PROTOCOL.replace("LIST", written).replace("AXIS", axis)
    report = check_script(Script(text, "p.py"), database)
    assert report.family == "cell_treatment"
    return {
        found.well.name: found.role
        for found in report.roles
        if found.family == report.family
        and found.well.slot == "3"
        and any("`CODES`" in said and "stands for" in said for said in found.evidence)
    }


@pytest.mark.parametrize(
    "written",
    [
        '# by column\nCODES = "U V V S S S S S S S S V".split()',
        'CODES = "U,V,V,S,S,S,S,S,S,S,S,V".split(",")  # one for each column',
        '# codes of the columns, left to right\nCODES = "UVVSSSSSSSSV"',
        'CODES = ["U", "V", "V", *"SSSSSSSS", "V"]',
        '# by column\nCODES = ["U", "V", "V", "S", "S", "S", "S", "S", "S", "S", "S", "V"]',
    ],
    ids=["words", "commas", "letters", "not written down", "list"],
)
def test_an_entry_for_each_column(written: str, database: Database) -> None:
    found = named(written, "columns", database)
    if "*" in written:
        assert not found
    else:
        controls = {well for well, role in found.items() if role == "vehicle_control"}
        assert controls == {"A2", "A3", "A12"}


def test_an_entry_for_each_row(database: Database) -> None:
    found = named('CODES = list("UVVSSSSS")  # rows', "rows", database)
    assert not found, "`list(...)` is not written down"
    found = named('CODES = "UVVSSSSS"  # rows', "rows", database)
    assert {well for well, role in found.items() if role == "vehicle_control"} == {"B1", "C1"}


@pytest.mark.parametrize(
    "written",
    [
        'CODES = "UVVSSSSSSSSV"',
        'CODES = "UVVSSSSSSSSV"  # rows and columns',
        'CODES = "UVVSSSSSSSSV"  # rows',
        'CODES = "UVVSSSSSSV"  # columns',
        'CODES = "SSSSSSSSSSSS"  # columns',
    ],
    ids=["neither", "both", "as many as columns", "too few", "all one"],
)
def test_a_list_of_something_else_is_not_read(written: str, database: Database) -> None:
    assert not named(written, "columns", database)
