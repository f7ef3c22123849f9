"""Plates that are drawn in a text: column numbers above, letters of rows at the left."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import load_database
from aegis_ot.preflight.layouts.drawn_grids import drawn_grid
from aegis_ot.preflight.layouts.well_names import well_names

NAMES = well_names(load_database().common)


@pytest.mark.parametrize("corner", ["", "row", "Row", "row/column", "#"])
def test_what_stands_above_the_letters_is_no_column(corner: str) -> None:
    lines = [f"{corner:<14}1   2   3", f"{'A':<14}V   D   D", f"{'B':<14}V   D   M"]
    found = drawn_grid(lines, 0, NAMES).wells_of
    assert found == {"V": ["A1", "B1"], "D": ["A2", "A3", "B2"], "M": ["B3"]}


def test_a_part_of_a_plate_with_a_word_in_its_corner() -> None:
    lines = ["row  4  5  6", "C    V  D  D", "D    V  D  M"]
    found = drawn_grid(lines, 0, NAMES).wells_of
    assert found == {"V": ["C4", "D4"], "D": ["C5", "C6", "D5"], "M": ["D6"]}


def test_a_sentence_with_numbers_is_no_drawing() -> None:
    lines = ["samples 1 2 3 of today", "A    V  D  D", "B    V  D  M"]
    assert drawn_grid(lines, 0, NAMES).wells_of == {}
