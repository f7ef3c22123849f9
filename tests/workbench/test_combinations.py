from __future__ import annotations

import itertools

from hypothesis import given
from hypothesis import strategies as st

from aegis_ot.adapters.opentrons.rehearsal import Parameter
from aegis_ot.workbench.combinations import VALUES_AT_MOST, combinations, values_of


def test_values_of_each_kind() -> None:
    assert values_of(Parameter("b", "bool", True)) == (True, False)
    assert values_of(Parameter("i", "int", 4, low=1, high=8)) == (4, 1, 8)
    assert values_of(Parameter("f", "float", 5.0, low=1, high=10)) == (5.0, 1.0, 10.0, 5.5)
    assert values_of(Parameter("s", "str", "x", choices=("w", "x"))) == ("x", "w")
    assert values_of(Parameter("free", "int", 3)) == (3,)


def test_many_choices_are_thinned_and_keep_their_ends() -> None:
    values = values_of(Parameter("n", "int", 7, choices=tuple(range(1, 97))))
    assert len(values) <= VALUES_AT_MOST
    assert values[0] == 7
    assert {1, 96} <= set(values)


def test_few_combinations_are_all_tried_defaults_first() -> None:
    found = combinations({"a": (1, 2), "b": (True, False)})
    assert found[0] == {"a": 1, "b": True}
    assert len(found) == 4


@given(st.lists(st.integers(2, 5), min_size=2, max_size=5))
def test_above_the_limit_every_pair_occurs(sizes: list[int]) -> None:
    parameters = {f"p{n}": tuple(range(size)) for n, size in enumerate(sizes)}
    found = combinations(parameters, limit=0)
    assert found[0] == dict.fromkeys(parameters, 0)
    for one, other in itertools.combinations(parameters, 2):
        pairs = {(row[one], row[other]) for row in found}
        assert len(pairs) == len(parameters[one]) * len(parameters[other])
    assert len(found) <= len(list(itertools.product(*parameters.values())))
