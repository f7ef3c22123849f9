"""What all wells of a liquid show, or ever more so."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from aegis_ot.audit.measures import Measures
from aegis_ot.audit.patterns import drifts, no_liquid
from aegis_ot.audit.surprise import nats, standings
from aegis_ot.vision.delivery import Delivery, Shown


def measured(left: list[float]) -> list[Measures]:
    noise = np.random.default_rng(3).normal(0.0, 0.02, len(left))
    return [
        Measures({"retained": 0.0}, since={"left_40": value + off, "left_75": value / 2})
        for value, off in zip(left, noise, strict=True)
    ]


def test_a_slow_drift_is_found_and_told_from_where() -> None:
    (found,) = drifts(measured([0.0] * 4 + [0.05 * n for n in range(14)]))
    assert found.family == "after"
    assert found.places[-1] == 17
    assert 3 <= found.places[0] <= 8
    assert found.changes["left_40"] > 0.3


@pytest.mark.parametrize(
    "left",
    [
        [0.0] * 18,
        [0.001 * n for n in range(18)],  # sure, and too little to matter
        [0.4 - 0.02 * n for n in range(18)],  # less and less stays: nothing lost
        [0.0, 0.1, 0.2, 0.4, 0.5, 0.6, 0.7],  # too few to tell
    ],
)
def test_what_is_no_drift_is_not_called_one(left: list[float]) -> None:
    assert drifts(measured(left)) == []


@pytest.mark.parametrize(
    ("power", "meniscus", "shown", "expected"),
    [
        (1.0, False, Shown.NOTHING, True),
        (12.0, False, Shown.NOTHING, False),  # a dye shows, though its surface does not
        (1.0, True, Shown.NOTHING, False),  # clear, and its surface is seen
        (1.0, False, Shown.EMPTIED, False),  # it was seen to leave
    ],
)
def test_no_liquid_is_told_from_a_clear_one(
    power: float, meniscus: bool, shown: Shown, expected: bool
) -> None:
    wells: Any = [SimpleNamespace(delivery=Delivery(shown))] * 8
    seen = [Measures({}, power=power, meniscus=meniscus)] * 8
    assert no_liquid(wells, seen) is expected


def test_a_well_stands_by_the_spread_of_the_others_and_not_by_one_bad_one() -> None:
    shares = [0.0, 0.01, -0.01, 0.02, 0.0, 0.9]
    found = standings([Measures({"left_55": share}) for share in shares], [True] * 6)
    assert found[5].total > 5 * max(one.total for one in found[:5])
    assert found[5].strongest()["after"][0] == "left_55"
    assert standings([Measures({"left_55": 0.9})], [True])[0].total == 0.0
    assert nats(-3.0) == 0.0
    assert nats(2.0) < nats(4.0) < 2 * nats(4.0) + nats(9.0)


def test_where_most_wells_show_another_edge_none_ends_out_of_place() -> None:
    edges = [-0.04] * 5 + [0.04]
    found = standings([Measures({"low": edge, "high": -edge}) for edge in edges], [True] * 6)
    assert all(one.total == 0.0 for one in found)
    edges = [0.0] * 5 + [0.04]
    found = standings([Measures({"low": edge, "high": -edge}) for edge in edges], [True] * 6)
    assert found[5].strongest()["loaded"][0] == "low"
