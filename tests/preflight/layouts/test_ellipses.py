"""Layouts in one line say more than they write: the words left out are put back, no others."""

from __future__ import annotations

import pytest

from aegis_ot.preflight import load_database
from aegis_ot.preflight.layouts.ellipses import spelled_out

COMMON = load_database().common


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        (
            "columns 3-10 drug, 11 vehicle, 12 untreated",
            "columns 3-10 drug, column 11 vehicle, column 12 untreated",
        ),
        ("row A blank, B to G samples, H NTC", "row A blank, row B to G samples, row H NTC"),
        ("1-3 tumour, 4 control, 5 NTC", "column 1-3 tumour, column 4 control, column 5 NTC"),
        ("Control column (6): rows A-D RNA, rows E-H water", " A6-D6 RNA, E6-H6 water"),
        ("Row H: columns 1-3 NTC, 4-6 control", " H1-H3 NTC, H4-H6 control"),
        ("row B, col 1-6 vehicle", "B1-B6 vehicle"),
        ("row A to row H, columns 3-4 lysates", "A3-H4 lysates"),
        ("plate, column 2 through column 4: water", "plate, columns 2-4: water"),
        ("A1 > A5   BSA", "A1-A5   BSA"),
        (
            "columns 1, 2 standards, twice; row A = 0, rows B-C = 20, 40 mg/L",
            "columns 1, 2 standards, twice; A1-A2 = 0, B1-C2 = 20, 40 mg/L",
        ),
        ("rows A-C, columns 7 and 8: 5 uM", "A7-C8: 5 uM"),
        ("columns 1-6 of row H: blank", "H1-H6: blank"),
        ("riga A, colonne 1-3: bianco", "A1-A3: bianco"),
        ("colonnes 1 à 3 témoin, 4 à 6 dilué", "colonnes 1 à 3 témoin, column 4 à 6 dilué"),
        (
            "cols: 1 = untreated, 2 = EtOH (vehicle), 3 = 1 nM",
            "cols 1 = untreated, column 2 = EtOH (vehicle), column 3 = 1 nM",
        ),
        ("rows: A-E samples, F positive, G NTC", "rows A-E samples, row F positive, row G NTC"),
        ("columns 1,3,5 = samples, 7 = NTC", "columns 1,3,5 = samples, column 7 = NTC"),
        (
            "column 6: A-D samples, E-F mock, G-H water (NTC)",
            "column 6: A6-D6 samples, E6-F6 mock, G6-H6 water (NTC)",
        ),
        (
            "column 2: A standard 1, B standard 2, ... G standard 7, H blank",
            "column 2: A2 standard 1, B2 standard 2, ... G2 standard 7, H2 blank",
        ),
        (
            "Controls in columns 10-12: row A/B positive, row D/E NTC",
            " A10-B12 positive, D10-E12 NTC",
        ),
        (
            "columns 1-3: standards, row H blank",
            " standards, H1-H3 blank",
        ),
        (
            "col 11: vehicle control, rows B-G, gets the DMF",
            "B11-G11: vehicle control, gets the DMF",
        ),
        (
            "Column 1: samples (A-F), G = positive control, H = NTC",
            "Column 1: samples (A1-F1), G1 = positive control, H1 = NTC",
        ),
        ("rows A/B = ctrl, C/D = 2 mM", "rows A/B = ctrl, row C/D = 2 mM"),
        ("odd columns -> DMSO", f"columns {','.join(map(str, range(1, 25, 2)))} -> DMSO"),
        ("even columns: drug", f"columns {','.join(map(str, range(2, 25, 2)))}: drug"),
        ("odd columns (1, 3, 5): DMSO", "columns 1, 3, 5: DMSO"),
        (
            "Last three columns: 10 = vehicle, 11 = drug, 12 = untreated",
            "Last three columns 10 = vehicle, column 11 = drug, column 12 = untreated",
        ),
        ("column 1: A = vehicle, B..H = drug", "column 1: A1 = vehicle, B1-H1 = drug"),
        ("c1 A-H = leaf, c2 H = NTC", "A1-H1 = leaf, H2 = NTC"),
        ("col 2 H: NTC", "H2: NTC"),
        (
            "rows: A-F = IP1..5, input; G = empty; H = NTC.",
            "rows A-F = IP1..5, input; row G = empty; row H = NTC.",
        ),
        (
            "columns 1-4: untreated, vehicle, low dose, high dose",
            "column 1: untreated, column 2: vehicle, column 3: low dose, column 4: high dose",
        ),
        (
            "columns 1, 2 and 3: untreated, vehicle and drug",
            "column 1: untreated, column 2: vehicle, column 3: drug",
        ),
        ("rows A-C = mock, siRNA 1, siRNA 2", "row A: mock, row B: siRNA 1, row C: siRNA 2"),
        ("tubes A1-A3: medium / DMSO / compound", "tubes A1: medium, A2: DMSO, A3: compound"),
        ("strip 2: master mix", "strip columns 2: master mix"),
        ("strips 1 and 2: primers", "strips columns 1 and 2: primers"),
        ("Streifen 3: Wasser", "Streifen columns 3: Wasser"),
    ],
)
def test_what_is_left_out_is_put_back(written: str, meant: str) -> None:
    assert spelled_out(written, COMMON) == meant


@pytest.mark.parametrize(
    "written",
    [
        "columns 1-3 standards, 8 samples",
        "columns 1-6 samples, 7 uL each",
        "columns 1,3,5 samples, 7 ng NTC",  # no "=": an amount
        "column 4: C-D samples, E-F mock",  # does not count on from A
        "column 3: A, B and D stay empty",
        "Row A: standards",
        "add 5 uL, then 10 uL",
        "1 plate, 2 racks",
        "c2 H = NTC",  # "c2" alone may be anything
        "columns 1-3 are odd",
        "columns 1-3: 10, 20, 30",  # amounts
        "columns 1-2: untreated, drug",  # two: the second may say more about the first
        "columns 1-4: untreated, vehicle, drug",  # fewer than places
        "columns 1-3: samples, as in D1, blank",
        "columns 1-3: a long word about what stands here, vehicle, drug",
        "columns 1-3: siRNA (one, two, three)",
        "two strips of tubes",
        "strip the lids",
        "from column 1 to column 3",  # a transfer, perhaps
        "A1 > A5   50 uL",
        "A1 > A2   dye",
    ],
)
def test_other_numbers_are_left_alone(written: str) -> None:
    assert spelled_out(written, COMMON) == written
