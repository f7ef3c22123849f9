"""What the text of a protocol says of the values that its loops give to names."""

from __future__ import annotations

import pytest

from aegis_ot.preflight.text import origins, read_source


def columns(text: str) -> dict[str, tuple[object, ...] | None]:
    """The values of each name of the loops of a text."""
    return {values.name: values.column for loop in read_source(text).runs for values in loop.values}


@pytest.mark.parametrize(
    ("text", "name", "expected"),
    [
        ("for tube, conc in [('A1', 0), ('A2', 5)]: pass", "conc", (0, 5)),
        ("T = {'A1': 2, 'B1': 1}\nfor tube, ug in T.items(): pass", "ug", (2, 1)),
        ("T = [('A1', 0), ('A2', 5)]\nfor (t, c), n in zip(T, 'AB'): pass", "c", (0, 5)),
        ("for n, (t, c) in enumerate([('A1', 3), ('A2', 4)]): pass", "c", (3, 4)),
        ("C = [1, 2, 3]\nfor c in reversed(C[1:]): pass", "c", (3, 2)),
        ("T = [{'tube': 'A1', 'ug': 7}]\nfor s in T: pass", "s ug", (7,)),
        ("C = {'a': 1, 'b': 2}\nfor key in ('b', 'a'): pass", "C", (2, 1)),
        ("for t, c in rows: pass", "c", None),
    ],
)
def test_loops_over_literals_tell_what_each_name_holds(text, name, expected) -> None:
    assert columns(text)[name] == expected


def test_a_sort_by_a_key_is_not_guessed() -> None:
    assert columns("for c in sorted([3, 1], key=order): pass") == {}


def test_a_name_comes_from_the_loop_around_its_line_only() -> None:
    facts = read_source(
        "for tube in STANDARDS:\n    use(tube)\nfor tube in SAMPLES:\n    use(tube)\n"
        "def use(spot):\n    return rack[spot]\n"
    )
    assert "STANDARDS" in origins(facts, ["spot"], (2,))
    assert "SAMPLES" not in origins(facts, ["spot"], (2,))
    assert "SAMPLES" in origins(facts, ["spot"], (4,))


def test_a_comprehension_gives_its_result_the_values() -> None:
    facts = read_source("T = [('A1', 9), ('A2', 8)]\ntubes = [rack[t] for t, c in T]\n")
    (loop,) = [loop for loop in facts.runs if "tubes" in loop.names]
    assert {values.name: values.column for values in loop.values}["c"] == (9, 8)


HELPER = """
def fill(tube, spots):
    for spot in spots:
        use(rack[tube], plate[spot])
for row in FIRST:
    fill(row["vial"], row["wells"])
for row in SECOND:
    other(row)
"""


def test_a_parameter_comes_from_the_loop_around_the_call() -> None:
    facts = read_source(HELPER)
    assert "FIRST" in origins(facts, ["tube"], (4,))
    assert "FIRST" in origins(facts, ["spot"], (4,))
    assert "SECOND" not in origins(facts, ["tube"], (4,))


def test_the_keys_that_give_a_parameter_its_value() -> None:
    asked = read_source(HELPER).asked
    assert {key for key, _, _ in asked["tube"]} == {"vial"}
    assert {key for key, _, _ in asked["spots"]} == {"wells"}


def test_a_parameter_given_by_name_comes_from_what_is_given() -> None:
    facts = read_source(HELPER.replace('row["vial"], row', 'tube=row["vial"], spots=row'))
    assert "FIRST" in origins(facts, ["tube"], (4,))


def test_names_assigned_together_come_each_from_their_own() -> None:
    facts = read_source("for row in ROWS:\n    tube, well = row['vial'], OTHER[row['at']]\n")
    assert "OTHER" not in origins(facts, ["tube"], (2,))
    assert {key for key, _, _ in facts.asked["tube"]} == {"vial"}


def test_lines_may_be_all_that_there_can_be() -> None:
    facts = read_source("wells = [plate[r] for r in ROWS]\nother = name")
    assert origins(facts, ["r"], range(1 << 60)) == {"r", "ROWS"}
    assert origins(facts, ["other"], range(1 << 60)) == {"other", "name"}
