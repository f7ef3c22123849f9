"""Tables are told in plain lines: which slot, which wells in it, and what these hold."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import load_database
from aegis_ot.preflight.layouts.told_tables import told_tables

COMMON = load_database().common


def told(text: str, line: int = 1) -> list[tuple[int, str]]:
    return list(told_tables(line, text.strip("\n"), COMMON, {"9": "A1"}))


def test_cells_of_several_lines_under_the_slot_and_labware_of_their_row() -> None:
    text = """
Positions:
| slot | labware           | content                  |
|------|-------------------|--------------------------|
| 7    | rack, label "kit" | A1 enzyme 40 uL          |
|      |                   | A2 plasmid (positive     |
|      |                   |    control)              |
| 4    | plate "out"       | A1-A6 eluates, A7 water  |
|      |                   | (no template)            |
"""
    (line, rest), *blocks = told(text, line=10)
    assert (line, rest.splitlines()) == (10, ["Positions:", *["-"] * 7])
    assert blocks == [
        (12, 'slot 7: rack, label "kit"\nA1 = enzyme 40 uL\nA2 = plasmid (positive control)'),
        (15, 'slot 4: plate "out"\nA1-A6 = eluates, A7 water (no template)'),
    ]


def test_lines_under_a_slot_and_the_one_well_of_a_trough() -> None:
    text = """
+------+----------------+------------------+
| Slot | What           | Where            |
+------+----------------+------------------+
| 2    | vehicle        | column 1         |
|      | drug 5 uM      | columns 2, 3     |
| 9    | medium, 50 mL  | one-well trough  |
+------+----------------+------------------+
"""
    _, *blocks = told(text)
    assert blocks == [
        (3, "slot 2:\ncolumn 1 = vehicle\ncolumns 2, 3 = drug 5 uM"),
        (5, "slot 9:\nA1 = medium, 50 mL, one-well trough"),
    ]


def test_the_material_before_its_place_with_titles_alone() -> None:
    text = """
  MATERIAL             POSITION            AMOUNT
  culture plate        slot 2              100 uL
  DMSO (0.1 %)         rack slot 3, A1     1.4 mL
  nilotinib 1 uM       rack slot 3, B1     1.4 mL
"""
    _, *blocks = told(text)
    assert blocks == [
        (2, "rack slot 3:\nA1 = DMSO (0.1 %), 1.4 mL\nB1 = nilotinib 1 uM, 1.4 mL"),
    ]


def test_without_slots_the_lines_stay_under_what_stands_above_them() -> None:
    text = """
Rack in slot 5:
  Lot      Well   Conc (nM)   uL
  L-17     A1     10          4
  L-18     A2     20          2
"""
    assert told(text) == [(1, "Rack in slot 5:\n-\n  A1 = L-17, 10 nM\n  A2 = L-18, 20 nM")]


def test_columns_of_labware_hold_one_by_one_what_their_line_says() -> None:
    text = """
               tubes (slot 5)       plate (slot 6)
  blank        A1                   A1
  BSA          A2 0.25, A3 0.5,     B1, C1,
               A4 1 mg/mL           D1
  milk         B1 ... B5            A3 ... E3
"""
    _, (tubes_line, tubes), (plate_line, plate) = told(text)
    assert tubes_line == plate_line == 1
    assert tubes.splitlines() == [
        "tubes (slot 5):",
        "A1 = blank",
        "A2 = BSA 0.25 mg/mL; A3 = BSA 0.5 mg/mL; A4 = BSA 1 mg/mL",
        "-",
        "B1-B5 = milk",
    ]
    assert plate.splitlines() == [
        "plate (slot 6):",
        "A1 = blank",
        "B1 = BSA 0.25 mg/mL; C1 = BSA 0.5 mg/mL; D1 = BSA 1 mg/mL",
        "-",
        "A3-E3 = milk",
    ]


def test_tubes_whose_rows_meet_the_columns_of_the_line_above() -> None:
    text = """
Doses (tube = row of the cell plate, columns 3 and 4)
  tube A1   30   uM   row B
  tube A2   10   uM   row C
  tube B1   vehicle   columns 2 and 5 (controls)
"""
    (_, rest), (_, plate) = told(text)
    assert rest.splitlines()[1:] == [
        "  tube A1 = 30 uM",
        "  tube A2 = 10 uM",
        "  tube B1 = vehicle",
    ]
    assert plate.splitlines() == [
        "cell plate:",
        "B3-B4 = 30 uM",
        "C3-C4 = 10 uM",
        "columns 2 and 5 = vehicle (controls)",
    ]


@pytest.mark.parametrize(
    "text",
    [
        "| well | what |\n|------|------|\n| A1 | water |\n| A2 | mix |",
        "| from | what | to |\n|---|---|---|\n| A1 | mix | B1 |\n| A2 | water | B2 |",
        "slot 1   plate\n         rows A and B: blank\nslot 2   rack: A1 = dye, A2 = water",
        "row  E   drug\nrow  F   vehicle\nrow  G   untreated",
        "lot   wells (rack -> plate)\nL1    A1 -> B1\nL2    A2 -> B2",
        "     1    2    3\nA    V    V    d\nB    V    V    d",
        "tube A1   drug\ntube A2   vehicle",
        "",
    ],
    ids=["well first", "two places", "deck", "no titles", "arrows", "plate", "two cells", "none"],
)
def test_what_reads_well_or_is_not_plain_stays_as_it_is(text: str) -> None:
    assert told(text) == [(1, text)]
