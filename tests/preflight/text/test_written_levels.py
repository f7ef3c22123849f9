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
    assert list(read_source(f'"""Kit.\n\n{lines}\n"""\n').levels.values()) == [KIT]


@pytest.mark.parametrize(
    "line",
    [
        "vials: A 2000, B 500, C 25 ug/ml",
        "A = 2000 ug/ml, B = 500 ug/ml, C = 25 ug/ml",
        "ug/ml: A 2000 | B 500 | C 25",
    ],
)
def test_the_amounts_of_a_list_in_one_line(line: str) -> None:
    assert list(read_source(f"# {line}\n").levels.values()) == [KIT]


def test_no_amount_in_brackets_says_nought() -> None:
    found = read_source("# A 2, B 1, C 0.5 mg/ml, D = diluent only (0)\n").levels
    assert list(found.values()) == [{"A": 2.0, "B": 1.0, "C": 0.5, "D": 0.0}]


def test_in_a_comment_and_with_decimal_commas() -> None:
    text = "# tube    S1    S2    S3   S4\n# mg/ml  0,1  0,25   0,5    1\n"
    assert read_source(text).levels == {
        "mg/ml at line 1": {"S1": 0.1, "S2": 0.25, "S3": 0.5, "S4": 1.0}
    }


def test_each_table_is_kept() -> None:
    text = '"""\nVial A B C\nug/ml 3 2 1\n\nVial A B C\nug/ml 9 8 7\n"""\n'
    tables = list(read_source(text).levels.values())
    assert tables == [{"A": 3.0, "B": 2.0, "C": 1.0}, {"A": 9.0, "B": 8.0, "C": 7.0}]


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
        "Vial  A  B  C\nread at 595 nm  3  2  1",
        "slots: A1 5, A2 6, A3 7 ug/ml",
    ],
    ids=["unit", "short", "two", "twice", "numbers", "units", "apart", "prose", "nm", "wells"],
)
def test_nothing_where_names_and_amounts_do_not_pair(lines: str) -> None:
    assert read_source(f'"""Kit.\n\n{lines}\n"""\n').levels == {}
