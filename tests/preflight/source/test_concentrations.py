"""Concentrations and doses in names."""

from __future__ import annotations

import pytest

from aegis_ot.preflight.source import comparable, level_in, name_without_level
from aegis_ot.preflight.source.concentrations import Concentration

WORDS = {"blank": 0.0, "high": 3.0}


@pytest.mark.parametrize(
    ("text", "level"),
    [
        ("std_125", 125.0),
        ("std_3", None),
        ("BSA 2 mg/ml", 2.0),
        ("drug 10 µM", 1e-5),
        ("drug_10uM", 1e-5),
        ("500 pg/mL", 5e-7),
        ("500 pg/L", 5e-10),
        ("2 IU/µL", 2e3),
        ("0p5_uM", 5e-7),
        ("blank", 0.0),
        ("1:10", 0.1),
        ("3 uM (100x)", 3e-6),
        ("10 uM or 20 uM", None),
    ],
)
def test_a_name_states_one_level(text: str, level: float | None) -> None:
    assert level_in(text, WORDS) == pytest.approx(level)


def test_plain_numbers_are_on_a_scale_of_their_own() -> None:
    assert not comparable(Concentration(1e-6), 3.0)
    assert comparable(Concentration(1e-6), 0.0)
    assert comparable(2.0, 3.0)


def test_doses_of_one_compound_have_one_name() -> None:
    one = name_without_level("cisplatin 10 uM stock", ("stock",))
    assert one == name_without_level("cisplatin 3 uM", ("stock",)) == ("cisplatin",)
