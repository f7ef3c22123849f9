"""The table in the documentation, row by row, against Opentrons' simulator."""

from __future__ import annotations

import pytest

from .calls import CASES, aspirate_and_dispense, transfer_with_extras
from .recorded import record
from .table import rows

TABLE = rows()


def test_every_call_has_a_row_and_every_row_a_call() -> None:
    assert set(TABLE) == set(CASES)


@pytest.mark.parametrize("name", sorted(CASES))
def test_row(name: str) -> None:
    function, api, robot, settings = CASES[name]
    assert " ".join(record(function, api, robot, **settings).words) == TABLE[name]


@pytest.mark.parametrize("api", ["2.0", "2.10", "2.13", "2.14", "2.22"])
def test_other_api_levels_yield_the_same_steps(api: str) -> None:
    steps = [word for word in TABLE["aspirate and dispense"].split() if ":" not in word]
    assert record(aspirate_and_dispense, api).line.split() == steps


@pytest.mark.parametrize("api", ["2.8", "2.10", "2.24"])
def test_extras_at_other_api_levels(api: str) -> None:
    steps = [word for word in TABLE["transfer with extras"].split() if ":" not in word]
    assert record(transfer_with_extras, api).line.split() == steps
