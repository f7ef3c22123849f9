"""Layouts of two labware that stand side by side in one text are read one after the other."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import load_database
from aegis_ot.preflight.layouts.side_by_side import side_by_side

COMMON = load_database().common


def blocks(text: str, line: int = 1) -> list[tuple[int, str]]:
    return list(side_by_side(line, text.strip("\n"), COMMON))


def test_the_right_one_follows_the_left_one_with_the_line_of_its_heading() -> None:
    text = """
Insulin on myotubes.

Tubes (slot 4)          Plate (slot 1)
A1   vehicle            column 2   vehicle control
A2   insulin 10 nM      column 3   low
A3   insulin 100 nM     column 4   high
"""
    left, right = blocks(text, line=5)
    assert left == (
        5,
        "Insulin on myotubes.\n\nTubes (slot 4)\n"
        "A1   vehicle\nA2   insulin 10 nM\nA3   insulin 100 nM",
    )
    assert right == (
        7,
        "Plate (slot 1)\ncolumn 2   vehicle control\ncolumn 3   low\ncolumn 4   high",
    )


def test_wells_without_words_hold_what_stands_at_their_left() -> None:
    text = """
Rack, slot 2            Plate, slot 3
--------------          -------------
A1   blank              A1 A2
A2   BSA 0.5 mg/mL      B1 B2
A3   BSA 1 mg/mL        C1 C2
"""
    _, (_, right) = blocks(text)
    heading, rule, *entries = right.splitlines()
    assert heading == "Plate, slot 3"
    assert rule.strip(), "a blank line would end what the heading speaks of"
    assert entries == ["A1 A2: blank", "B1 B2: BSA 0.5 mg/mL", "C1 C2: BSA 1 mg/mL"]


def test_one_column_may_be_shorter_and_an_entry_begin_a_little_beside_its_heading() -> None:
    text = """
Reservoir            Plate
A1  medium          row A  untreated
A2  ethanol          row B  ethanol
A3  retinoic acid
"""
    (_, left), (_, right) = blocks(text)
    assert left.splitlines()[1:] == ["A1  medium", "A2  ethanol", "A3  retinoic acid"]
    assert right.splitlines() == ["Plate", "row A  untreated", "row B  ethanol"]


def test_the_columns_end_with_a_blank_line_and_where_a_line_has_no_gap() -> None:
    head = "Tubes          Plate\nA1  DMSO       B1  vehicle\nA2  drug       B2  treated\n"
    for rest in ("\nAll volumes in uL.", "All volumes in uL; mix every well three times."):
        (_, left), (_, right) = blocks(head + rest)
        assert left.endswith(rest)
        assert right == "Plate\nB1  vehicle\nB2  treated"


@pytest.mark.parametrize(
    "text",
    [
        "Tubes          Plate\nA1  DMSO       B1  vehicle",
        "A1 tube        B1 plate\nA1  DMSO       B1  vehicle\nA2  drug       B2  treated",
        "Today          Tomorrow\nA1  DMSO       B1  vehicle\nA2  drug       B2  treated",
        "Tubes    Plate    Trough\nA1  a    B1  b    A1  c\nA2  a    B2  b    A2  c",
        "Tubes stand on the deck beside the plate.\nA1  DMSO\nA2  drug",
        "",
    ],
    ids=["one entry", "wells, no headings", "no labware", "three headings", "one", "nothing"],
)
def test_what_is_no_pair_of_layouts_stays_as_it_is(text: str) -> None:
    assert blocks(text) == [(1, text)]
