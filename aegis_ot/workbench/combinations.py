"""Which values of runtime parameters to try, and in which combinations."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

from ..adapters.opentrons.rehearsal import Parameter

ALL_UP_TO = 32
"""Up to so many combinations all are tried; above, every pair of values occurs once at least."""

VALUES_AT_MOST = 16
"""Values tried per parameter: declared choices beyond this are thinned out evenly."""


def values_of(parameter: Parameter) -> tuple[Any, ...]:
    """The values to try, the default first; one value alone where nothing is declared.

    Choices are taken as they are; of bounds, both ends and what lies midway.
    """
    if parameter.kind == "bool":
        values = [parameter.default, not parameter.default]
    elif parameter.choices:
        values = [parameter.default, *_thinned(parameter.choices, VALUES_AT_MOST - 1)]
    elif parameter.low is not None and parameter.high is not None:
        low, high = parameter.low, parameter.high
        whole = parameter.kind == "int"
        middle = int((low + high) // 2) if whole else (low + high) / 2
        values = [parameter.default, low, high, middle]
        values = [int(v) if whole else float(v) for v in values]
    else:
        values = [parameter.default]
    return tuple(dict.fromkeys(values))


def _thinned(values: Sequence[Any], at_most: int) -> list[Any]:
    if len(values) <= at_most:
        return list(values)
    step = (len(values) - 1) / (at_most - 1)
    return [values[round(n * step)] for n in range(at_most)]


def count_all(parameters: Mapping[str, Sequence[Any]]) -> int:
    """How many combinations there are."""
    count = 1
    for values in parameters.values():
        count *= len(values)
    return count


def combinations(
    parameters: Mapping[str, Sequence[Any]], limit: int = ALL_UP_TO
) -> list[dict[str, Any]]:
    """Combinations to try, all defaults first.

    Args:
        parameters: Values by variable name, the default first.
        limit: Up to so many all are taken; above, a set in which every pair of values of two
            parameters occurs (greedy, after AETG: Cohen et al., IEEE Trans. Softw. Eng. 23,
            437, 1997).
    """
    names = list(parameters)
    if count_all(parameters) <= limit:
        return [
            dict(zip(names, row, strict=False)) for row in itertools.product(*parameters.values())
        ]
    return [dict(zip(names, row, strict=False)) for row in _pairwise(list(parameters.values()))]


def _pairwise(columns: list[Sequence[Any]]) -> list[tuple[Any, ...]]:
    """Rows of values; indices stand for values, since ``1 == True``."""
    wanted = {
        (a, i, b, j)
        for a, b in itertools.combinations(range(len(columns)), 2)
        for i in range(len(columns[a]))
        for j in range(len(columns[b]))
    }
    if len(columns) == 1:
        return [(value,) for value in columns[0]]
    rows = [[0] * len(columns)]
    wanted -= _pairs(rows[0])
    while wanted:
        row: list[int | None] = [None] * len(columns)
        a, i, b, j = min(wanted)
        row[a], row[b] = i, j
        for column in range(len(columns)):
            if row[column] is None:
                row[column] = max(
                    range(len(columns[column])),
                    key=lambda value: (_gain(row, column, value, wanted), -value),
                )
        filled = [value or 0 for value in row]
        rows.append(filled)
        wanted -= _pairs(filled)
    return [tuple(columns[n][value] for n, value in enumerate(row)) for row in rows]


Pair = tuple[int, int, int, int]


def _pairs(row: Sequence[int]) -> set[Pair]:
    return {(a, row[a], b, row[b]) for a, b in itertools.combinations(range(len(row)), 2)}


def _gain(row: Sequence[int | None], column: int, value: int, wanted: set[Pair]) -> int:
    gain = 0
    for other, taken in enumerate(row):
        if taken is not None and other != column:
            low, high = sorted(((other, taken), (column, value)))
            gain += (*low, *high) in wanted
    return gain
