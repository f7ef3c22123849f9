"""Watch mode: nozzles at work, and the wells under them."""

from __future__ import annotations

import pytest

from aegis_ot.workbench.nozzles import layout_of, under, whole_head


def ordering(rows: int, columns: int) -> list[list[str]]:
    letters = "ABCDEFGHIJKLMNOP"[:rows]
    return [[f"{row}{column}" for row in letters] for column in range(1, columns + 1)]


PLATE = ordering(8, 12)


@pytest.mark.parametrize(
    ("rows", "columns", "channels", "first", "wells"),
    [
        (8, 12, 1, "C3", ("C3",)),
        (8, 12, 8, "A3", tuple(f"{row}3" for row in "ABCDEFGH")),
        (16, 24, 8, "B5", tuple(f"{row}5" for row in "BDFHJLNP")),
        (1, 12, 8, "A4", ("A4",) * 8),
        (4, 6, 8, "A1", ("A1",) * 8),
        (8, 12, 96, "A1", tuple(f"{row}{c}" for c in range(1, 13) for row in "ABCDEFGH")),
        (1, 12, 96, "A1", tuple(f"A{c}" for c in range(1, 13) for _ in range(8))),
        (1, 1, 96, "A1", ("A1",) * 96),
    ],
)
def test_the_wells_under_a_head(
    rows: int, columns: int, channels: int, first: str, wells: tuple[str, ...]
) -> None:
    assert under(ordering(rows, columns), first, whole_head(channels)) == wells


@pytest.mark.parametrize(
    ("channels", "params", "named", "nozzles", "wells"),
    [
        (8, {"style": "SINGLE", "primaryNozzle": "H1"}, "D2", "H1", "D2"),
        (
            8,
            {"style": "QUADRANT", "primaryNozzle": "H1", "frontRightNozzle": "H1",
             "backLeftNozzle": "E1"},
            "D2", "E1 F1 G1 H1", "A2 B2 C2 D2",
        ),
        (
            96, {"style": "ROW", "primaryNozzle": "H1"}, "B1",
            " ".join(f"H{c}" for c in range(1, 13)), " ".join(f"B{c}" for c in range(1, 13)),
        ),
        (
            96, {"style": "COLUMN", "primaryNozzle": "A12"}, "A3",
            " ".join(f"{row}12" for row in "ABCDEFGH"), " ".join(f"{row}3" for row in "ABCDEFGH"),
        ),
        # There are no wells above the first row.
        (
            8,
            {"style": "QUADRANT", "primaryNozzle": "H1", "frontRightNozzle": "H1",
             "backLeftNozzle": "G1"},
            "A2", "G1 H1", "A2 A2",
        ),
    ],
)  # fmt: skip
def test_the_wells_under_part_of_a_head(
    channels: int, params: dict[str, str], named: str, nozzles: str, wells: str
) -> None:
    layout = layout_of(params, channels)
    assert layout.nozzles == tuple(nozzles.split())
    assert under(PLATE, named, layout) == tuple(wells.split())


def test_all_nozzles_work_again_after_a_reset() -> None:
    assert layout_of({"style": "ALL"}, 8) == whole_head(8)
