"""First wells: what proves them, when the operator is asked, and what comes of the answer."""

from __future__ import annotations

import pytest

from aegis_ot.vision.delivery import Delivery, Shown
from aegis_ot.vision.first_wells import FirstWells
from aegis_ot.vision.gates import GateInput
from aegis_ot.vocabulary import Route

from .samples import sample

PLAIN, NOTHING = Delivery(Shown.EMPTIED, 10.0), Delivery(Shown.NOTHING, 0.5)
UNKNOWN = Delivery(Shown.UNKNOWN)


def well(delivery: Delivery) -> GateInput:
    return GateInput(sample(), Route.CALIBRATION, delivery=delivery)


@pytest.mark.parametrize("shown", [NOTHING, UNKNOWN, None])
def test_a_first_well_that_proves_nothing_is_asked_about(shown: Delivery | None) -> None:
    assert "look at the tip" in FirstWells().question("red", shown)
    assert FirstWells(ask=False).question("red", shown) == ""


def test_a_well_that_proves_its_delivery_vouches_for_its_liquid_alone() -> None:
    first = FirstWells()
    assert first.question("red", PLAIN) == ""
    first.learn("red", well(PLAIN))
    assert first.question("red", UNKNOWN) == ""
    assert first.question("water", UNKNOWN) != ""


def test_the_operators_word_holds_for_the_run() -> None:
    first = FirstWells()
    first.vouch(NOTHING)
    assert first.question("water", NOTHING) == ""


def test_air_in_the_column_of_every_well_is_asked_about_once() -> None:
    first = FirstWells()
    for unbroken in (0.3, 0.55, 0.2):
        seen = Delivery(Shown.EMPTIED, 10.0, unbroken=unbroken)
        assert first.question("red", seen) == ""
        first.learn("red", well(seen))
    seen = Delivery(Shown.EMPTIED, 10.0, unbroken=0.35)
    assert "Air seems to be enclosed" in first.question("red", seen)
    first.vouch(seen)
    first.learn("red", well(seen))
    assert first.question("red", seen) == ""
    assert first.question("water", NOTHING) != "", "what was answered is another question"


def test_what_was_asked_about_air_is_known_after_a_restart() -> None:
    first = FirstWells()
    for _ in range(4):
        first.restore("red", 10.0, 0.3)
    assert first.question("red", Delivery(Shown.EMPTIED, 10.0, unbroken=0.3)) == ""
    first = FirstWells()
    for _ in range(3):
        first.restore("red", 10.0, 0.3)
    assert first.question("red", Delivery(Shown.EMPTIED, 10.0, unbroken=0.3)) != ""


def test_single_stretches_that_change_little_are_no_air() -> None:
    first = FirstWells()
    for unbroken in (0.9, 0.2, 0.8, 0.3, 0.7, 0.9):
        seen = Delivery(Shown.EMPTIED, 10.0, unbroken=unbroken)
        assert first.question("red", seen) == ""
        first.learn("red", well(seen))


def test_nothing_to_be_seen_is_a_sign_only_where_the_liquid_was_seen() -> None:
    first = FirstWells()
    assert first.held_against("red", NOTHING).shown is Shown.FAINT
    first.learn("red", well(PLAIN))
    assert first.held_against("red", NOTHING).shown is Shown.NOTHING
    weak = Delivery(Shown.NOTHING, 5.0)
    assert first.held_against("red", weak).shown is Shown.FAINT
    assert first.held_against("water", NOTHING).shown is Shown.FAINT


def test_one_well_among_many_that_seems_to_show_a_faint_liquid_proves_none() -> None:
    first = FirstWells()
    for _ in range(20):
        first.learn("water", well(first.held_against("water", NOTHING)))
    first.learn("water", well(PLAIN))
    assert not first.proven("water")
    assert first.held_against("water", NOTHING).shown is Shown.FAINT


def test_a_liquid_that_fades_away_stays_one_that_showed() -> None:
    first = FirstWells()
    for _ in range(12):
        first.learn("red", well(PLAIN))
    for _ in range(30):
        first.learn("red", well(Delivery(Shown.FAINT, 4.0)))
    assert first.held_against("red", NOTHING).shown is Shown.NOTHING


def test_one_spoiled_frame_postpones_the_question_once() -> None:
    first, spoiled = FirstWells(), Delivery(Shown.UNKNOWN, spoiled=True)
    assert first.question("red", spoiled) == ""
    assert first.question("red", spoiled) != ""
