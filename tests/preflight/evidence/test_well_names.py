"""Places as people write them, read as wells of a 96-well plate."""

from __future__ import annotations

import pytest

from aegis_ot.instrumentation import LabwareInfo
from aegis_ot.preflight.evidence.well_names import wells_in

PLATE = LabwareInfo(
    key="1",
    load_name="plate",
    display_name="Plate",
    label="",
    slot="1",
    is_tip_rack=False,
    is_trash=False,
    wells=dict.fromkeys(f"{row}{column}" for column in range(1, 13) for row in "ABCDEFGH"),  # type: ignore[arg-type]
)


@pytest.mark.parametrize(
    ("text", "wells"),
    [
        ("A1", ["A1"]),
        ("A12", ["A12"]),
        ("A01", ["A1"]),
        ("H10, H12", ["H10", "H12"]),
        ("G11-H12", ["G11", "H11", "G12", "H12"]),
        ("A9 to A11", ["A9", "A10", "A11"]),
        ("column 12", [f"{row}12" for row in "ABCDEFGH"]),
        ("rows G-H", [f"{row}{column}" for column in range(1, 13) for row in "GH"]),
        ("A13", []),
        ("A120", []),
    ],
)
def test_places_stand_for_wells(text: str, wells: list[str]) -> None:
    assert wells_in(text, PLATE) == wells


@pytest.mark.parametrize("text", ["", "*"])
def test_nothing_and_a_star_stand_for_all(text: str) -> None:
    assert len(wells_in(text, PLATE)) == 96
