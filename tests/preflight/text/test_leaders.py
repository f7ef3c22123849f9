"""Dots that lead the eye from a place to what is there, and dots that stand for more."""

from __future__ import annotations

import pytest

from aegis_ot.preflight.text.leaders import without_leaders

LEADERS = "A9 ........ waste"


@pytest.mark.parametrize(
    "written",
    [
        "A3 ....... stop reagent, 10 mL",
        "Row A ... lot 1",
        "columns 4 to 6 ...... samples: 24 vials",
        "column 2 ..... 10 uM",
        "column 2 ... 1:5 dilutions",
    ],
)
def test_spaces_stand_where_dots_led(written: str) -> None:
    (spaced,) = without_leaders([written])
    assert spaced == written.replace(".", " ")
    assert len(spaced) == len(written)


@pytest.mark.parametrize(
    "written",
    [
        "A1 ... A6 samples",
        "columns 1 ..... 12 samples",
        "column 1 ... column 6",
        "row A = 0 ... row H = 100",
        "0, 125 ... 2000 ug/mL",
    ],
)
def test_dots_between_places_stay(written: str) -> None:
    assert without_leaders([written, LEADERS])[0] == written


def test_three_dots_behind_a_list_lead_only_beside_others() -> None:
    listed = "A1, A2 ... dilution buffer"
    assert without_leaders([listed]) == [listed]
    assert without_leaders([listed, LEADERS])[0] == "A1, A2     dilution buffer"


def test_a_long_line_of_dots_takes_no_time() -> None:
    written = "A1, " * 5000 + "." * 50000
    assert without_leaders([written]) == [written]
