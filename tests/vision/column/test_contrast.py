"""Rows between the run's empty and its filled tip, and rows of which nothing is known."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.vision.column import Wetness

U = np.linspace(0.005, 0.995, 100, dtype=np.float32)


def wetness(wet_from: float, known_from: float = 0.0) -> Wetness:
    """A column from ``wet_from`` down; nothing is known above ``known_from``."""
    weight = np.where(known_from < U, 1.0, 0.0)
    return Wetness(U, np.where(wet_from < U, 1.0, 0.0), weight, 100.0)


def test_a_column_ends_where_its_rows_do() -> None:
    assert wetness(0.4).column(0.1, 0.95) == pytest.approx(0.4, abs=0.02)


def test_rows_of_which_nothing_is_known_do_not_lengthen_a_column() -> None:
    assert wetness(0.3, known_from=0.45).column(0.1, 0.95) == pytest.approx(0.45, abs=0.02)


def test_an_end_beside_unknown_rows_is_not_bracketed() -> None:
    assert wetness(0.5).bracketed(0.5, 0.04)
    assert not wetness(0.3, known_from=0.5).bracketed(0.5, 0.04)
    assert not wetness(0.3, known_from=0.5).known(0.2, 0.4)


def test_an_empty_tip_has_no_column() -> None:
    assert wetness(2.0).column(0.1, 0.95) == 1.0
