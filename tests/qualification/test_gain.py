"""The table of what a fit brings, from counts."""

from __future__ import annotations

import math
from typing import Any

import pytest

from benchmarks.qualification_gain import gain_row, share_gained, show_gain


def count(caught: int, flagged: int, of_tenths: int = 0, planted: int = 24) -> dict[str, Any]:
    """As a certificate has it, of 24 faults, 2 of them a tenth left, and 18 normal wells."""
    rows = [
        {"kind": "left", "share": 0.1, "caught": {"hits": of_tenths, "of": 2}},
        {"kind": "air", "share": 0.1, "caught": {"hits": caught - of_tenths, "of": planted - 2}},
    ]
    normals = {"hits": flagged, "of": 18}
    return {
        "caught": {"hits": caught, "of": planted}, "normals_flagged": normals, "rows": rows,
    }  # fmt: skip


def lab(name: str, before: int, after: int, is_fitted: bool = True) -> dict[str, Any]:
    counts = {"shipped": count(before, 1), "fitted": count(after, 1, of_tenths=1)}
    return gain_row(name, counts, is_fitted)


def test_the_share_is_of_what_was_missed() -> None:
    share, low, high = share_gained([lab("one", 12, 18), lab("two", 18, 18)])
    assert share == pytest.approx(6 / 18)
    assert (low, high) == pytest.approx((0.0, 0.5))


def test_nothing_missed_has_no_share() -> None:
    assert all(math.isnan(each) for each in share_gained([lab("one", 24, 24)]))


def test_laboratories_stand_one_by_one_and_together() -> None:
    shown = show_gain([lab("one", 12, 18), lab("two", 18, 18, is_fitted=False)])
    assert "one: caught 12 -> 18 of 24, normals flagged 1 -> 1 of 18\n" in shown
    assert "two: caught 18 -> 18 of 24, normals flagged 1 -> 1 of 18; its qualif" in shown
    assert "left 10 %    0 -> 2 of 4\n" in shown
    assert "caught       30 -> 36 of 48; 4" in shown
    assert "of what was missed 33% is caught after" in shown
