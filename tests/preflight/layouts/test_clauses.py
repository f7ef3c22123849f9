"""Where one entry of a layout's line ends and the next begins, and which wells each speaks of."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import load_database
from aegis_ot.preflight.layouts.clauses import parts_of, with_what_follows

COMMON = load_database().common


@pytest.mark.parametrize(
    ("line", "entries"),
    [
        ("D1 mix       D6 water", [("mix", ["D1"]), ("water", ["D6"])]),
        ("vehicle     A3      drug     A4", [("vehicle", ["A3"]), ("drug", ["A4"])]),
        ("col 2  5 nM     tube A1", [("5 nM", ["col 2"]), ("tube", ["A1"])]),
        ("lot 4     C1", [("lot 4", ["C1"])]),
        ("row C   C1-C3 worm, C4-C6 NTC", [("worm", ["C1-C3"]), ("NTC", ["C4-C6"])]),
        ("tubes B1..B6, C1 gDNA", [("tubes , gDNA", ["B1..B6", "C1"])]),
        ("strips B1..B6 full, C1 gDNA", [("strips full", ["B1..B6"]), ("gDNA", ["C1"])]),
        (
            "ticks in columns 1-6. NTCs H3, H6",
            [("ticks in", ["columns 1-6"]), ("NTCs ,", ["H3", "H6"])],
        ),
        ("columns 1-6. NTC in H3", [("", ["columns 1-6"]), ("NTC in", ["H3"])]),
        (
            "binding buffer (res A1), ethanol (trough A3)",
            [("binding buffer (res )", ["A1"]), ("ethanol (trough )", ["A3"])],
        ),
        ("lysates (eluate in B2) A1", [("lysates", ["A1"]), ("eluate in", ["B2"])]),
        (
            "pools in the tubes A1, A2 and A3 of the rack",
            [("pools in the tubes , and of the rack", ["A1", "A2", "A3"])],
        ),
        (
            "column 7 with 2 nM and column 9 with 8 nM",
            [("with 2 nM", ["column 7"]), ("with 8 nM", ["column 9"])],
        ),
        (
            "Curve (slot 2, row B of the rack): B1 0, B2 5",
            [("Curve (slot 2, of the rack): 0", ["B1"]), ("5", ["B2"])],
        ),
        (
            "Lots (slot 2, row B of the rack): B1-B6",
            [("Lots (slot 2, of the rack):", ["B1-B6"])],
        ),
        ("plate (row A lots): B1 blank", [("plate : blank", ["B1"]), ("lots", ["row A"])]),
        ("A1, B1 and C1: standards", [(", and : standards", ["A1", "B1", "C1"])]),
    ],
)
def test_entries_of_a_line(line: str, entries: list[tuple[str, list[str]]]) -> None:
    parts = [part for part in parts_of(line, COMMON) if part.wells]
    found = [(" ".join(p.words.split()), [match.group() for match in p.wells]) for p in parts]
    assert found == entries


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("A1 PBS, the blank", "PBS (blank)"),
        ("stain into rows A-D, the controls too", "stain into"),
        ("Farbstoff in A1-D1, die Kontrollen auch", "Farbstoff in"),
        ("A1 PBS, the one that we keep in the cold room", "PBS"),
    ],
)
def test_a_thing_that_follows_says_what_that_is_unless_it_comes_to_it(line, words) -> None:
    parts, _ = with_what_follows(line, COMMON)
    assert [" ".join(part.words.split()).rstrip(" ,") for part in parts] == [words]
