"""What a line says to stand in which slot; prose and lines of several slots say no such thing."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import load_database
from aegis_ot.preflight.layouts.in_slots import in_slots

COMMON = load_database().common
OT2 = in_slots([str(number) for number in range(1, 12)], COMMON)
FLEX = in_slots(["A1", "B2", "C2", "D1", "D3"], COMMON)


@pytest.mark.parametrize(
    ("line", "slot", "what"),
    [
        ("3.1 Assay plate (slot 4, half-area)", "4", "Assay plate"),
        ("b) Toxin rack (slot 4)", "4", "Toxin rack"),
        ("1) Serum rack on slot 7", "7", "Serum rack"),
        ("Slot 8: tube rack, eluates", "8", "tube rack, eluates"),
        ("slot 5 - tube rack", "5", "tube rack"),
        ("Vials, slot 11", "11", "Vials"),
        ("Plate for the reader: slot 2", "2", "Plate for the reader"),
        ("* Mix tubes (deck slot 8)", "8", "Mix tubes"),
        ("- dye trough in slot 9:", "9", "dye trough"),
        ("Stain trough   slot 1", "1", "Stain trough"),
        ("Stain trough ....... slot 10", "10", "Stain trough"),
        ("Serum rack - slot 6, thawed", "6", "Serum rack"),
        ("Steckplatz 3: Probenplatte", "3", "Probenplatte"),
        ("Emplacement 2 - plaque de lecture", "2", "plaque de lecture"),
        ("Ranura 6: gradilla", "6", "gradilla"),
    ],
)
def test_the_slot_and_what_stands_there(line: str, slot: str, what: str) -> None:
    assert OT2.standing(line) == (slot, what)


@pytest.mark.parametrize(
    "line",
    [
        "The plate in slot 3 holds the cells of three donors.",
        "Rack (slot 1) and plate (slot 2)",
        "Plate that is read at the very end of this run, slot 2",  # a sentence calls nothing
        "Tube A1 (slot 2)",  # its well
        "Curve, slot 2 row A",
        "Curve (slot 2, row A of the rack): A1 blank",  # what some wells hold
        "lysozyme 1 mg/mL     rack in slot 4, D2     300 uL",  # a table
        "slot 12: plate",  # there is none
        "Slot 3",
        "plate, 3",
    ],
)
def test_other_lines_say_no_such_thing(line: str) -> None:
    assert OT2.standing(line) is None


def test_a_slot_without_labware_holds_nothing() -> None:
    assert in_slots(["1"], COMMON).standing("Slot 8: tube rack") is None


def test_slots_in_a_text() -> None:
    assert OT2.slots_in("from slot 4 to the deck slot 11, then 5") == {"4", "11"}
    assert FLEX.slots_in("slot d3, Slot C2 and B2") == {"D3", "C2"}
    assert OT2.begins("  * Slot 3: plate")
    assert not OT2.begins("plate in slot 3")


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("plate in D1:", "plate in slot D1:"),
        ("TUBES (C2)", "TUBES (slot C2)"),
        ("racks at B2, plates on D3", "racks at slot B2, plates on slot D3"),
        ("Reservoir ( D1 )", "Reservoir ( slot D1 )"),
    ],
)
def test_labware_in_what_looks_like_a_well_is_in_a_slot(written: str, meant: str) -> None:
    assert FLEX.with_slots(written) == meant


@pytest.mark.parametrize(
    "written",
    [
        "the tube in C2",  # a place of the rack
        "tube (C2): dye",
        "plate in H1",  # no slot of this deck
        "lysates in D1",
        "plate in slot D1",
        "plates 1 and 2 in order, D1 last",
    ],
)
def test_wells_are_left_alone(written: str) -> None:
    assert FLEX.with_slots(written) == written
    assert OT2.with_slots(written) == written


@pytest.mark.parametrize(
    ("line", "slot", "what"),
    [
        ("plate in D1:", "D1", "plate"),
        ("TUBES (C2)", "C2", "TUBES"),
        ("The reader's plate (B2): lysates", "B2", "The reader's plate"),
        ("slot d3: tube rack", "D3", "tube rack"),
    ],
)
def test_slots_of_a_flex(line: str, slot: str, what: str) -> None:
    assert FLEX.standing(FLEX.with_slots(line)) == (slot, what)


def test_a_long_remark_behind_a_comma_is_no_part_of_the_name() -> None:
    line = "Slot 4   extract plate, as delivered by the robot of the other laboratory"
    assert OT2.standing(line) == ("4", "extract plate")
