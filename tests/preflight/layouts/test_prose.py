"""Sentences over several lines are put together; lists, tables and definitions are not."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aegis_ot.preflight import load_database
from aegis_ot.preflight.layouts.prose import in_sentences, statements

COMMON = load_database().common


def test_each_sentence_of_running_text_is_a_line_with_the_number_that_it_begins_in() -> None:
    lines = [
        "    The stain stands in the trough and goes to every well of",
        "    columns 1 and 2. Everything else on the plate stays as it",
        "    is. It is not even read.",
    ]
    assert list(in_sentences(lines, COMMON)) == [
        (0, ["    The stain stands in the trough and goes to every well of columns 1 and 2."]),
        (1, ["    Everything else on the plate stays as it is."]),
        (2, ["    It is not even read."]),
    ]


def test_the_first_line_of_a_docstring_may_stand_further_left() -> None:
    lines = [
        "Six lysates stand in the first row of the rack, each of",
        "    them in one tube, and the buffer in the second one.",
    ]
    assert [block for _, block in in_sentences(lines, COMMON)] == [
        [f"{lines[0]} {lines[1].strip()}"]
    ]


def test_abbreviations_end_no_sentence() -> None:
    lines = [
        "Buffer comes first and is given to all of the wells with a",
        "tip of its own (see Lowry et al. 1951), i.e. ca. 10 times, vol. 5 uL.",
    ]
    assert [block for _, block in in_sentences(lines, COMMON)] == [[" ".join(lines)]]


@pytest.mark.parametrize(
    "written",
    [
        # entries apart
        "columns 1-3  lysates from the three donors, in duplicate\n"
        "columns 4-6  the same lysates after the heat treatment, in\n"
        "column 7     blank",
        # points of a list
        "- the lysates of all three donors stand in the row A of the\n"
        "- the dye is in the trough that stands beside the plate and",
        "1. Dilute the plasma samples tenfold with the buffer of the\n"
        "2. Add the substrate to all of the wells with the dispenser",
        # definitions
        "Rack: the lysates of all of the donors, in the first row of\n"
        "Trough: the dye of the kit, which has the temperature of the\n"
        "Plate: lysates in rows A and B.",
        "lysates = what is left after spinning, in the first row of\ndye = Coomassie from the kit.",
        # table and drawing
        "| lysates of the donors, in the first row of it | the rack |\n"
        "| dye of the kit in the trough beside the plate | a trough |",
        # lines that end where their writer meant them to
        "The plate holds lysates.\nThe rack holds buffers.",
        "lysates in rows A and B of\nthe rack, and the dye in one trough",
        "Both of these lines stand alone and are complete sentences.\n"
        "This one begins anew and ends where the first one did so too.",
        # steps of indents
        "The run takes all lysates from the rack that stands in the\n"
        "            second slot, and gives them\n"
        "    to the plate",
    ],
)
def test_other_lines_stay_as_they_are(written: str) -> None:
    lines = written.splitlines()
    assert list(in_sentences(lines, COMMON)) == [(0, lines)]


def test_paragraphs_stand_alone() -> None:
    prose = [
        "Lysates are diluted with buffer before the dye is added to",
        "them with fresh tips.",
    ]
    table = ["row A   lysates", "row B   blank"]
    assert list(in_sentences([*prose, "", *table], COMMON)) == [
        (0, [" ".join(prose)]),
        (2, [""]),
        (3, table),
    ]


WORDS = st.sampled_from(
    [
        "the",
        "Row",
        "A1",
        "lysates,",
        "of",
        "done.",
        "(kit",
        "4)",
        "e.g.",
        "A2:",
        "mix",
        "- ",
        "a  b",
    ]
)


@given(st.lists(st.lists(WORDS, max_size=14).map(" ".join), max_size=8))
def test_no_word_is_lost_and_no_number_goes_back(lines: list[str]) -> None:
    blocks = list(in_sentences(lines, COMMON))
    assert " ".join(" ".join(line for _, block in blocks for line in block).split()) == " ".join(
        " ".join(lines).split()
    )
    numbers = [number for number, _ in blocks]
    assert numbers == sorted(numbers)
    assert all(0 <= number < len(lines) for number in numbers)


@given(st.lists(st.tuples(st.sampled_from("-*•"), st.text("abc A12.,", max_size=70)), max_size=8))
def test_a_list_keeps_its_lines(items: list[tuple[str, str]]) -> None:
    lines = [f"{mark} {said}" for mark, said in items]
    assert [line for _, block in in_sentences(lines, COMMON) for line in block] == lines


@pytest.mark.parametrize(
    ("said", "parts"),
    [
        (
            "The NTC stands in the middle of the samples: column 1 holds A and B",
            ["The NTC stands in the middle of the samples", "column 1 holds A and B"],
        ),
        ("Cell plate (slot 1, 360 uL): column 1 holds the vehicle", None),
        ("The standards are in duplicate in these two columns: 1 and 2", None),
    ],
)
def test_a_colon_ends_a_sentence_but_no_heading(said: str, parts: list[str] | None) -> None:
    assert list(statements(said, COMMON)) == (parts or [said])
