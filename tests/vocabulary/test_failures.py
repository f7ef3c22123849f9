"""The table of failures is whole, and other rooms go by it."""

from __future__ import annotations

from aegis_ot.settings.values import RECOVERIES
from aegis_ot.simulation.faults import FaultKind
from aegis_ot.vision.dataset_checks import FAILURE_TYPES
from aegis_ot.vocabulary import FAILURES, FailureType


def test_every_kind_has_its_row_and_a_label_of_its_own() -> None:
    assert set(FAILURES) == set(FailureType)
    labels = [known.label for known in FAILURES.values() if known.label]
    assert len(set(labels)) == len(labels)
    assert set(labels) <= set(FAILURE_TYPES)


def test_what_the_robot_can_put_right_is_what_settings_allow() -> None:
    assert RECOVERIES == {
        "no_aspirate": "retry", "no_dispense": "retry", "partial_dispense": "top_up",
    }  # fmt: skip


def test_every_kind_that_a_verdict_can_name_can_be_planted() -> None:
    named = {kind for kind in FailureType if kind is not FailureType.OTHER}
    assert all(any(kind.value.startswith(f.value) for f in FaultKind) for kind in named)
