"""Rows that stand under a heading of columns, or in brackets behind it, become wells."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import load_database
from aegis_ot.preflight.layouts.headed_columns import under_columns
from aegis_ot.preflight.layouts.well_names import well_names

NAMES = well_names(load_database().common)


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("Column 3:\n  A-C  blood\n  D  NTC", "Column 3:\n  A3-C3  blood\n  D3  NTC"),
        (
            "columns 4, 8, controls on their left:\n rows A-B plasmid, rows C-D NTC",
            "columns 4, 8, controls on their left:\n A4-B4, A8-B8 plasmid, C4-D4, C8-D8 NTC",
        ),
        (
            "column 2 vehicle (rows A/B DMSO, rows C/D ethanol)",
            "column 2 vehicle (A2-B2 DMSO, C2-D2 ethanol)",
        ),
        (
            "Strip in column 1:\n\n  A  toad 1      C  toad 3\n  B  toad 2      D  NTC",
            "Strip in column 1:\n\n  A1  toad 1      C1  toad 3\n  B1  toad 2      D1  NTC",
        ),
    ],
)
def test_letters_become_wells(written: str, meant: str) -> None:
    assert under_columns(written, NAMES) == meant


@pytest.mark.parametrize(
    "written",
    [
        "Column 3:\n  A  blood",
        "Column 3:\n\n\n  A  blood\n  B  water",
        "Column 3:\n  D  blood\n  A  water",
        "column 2 vehicle (A/B DMSO)",
        "columns 1-3:\nSee rows A-D of the sheet, rows E-H too",
    ],
)
def test_what_is_no_such_list_stays(written: str) -> None:
    assert under_columns(written, NAMES) == written
