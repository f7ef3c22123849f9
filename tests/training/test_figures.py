"""The figures by which a detector is judged."""

from __future__ import annotations

import pytest

from aegis_ot.training.figures import average_precision, choose_threshold, overlap


def test_overlap_of_boxes() -> None:
    assert overlap((0, 0, 10, 10), (0, 0, 10, 10)) == 1.0
    assert overlap((0, 0, 10, 10), (5, 0, 10, 10)) == pytest.approx(1 / 3)
    assert overlap((0, 0, 10, 10), (10, 0, 10, 10)) == 0.0


def test_average_precision_of_a_perfect_and_a_blind_detector() -> None:
    assert average_precision([0.9, 0.8], [True, True], 2) == 1.0
    assert average_precision([], [], 2) == 0.0
    assert average_precision([0.9], [False], 2) == 0.0


def test_a_missed_tip_and_a_false_alarm_cost() -> None:
    assert average_precision([0.9], [True], 2) == pytest.approx(0.5)
    # Found, false, found: recall 1/2 at precision 1, then 1 at precision 2/3.
    assert average_precision([0.9, 0.8, 0.7], [True, False, True], 2) == pytest.approx(5 / 6)


def test_the_threshold_lies_in_the_middle_of_the_gap() -> None:
    assert choose_threshold([0.6, 0.8, 0.9], [0.1, 0.2]) == pytest.approx(0.4, abs=0.01)


def test_an_imagined_tip_costs_more_than_a_missed_one() -> None:
    assert choose_threshold([0.3, 0.8, 0.9, 0.9], [0.1, 0.1, 0.1, 0.4]) > 0.4
