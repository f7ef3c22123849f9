"""Levels that lists in comments tell without a unit for each entry."""

from __future__ import annotations

import pytest

from aegis_ot.preflight.evidence import Clue, Strength
from aegis_ot.preflight.evidence.bare_numbers import with_bare_numbers
from aegis_ot.vocabulary import WellRef


def clues(*texts: str) -> list[Clue]:
    wells = [WellRef("rack", f"A{n}", "rack", "1") for n in range(1, len(texts) + 1)]
    return [
        Clue(Strength.COMMENT, text, (well,), 1, f"'{text}' at line 1", subject=False)
        for text, well in zip(texts, wells, strict=True)
    ]


def levels(texts: tuple[str, ...], whole: str) -> list[float | None]:
    told = [*with_bare_numbers(clues(*texts), whole)]
    return [clue.levels[0] if clue.levels else None for clue in told if clue.text]


@pytest.mark.parametrize(
    ("texts", "expected"),
    [
        ((" 0", " 125", " 2000 ug/ml"), [0.0, 0.125, 2.0]),
        (("BSA 0,25", "BSA 0,5", "BSA 1,0 mg/ml"), [0.25, 0.5, 1.0]),
        (("= 10", "= 1", "= 0.1 µM"), [1e-5, 1e-6, 1e-7]),
    ],
)
def test_one_unit_holds_for_a_list(texts: tuple[str, ...], expected: list[float]) -> None:
    assert levels(texts, " ".join(texts)) == pytest.approx(expected)


def test_a_bracket_says_what_a_level_is_made_of() -> None:
    told = [*with_bare_numbers(clues("0 (PBS)", "125", "2000 ug/ml"), "")]
    assert [(clue.text, clue.levels) for clue in told[:2]] == [("", (0.0,)), ("0 (PBS)", (0.0,))]


@pytest.mark.parametrize(
    "texts",
    [
        ("lot 4120", "lot 310", "lot 95"),
        ("standard 80", "standard 40", "standard 20"),
        ("10 mM", "10 ug/ml", "3 uM"),
        ("sample 1", "sample 2", "sample 3"),
        ("100", "200"),
    ],
)
def test_numbers_without_a_unit_are_no_levels(texts: tuple[str, ...]) -> None:
    assert levels(texts, " ".join(texts)) == [None] * len(texts)


def test_a_text_of_spaces_is_read_at_once() -> None:
    text = f"{' ' * 2000}9{' ' * 2000}q"
    assert levels((text, text, text), text) == [None] * 3
