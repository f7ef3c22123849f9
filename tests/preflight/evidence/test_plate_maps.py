"""Plate maps count for the labware that the run indexes with them, and for no other."""

from __future__ import annotations

from aegis_ot.preflight.evidence import Kind

from ..reading import evidence, read, roles_by_well


def test_a_map_speaks_of_the_labware_that_it_indexes() -> None:
    reading = read(
        """
        for well in LAYOUT:
            p20.transfer(2, tubes["A1"], plate[well])
        """,
        head='LAYOUT = {"A1": "sample", "H12": "NTC"}',
    )
    assert roles_by_well(reading)["1:H12"] == "ntc"
    assert "2:H12" not in roles_by_well(reading)


def test_a_map_of_sources_says_nothing_of_the_wells_it_is_zipped_with() -> None:
    reading = read(
        """
        for (tube, what), well in zip(SOURCES.items(), plate.wells()):
            p20.transfer(2, tubes[tube], well)
        """,
        head='SOURCES = {"A1": "template", "A2": "NTC"}',
    )
    assert roles_by_well(reading)["2:A2"] == "ntc"
    assert not [well for well in roles_by_well(reading) if well.startswith("1:")]


def test_rows_that_name_a_tube_and_a_well_speak_of_each_where_it_stands() -> None:
    reading = read(
        """
        for row in ROWS:
            p20.transfer(2, tubes[row["tube"]], plate[row["well"]])
        """,
        head="""
        ROWS = [
            {"tube": "A1", "well": "B1", "kind": "sample"},
            {"tube": "A2", "well": "B2", "kind": "NTC"},
        ]
        """,
    )
    wells = evidence(reading, Kind.NAME)["NTC"][1]
    assert wells == ["2:A2", "1:B2"]


def test_lists_of_well_names_are_called_by_their_name() -> None:
    reading = read(
        """
        for name in NTC_WELLS:
            p20.transfer(2, tubes["A1"], plate[name])
        """,
        head='NTC_WELLS = ["H11", "H12"]',
    )
    assert roles_by_well(reading) == {"1:H11": "ntc", "1:H12": "ntc"}


def test_a_map_that_the_run_hardly_uses_serves_another_run() -> None:
    reading = read(
        """
        p20.transfer(2, tubes["A1"], plate[LAYOUT["blank"][0]])
        """,
        head='LAYOUT = {"blank": ["A1", "A2", "A3", "A4"]}',
    )
    assert "LAYOUT['blank']" not in evidence(reading, Kind.NAME)
