"""Which numbers of a name or a text are doses, and which only count or name something."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import load_database
from aegis_ot.preflight.text import concentration_in, level_in

COMMON = load_database().common


@pytest.mark.parametrize(
    ("text", "level"),
    [
        ("std_125", 125.0),
        ("0.5 mg/mL", 0.5),
        ("calibrator 2 ug/ml", 0.002),
        ("blank", 0.0),
        ("std_3", None),
        ("CPD-007", None),
        ("library lot 042", None),
    ],
)
def test_the_level_that_a_name_states(text: str, level: float | None) -> None:
    assert level_in(text, COMMON) == (None if level is None else pytest.approx(level))


@pytest.mark.parametrize(
    ("text", "molar"),
    [
        ("ochra 0.3 uM", 0.3e-6),
        ("ochra 20 nM, 30", 20e-9),
        ("drug 10x", None),
        ("0.1 % DMSO", None),
        ("1 uM or 3 uM", None),
        ("column 3", None),
    ],
)
def test_only_a_concentration_is_one(text: str, molar: float | None) -> None:
    assert concentration_in(text) == (None if molar is None else pytest.approx(molar))
