"""Well names as people write them."""

from __future__ import annotations

import pytest

from aegis_ot.preflight.evidence.well_names import wells_in

from ..reading import read

INFO = next(i for i in read("pass").trace.labware.values() if len(i.wells) == 96)


@pytest.mark.parametrize(
    ("text", "wells"),
    [
        ("A1", ["A1"]),
        ("A01", ["A1"]),
        ("A12", ["A12"]),
        ("H10, H12", ["H10", "H12"]),
        ("A120", []),
        ("A1-C1", ["A1", "B1", "C1"]),
        ("A1:B2", ["A1", "B1", "A2", "B2"]),
        ("A1, A3", ["A1", "A3"]),
        ("row H", [f"H{n}" for n in range(1, 13)]),
        ("rows A and C", [f"{r}{n}" for n in range(1, 13) for r in "AC"]),
        ("column 12", [f"{r}12" for r in "ABCDEFGH"]),
        ("columns 1-2", [f"{r}{n}" for n in (1, 2) for r in "ABCDEFGH"]),
        ("Z9", []),
    ],
)
def test_places_are_read(text: str, wells: list[str]) -> None:
    assert wells_in(text, INFO.wells) == wells


def test_a_star_is_all_wells() -> None:
    assert len(wells_in("*", INFO.wells)) == 96
