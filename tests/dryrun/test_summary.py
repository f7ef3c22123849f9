"""What a person is told of a dry run's liquids that were not seen to leave a tip."""

from __future__ import annotations

from typing import Any

import pytest

from aegis_ot.dryrun.summary import unproven


def well(outcome: str, strength: float | None = None) -> dict[str, Any]:
    stream = ["right p300_single", 300.0, "water"]
    return {
        "evidence": {"calibration": {"stream": stream, "strength": strength}},
        "verdict": {"outcome": outcome, "route": "calibration"},
    }


@pytest.mark.parametrize(
    ("trusted", "said"), [(False, "stay undecided"), (True, "were taken for right")]
)
def test_who_trusts_the_first_wells_is_not_told_to(trusted, said) -> None:
    overview: Any = {"trajectories": [well("pass"), well("undecided")]}
    (note,) = unproven(overview, trusted)
    assert said in note
    assert ("--first-wells trust" in note) is not trusted


def test_a_liquid_that_was_seen_to_leave_is_not_named() -> None:
    overview: Any = {"trajectories": [well("pass"), well("pass", 5.0)]}
    assert list(unproven(overview, False)) == []
