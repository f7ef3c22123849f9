"""Lists whose lines leave "row" or "column" out, where something near says that they are so."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import load_database
from aegis_ot.preflight.layouts.bare_lists import with_rows

COMMON = load_database().common


@pytest.mark.parametrize(
    ("written", "rows"),
    [
        ("Map (row: lot)\nA  lot 4\nB  lot 7\nC  lot 9", ["row A", "row B", "row C"]),
        ("each row:  A  lot 4   B  lot 7   C  lot 9", ["row A", "row B", "row C"]),
        (
            "A  lot 4\nB  lot 7\nC  lot 9\n\nRows A-C get 5 uL of dye",
            ["row A", "row B", "row C"],
        ),
    ],
)
def test_rows_listed_by_letter_are_rows(written: str, rows: list[str]) -> None:
    said = " ".join(with_rows(written, COMMON).split())
    assert [row for row in rows if row in said] == rows


@pytest.mark.parametrize(
    "written",
    [
        "Map (row: lot)\nA  lot 4\nB  lot 7",  # two letters may be anything
        "Rows\nA  lot 4\nC  lot 7\nD  lot 9",  # no rows in turn
        "Partners\nA  lot 4\nB  lot 7\nC  lot 9",  # nothing says rows
        "Each row with its wells\nA  A1 lot 4\nB  B1 lot 7\nC  C1 lot 9",
        "Each row\n   1  2\nA  p  q\nB  p  q\nC  p  q",  # a drawn plate
        "Each row\n\nA  lot 4\nB  lot 7\nC  lot 9",  # another paragraph
        "A  lot 4\nB  lot 7\nC  lot 9\n\nRow A gets dye",  # the others may be tubes
    ],
)
def test_other_letters_are_left_alone(written: str) -> None:
    assert with_rows(written, COMMON) == written
