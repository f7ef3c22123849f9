"""What a loop's iterable yields, as far as a text tells it."""

from __future__ import annotations

import ast

import pytest

from aegis_ot.preflight.text.sequences import counted, sequence_of

CONSTANTS = {"DOSES": [3, 1, 2], "TUBES": {"A1": 5, "A2": 0}, "COUNT": 8, "ROWS": ("A", "B")}


def parsed(text: str) -> ast.expr:
    return ast.parse(text, mode="eval").body


@pytest.mark.parametrize(
    ("text", "items"),
    [
        ("DOSES", [3, 1, 2]),
        ("[4, 5]", [4, 5]),
        ("'AB'", ["A", "B"]),
        ("TUBES", ["A1", "A2"]),
        ("TUBES.items()", [("A1", 5), ("A2", 0)]),
        ("{'B1': 7}.values()", [7]),
        ("DOSES[1:]", [1, 2]),
        ("DOSES[::-1]", [2, 1, 3]),
        ("sorted(DOSES)", [1, 2, 3]),
        ("list(reversed(DOSES))", [2, 1, 3]),
        ("COUNT", None),
        ("rows", None),
        ("DOSES[:n]", None),
        ("sorted(DOSES, key=order)", None),
        ("sorted([1, 'a'])", None),
        ("TUBES.get('A1')", None),
        ("shuffled(DOSES)", None),
    ],
)
def test_the_items_in_their_order(text: str, items: list[object] | None) -> None:
    assert sequence_of(parsed(text), CONSTANTS) == items


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("range(len(DOSES))", "DOSES"),
        ("range(len(ROWS))", "ROWS"),
        ("range(1, len(DOSES))", ""),
        ("range(len(DOSES) - 1)", ""),
        ("range(len(DOSES), 0, -1)", ""),
        ("range(len(TUBES))", ""),
        ("range(len(rows))", ""),
        ("range(3)", ""),
        ("len(DOSES)", ""),
    ],
)
def test_the_list_whose_items_are_counted(text: str, name: str) -> None:
    assert counted(parsed(text), CONSTANTS) == name
