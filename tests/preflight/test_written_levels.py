"""Amounts that a text lists under the names of what holds them, as a kit's leaflet does."""

from __future__ import annotations

import pytest

from aegis_ot.preflight.text import read_source

KIT = {"A": 2000.0, "B": 500.0, "C": 25.0}


@pytest.mark.parametrize(
    "lines",
    [
        "Vial      A     B     C\nug/mL  2000   500    25",
        "Vial   A   B   C\nµg/ml  2000   500    25 (lowest)",
        "A | B | C\n2000 | 500 | 25 ug/ml",
        "ug/ml   2000   500   25\nvial   A   B   C",
        "Vial (kit)  :  A   B   C\nug/ml  2000   500   25",
    ],
)
def test_the_amount_under_or_above_each_name(lines: str) -> None:
    assert read_source(f'"""Kit.\n\n{lines}\n"""\n').levels == {"ug/ml": KIT}


def test_in_a_comment_and_with_decimal_commas() -> None:
    text = "# tube    S1    S2    S3   S4\n# mg/ml  0,1  0,25   0,5    1\n"
    assert read_source(text).levels == {"mg/ml": {"S1": 0.1, "S2": 0.25, "S3": 0.5, "S4": 1.0}}


def test_the_first_table_of_a_unit_holds() -> None:
    text = '"""\nVial A B C\nug/ml 3 2 1\n\nVial A B C\nug/ml 9 8 7\n"""\n'
    assert read_source(text).levels == {"ug/ml": {"A": 3.0, "B": 2.0, "C": 1.0}}


@pytest.mark.parametrize(
    "lines",
    [
        "Vial  A  B  C\n      3  2  1",
        "Vial  A  B  C\nug/ml  3  2",
        "Vial  A  B\nug/ml  3  2",
        "Vial  A  A  C\nug/ml  3  2  1",
        "Vial  1  2  3\nug/ml  3  2  1",
        "Vial  A  B  C\nug/ml or ng/ml  3  2  1",
        "Vial  A  B  C\n\nug/ml  3  2  1",
        "we dilute the BSA in four steps and\nug/ml  3  2  1",
    ],
    ids=["unit", "short", "two", "twice", "numbers", "units", "apart", "prose"],
)
def test_nothing_where_names_and_amounts_do_not_pair(lines: str) -> None:
    assert read_source(f'"""Kit.\n\n{lines}\n"""\n').levels == {}
