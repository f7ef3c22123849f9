"""A number in a name is a level only if it says how much."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import load_rules
from aegis_ot.preflight.source import level_in


@pytest.mark.parametrize(
    "text",
    ["Medium 2", "RD5-18", "24 h", "S10", "25-OH vitamin D", "660 nm reagent", "cells in medium"],
)
def test_what_only_counts_or_names_is_no_level(text: str) -> None:
    assert level_in(text, load_rules().common.levels) is None


@pytest.mark.parametrize(
    "text", ["BSA 125", "std_250", "10 nM", "dose_500nm", "0.5 mg/mL", "blank"]
)
def test_what_says_how_much_is_one(text: str) -> None:
    assert level_in(text, load_rules().common.levels) is not None
