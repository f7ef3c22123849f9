"""Tables and maps drawn in prose: what stands under a well is said of it, and nothing else is."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import Database, Report, Script, check_script, load_database

_PROTOCOL = '''"""{doc}
"""
metadata = {{"apiLevel": "2.13"}}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_20ul", 1)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 2)
    plate = ctx.load_labware("nest_96_wellplate_200ul_flat", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    for number in range(4):
        p20.transfer(5, rack.wells()[number], plate.rows()[0][number])
        p20.transfer(5, rack.wells()[number + 4], plate.rows()[1][number])
    p20.transfer(15, rack["D6"], plate.wells(), new_tip="once")
'''


@pytest.fixture(scope="module")
def database() -> Database:
    return load_database()


def _check(doc: str, database: Database) -> Report:
    return check_script(Script(_PROTOCOL.format(doc=doc), "p.py"), database)


def _said(report: Report, well: str) -> tuple[str, float | None]:
    """Role and level of a well of the plate."""
    return next(
        (found.role, found.level)
        for found in report.roles
        if found.family == report.family and found.well.slot == "3" and found.well.name == well
    )


def test_each_row_of_wells_has_its_own_amounts(database: Database) -> None:
    doc = """Bradford assay with BSA standards in the plate:

well   A1   A2   A3   A4
ug/ml  0    25   50   100
well   B1   B2   B3   B4
ug/ml  200  400  800  1600"""
    report = _check(doc, database)
    assert _said(report, "A4") == ("standard_well", 100)
    assert _said(report, "B4") == ("standard_well", 1600)


def test_words_count_only_where_they_stand_in_line(database: Database) -> None:
    drawn = """Bradford assay, the plate:
        A1        A2      A3      A4
        blank     sample  sample  sample"""
    told = """Bradford assay
and then blank, sample, sample, blank
go into A1 A2 A3 A4"""
    assert _said(_check(drawn, database), "A1")[0] == "blank_well"
    assert "table" not in str(_check(told, database).roles)
