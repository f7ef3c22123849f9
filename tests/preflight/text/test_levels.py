"""Which numbers of a name or a text are doses, and which only count or name something."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import load_database
from aegis_ot.preflight.text import concentration_in, direction_in, level_in, listed_levels
from aegis_ot.preflight.text.levels import unit_in

COMMON = load_database().common


@pytest.mark.parametrize(
    ("text", "level"),
    [
        ("std_125", 125.0),
        ("0.5 mg/mL", 0.5),
        ("calibrator 2 ug/ml", 0.002),
        ("staurosporine 3 uM (100x)", 3e-6),
        ("1 mM in 0.5 % DMSO", 1e-3),
        ("500 micrograms per mL", 0.5),
        ("2 Milligrams/mL BSA", 2.0),
        ("30 nanomolar", 30e-9),
        ("0.5 micrograms per microliter", 0.5),
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
        ("5 ng/L", 5e-9),
        ("0.1 % DMSO", None),
        ("1 uM or 3 uM", None),
        ("column 3", None),
    ],
)
def test_only_a_concentration_is_one(text: str, molar: float | None) -> None:
    assert concentration_in(text) == (None if molar is None else pytest.approx(molar))


@pytest.mark.parametrize(
    ("text", "molar"),
    [
        ("bafilomycin 9, 3, 1 nM", (9e-9, 3e-9, 1e-9)),
        ("30 nM, 300 nM and 3 uM", (30e-9, 300e-9, 3e-6)),
        ("10 µM / 3 µM", (10e-6, 3e-6)),
        ("1 uM, 24 h", ()),
        ("3, 4 and 5", ()),
        ("1 and 2 uM, then 5 and 6 uM", ()),
        ("0,3 uM", ()),
        ("0,1 / 0,3 uM", (0.1e-6, 0.3e-6)),
        ("0 / 0,2 / 0,5 / 1,0 mg/ml", (0, 0.2, 0.5, 1)),
        ("0; 0,25; 1,5 mg/ml BSA", (0, 0.25, 1.5)),
        ("100,50,25 ug/ml", (0.1, 0.05, 0.025)),
        ("BSA (mg/ml): 0, 0.1, 0.2", (0, 0.1, 0.2)),
        ("(µg/mL): 40 / 80 / 160", (0.04, 0.08, 0.16)),
        ("doses in nM: 30, 10, 3", (30e-9, 10e-9, 3e-9)),
        ("(mg/ml): 0.1, 0.2, 400 ug/ml", (1e-4, 2e-4, 0.4)),
        ("BSA (mg/ml): drug (nM): 1, 2, 3", ()),
        ("columns: 1, 2, 3", ()),
    ],
)
def test_the_levels_of_the_one_list_of_a_text(text: str, molar: tuple[float, ...]) -> None:
    assert listed_levels(text) == pytest.approx(molar)


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("ug/mL  2000  1500  1000", "ug/ml"),
        ("µg/ml: 3 2 1", "ug/ml"),
        ("micrograms/millilitre 3 2 1", "ug/ml"),
        ("3 2 1 (nM)", "nm"),
        ("mg/ml and ug/ml 1 2 3", ""),
        ("mg/ml/min 1 2 3", ""),
        ("number 1 2 3", ""),
    ],
)
def test_the_unit_that_stands_apart_from_numbers(text: str, unit: str) -> None:
    assert unit_in(text) == unit


@pytest.mark.parametrize(
    ("text", "direction"),
    [
        ("10 uM down to 0.1 uM", -1),
        ("10 -> 0.1 uM", 0),
        ("400 nM → 2 µM", 0),
        ("5 ng/ml up to 1 ug/ml", 1),
        ("drug, decreasing from left to right", -1),
        ("0.1-10 uM", 0),
        ("10-0.1 uM", 0),
        ("0.1 to 10 uM", 0),
        ("1 -> 3 uM, later 3 -> 1 uM", 0),
        ("volume 5 -> 20", 0),
    ],
)
def test_a_range_has_an_order_only_where_it_says_so(text: str, direction: int) -> None:
    assert direction_in(text, COMMON) == direction


@pytest.mark.parametrize(
    "unit", ["pg/L", "ng/L", "ug/L", "mg/L", "g/L", "pg/uL", "mg/uL", "pM", "M"]
)
def test_every_unit_that_is_found_has_a_size(unit: str) -> None:
    assert len(listed_levels(f"10, 5 and 1 {unit}")) == 3
    assert direction_in(f"10 {unit} down to 1 {unit}", COMMON) == -1
