"""Lines that go on in the next one are put together, with the number of the first."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import load_database
from aegis_ot.preflight.layouts.wrapped_lines import whole_lines

COMMON = load_database().common


def lines_of(written: str) -> list[tuple[int, str]]:
    return list(whole_lines(written.splitlines(), COMMON))


@pytest.mark.parametrize(
    ("written", "whole"),
    [
        ("lysates come from the rack in\n  slot 4", "lysates come from the rack in slot 4"),
        (
            "Curve: A1 0, A2 5,\n       A3 10, A4 20",
            "Curve: A1 0, A2 5, A3 10, A4 20",
        ),
        (
            "Barks: C1 elm,\n  C2 oak,\n  C3 ash",
            "Barks: C1 elm, C2 oak, C3 ash",
        ),
        (
            "columns 1-3: row A low,\n     row B high",
            "columns 1-3: row A low, row B high",
        ),
        ("columns 1-3 row A low,\n     row B high", "columns 1-3 row A low, row B high"),
    ],
)
def test_a_line_that_goes_on_is_one(written: str, whole: str) -> None:
    assert lines_of(written) == [(0, whole)]


@pytest.mark.parametrize(
    "written",
    [
        "Curve: A1 0, A2 5,\nand buffer",  # no well begins the next line
        "Curve: A1 0, A2 5\nA3 10",  # no comma
        "A1 0, A2 5,\nA3 10",  # no heading
        "Curve, kit: A1: 0, A2: 5,\nA3: 10",  # each entry has a colon of its own
        "Curve: buffer, A2 5,\nA3 10",  # the list begins with no well
        "columns 1-3 row A low,\nrow B high",  # not further right
    ],
)
def test_other_lines_stay_apart(written: str) -> None:
    assert lines_of(written) == list(enumerate(written.splitlines()))


def test_what_follows_a_list_has_its_own_number() -> None:
    written = "Barks: C1 elm,\n  C2 oak,\n  C3 ash\nWater: D1"
    assert lines_of(written) == [(0, "Barks: C1 elm, C2 oak, C3 ash"), (3, "Water: D1")]
