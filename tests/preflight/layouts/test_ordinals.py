"""Columns, rows and troughs that a text counts are numbered; whatever else it counts is left."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aegis_ot.preflight import load_database
from aegis_ot.preflight.layouts.ordinals import with_numbers

COMMON = load_database().common


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("the fifth and sixth column get toxin", "columns 5 and 6 get toxin"),
        ("the 2nd, 3rd and 5th columns", "columns 2, 3 and 5"),
        ("from the third to sixth column", "from columns 3 to 6"),
        ("the twelfth column is blank", "column 12 is blank"),
        ("the fourth row, the seventh row", "row D, row G"),
        ("the second and the third row", "rows B and C"),
        ("first trough: stain", "trough 1: stain"),
        ("the second channel", "channel 2"),
        ("die vierte Spalte bleibt leer", "Spalte 4 bleibt leer"),
        ("die dritte und vierte Spalte", "columns 3 und 4"),
        ("die zweite Zeile", "Zeile B"),
        ("la segunda columna y la tercera columna", "columna 2 y columna 3"),
        ("la primera fila", "fila A"),
        ("la deuxième colonne", "colonne 2"),
    ],
)
def test_counted_columns_and_rows_have_numbers(written: str, meant: str) -> None:
    assert with_numbers(written, COMMON) == meant


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("the first two rows are blank", "rows A-B are blank"),
        ("the first seven columns", "columns 1-7"),
        ("die ersten drei Spalten", "columns 1-3"),
        ("the second two columns", "the second two columns"),  # 3 and 4, or 2 and 3
    ],
)
def test_the_first_few_are_a_range(written: str, meant: str) -> None:
    assert with_numbers(written, COMMON) == meant


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        (
            "the second column 30 nM, the third with 3 nM",
            "column 2 30 nM, column 3 with 3 nM",
        ),
        (
            "the second column 30 nM, the third 3 nM, the fourth 0.3 nM",
            "column 2 30 nM, column 3 3 nM, column 4 0.3 nM",
        ),
        (
            "the second column 2.5 uM, the third with 0.5 uM",
            "column 2 2.5 uM, column 3 with 0.5 uM",
        ),
        (
            "column 1 is dosed with toxin, the second gets saline",
            "column 1 is dosed with toxin, column 2 gets saline",
        ),
        ("row A with water, the second with dye", "row A with water, row B with dye"),
        # Another sentence may speak of something else.
        (
            "column 1 has dye. Read the second with care",
            "column 1 has dye. Read the second with care",
        ),
        ("column 1 has dye, the second reading", "column 1 has dye, the second reading"),
    ],
)
def test_those_that_go_on_in_a_sentence_are_counted_too(written: str, meant: str) -> None:
    assert with_numbers(written, COMMON) == meant


def test_a_sentence_still_begins_with_a_capital() -> None:
    said = "It is read. The third and the fourth column hold toxin. The first row is blank."
    meant = "It is read. Columns 3 and 4 hold toxin. Row A is blank."
    assert with_numbers(said, COMMON) == meant


@pytest.mark.parametrize(
    "written",
    [
        "the second plate",
        "a second reading after ten minutes",
        "the first well of the plate",  # of which row?
        "first column 2, then column 4",
        "second-column tips",
        "the first and last column",
        "the first step: rows A-C",
    ],
)
def test_other_things_that_are_counted_are_left_alone(written: str) -> None:
    assert with_numbers(written, COMMON) == written


@given(st.text("abcdehilnorstuw ABCH123,.;:\n-", max_size=200))
def test_a_text_without_such_words_is_left_alone(text: str) -> None:
    spoken = " ".join(word for word in text.lower().replace("-", " ").split())
    if not any(word in spoken for word in COMMON.ordinal_numbers):
        assert with_numbers(text, COMMON) == text


@given(st.lists(st.sampled_from(sorted(COMMON.ordinal_numbers)), max_size=30))
def test_words_without_a_column_are_left_alone(words: list[str]) -> None:
    written = " and ".join(words)
    assert with_numbers(written, COMMON) == written
