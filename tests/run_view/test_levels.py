"""Marks across a tip where a column ends."""

from __future__ import annotations

import pytest

from aegis_ot.run_view.levels import axis_of, expected_level, mark_at, measured_level
from aegis_ot.vocabulary import KeyframeKind

BOX = (40.0, 0.0, 20.0, 100.0)
AXIS = axis_of(BOX)
TRANSIT = KeyframeKind.TRANSIT


def test_a_mark_stands_across_the_tip() -> None:
    mark = mark_at(AXIS, BOX, 0.25)
    assert mark is not None
    assert mark[0][1] == mark[1][1] == pytest.approx(75)
    assert mark_at(AXIS, BOX, 0) is None


def test_an_expected_column_is_marked_only_where_it_is_known_to_end() -> None:
    known = expected_level({"expected_top": {"transit": 0.25}}, TRANSIT, 8.0, AXIS, BOX)
    assert known.mark == mark_at(AXIS, BOX, 0.25)
    unknown = expected_level({}, TRANSIT, 8.0, AXIS, BOX)
    assert (unknown.volume_ul, unknown.mark) == (8.0, None)


def test_a_measured_column_is_marked_where_it_was_seen() -> None:
    told = {"volume": 8.0, "uncertainty": None, "air": 0.5, "top": 0.3}
    level = measured_level({"measured_ul": {"transit": told}}, TRANSIT, AXIS, BOX)
    assert level is not None
    assert (level.volume_ul, level.sigma_ul, level.air_ul) == (8.0, 0.0, 0.5)
    assert level.mark == mark_at(AXIS, BOX, 0.3)
    assert measured_level({}, TRANSIT, AXIS, BOX) is None
