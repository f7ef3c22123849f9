"""The words of spec/rules.md become values: touch, empty well, carry, air, tips, plates."""

from __future__ import annotations

from dataclasses import replace

import pytest

from aegis_ot.adapters.opentrons.instrumentation import (
    EventKind,
    Operation,
    OperationKind,
    WellInfo,
)
from aegis_ot.preflight.trace import Contact
from aegis_ot.preflight.trace.plates import Plates
from aegis_ot.preflight.trace.tips import TipBox
from aegis_ot.vocabulary import WellRef
from tests.support.bench import PIPETTE, Bench, carried, plate, well
from tests.support.cases import case_of


def test_a_dispense_into_an_empty_well_adds_nothing_to_the_tip() -> None:
    bench = Bench()
    bench.pick()
    bench.draw("source:A1", 50)
    bench.give("plate:A1", 50)
    trace = bench.trace()
    assert carried(trace) == ["source:A1"]
    assert not trace.visits[-1].touches
    assert trace.visits[-1].contact is Contact.WET


def test_a_dispense_into_liquid_takes_its_contents_along() -> None:
    bench = Bench()
    bench.load("plate:A1", 50)
    bench.pick()
    bench.draw("source:A1", 50)
    bench.give("plate:A1", 50)
    assert carried(bench.trace()) == ["source:A1", "plate:A1"]


def test_a_dispense_from_above_touches_nothing() -> None:
    bench = Bench()
    bench.load("plate:A1", 50)
    bench.pick()
    bench.draw("source:A1", 50)
    bench.give("plate:A1", 50, top=0.0)
    trace = bench.trace()
    assert carried(trace) == ["source:A1"]
    assert trace.visits[-1].contact is Contact.CLEAR


@pytest.mark.parametrize(
    ("top", "contact"),
    [(-8.0, Contact.WET), (-6.0, Contact.NEAR), (-4.0, Contact.CLEAR), (0.0, Contact.CLEAR)],
)
def test_the_tracked_level_decides_below_the_top(top: float, contact: Contact) -> None:
    """100 µL stand 3.5 mm high in a well of 6 mm that is 10 mm deep; 2 mm more is clear."""
    bench = Bench()
    bench.load("plate:A1", 50)
    bench.pick()
    bench.draw("source:A1", 50)
    bench.give("plate:A1", 50, top=top)
    assert bench.trace().visits[-1].contact is contact


@pytest.mark.parametrize(("top", "contact"), [(-3.0, Contact.CLEAR), (-4.0, Contact.NEAR)])
def test_an_unknown_volume_is_clear_in_the_upper_third(top: float, contact: Contact) -> None:
    bench = Bench()
    bench.load("plate:A1", None)
    bench.pick()
    bench.draw("source:A1", 5)
    bench.give("plate:A1", 5, top=top)
    assert bench.trace().visits[-1].contact is contact


@pytest.mark.parametrize(("taken", "contact"), [(180, Contact.CLEAR), (20, Contact.NEAR)])
def test_a_well_emptied_in_part_is_no_fuller_than_what_a_full_one_left(
    taken: float, contact: Contact
) -> None:
    """Less than 20 (or 180) of 200 µL are left; 20 more stand up to 1.4 (or 7) mm."""
    bench = Bench()
    bench.load("plate:A1", None)
    bench.pick()
    bench.draw("plate:A1", taken)
    bench.give("source:B1", taken)
    bench.draw("source:A1", 20)
    bench.give("plate:A1", 20, top=-4.0)
    assert bench.trace().visits[-1].contact is contact


def test_a_touched_wall_is_near_at_most() -> None:
    bench = Bench()
    bench.load("plate:A1", 200)
    bench.load("plate:B1", 50)
    bench.pick()
    bench.touch_tip("plate:A1")
    bench.touch_tip("plate:B1")
    assert [visit.contact for visit in bench.trace().visits] == [Contact.NEAR, Contact.CLEAR]


def test_what_is_drawn_above_the_liquid_after_a_draw_is_air() -> None:
    bench = Bench()
    bench.load("source:A1", 100)
    bench.pick()
    bench.draw("source:A1", 40)
    bench.draw("source:A1", 10, top=-1.0)
    bench.give("plate:A1", 50)
    trace = bench.trace()
    assert well(trace, "source:A1").volume == 60
    assert well(trace, "plate:A1").volume == pytest.approx(40)


def test_contact_that_was_near_becomes_wet() -> None:
    bench = Bench()
    bench.load("plate:A1", 50)
    bench.pick()
    bench.touch_tip("plate:A1")
    bench.draw("source:A1", 20)
    bench.give("plate:A1", 20, top=-6.5)
    bench.draw("plate:A1", 10)
    (_, near, wet) = (
        visit
        for visit in bench.trace().visits
        if visit.well.ref.name == "A1" and visit.well.ref.labware == "plate"
    )
    met = near.tip.touched[near.well]
    assert met.contact(near.index) is Contact.NEAR
    assert met.contact(wet.index) is Contact.WET


def test_a_returned_tip_goes_on_with_its_history() -> None:
    bench = Bench()
    bench.pick("A1")
    bench.draw("source:A1", 50)
    bench.give("plate:A1", 50)
    bench.drop(back="A1")
    bench.say(EventKind.TIPS_RESET, "", "rack")
    bench.pick("A1")
    trace = bench.trace()
    assert len(trace.tips) == 1
    assert trace.tips[0].session == 2


def test_a_trashed_tip_is_new_after_a_reset() -> None:
    bench = Bench()
    bench.pick("A1")
    bench.draw("source:A1", 50)
    bench.drop()
    bench.say(EventKind.TIPS_RESET, "", "rack")
    bench.pick("A1")
    bench.draw("source:B1", 50)
    trace = bench.trace()
    assert len(trace.tips) == 2
    assert carried(trace, 1) == ["source:B1"]


def test_air_is_no_volume_and_leaves_first() -> None:
    bench = Bench()
    bench.pick()
    bench.draw("source:A1", 40)
    bench.air(10)
    bench.give("plate:A1", 30)
    trace = bench.trace()
    assert well(trace, "plate:A1").volume == pytest.approx(20)


def test_aspirating_above_the_top_draws_air() -> None:
    bench = Bench()
    bench.load("source:A1", 100)
    bench.pick()
    bench.draw("source:A1", 40, top=1.0)
    trace = bench.trace()
    assert well(trace, "source:A1").volume == 100
    assert not trace.visits


def test_a_blow_out_gives_what_is_left() -> None:
    bench = Bench()
    bench.pick()
    bench.draw("source:A1", 40)
    bench.give("plate:A1", 30)
    bench.blow_out("plate:B1")
    assert well(bench.trace(), "plate:B1").volume == pytest.approx(10)


def test_touching_the_wall_of_a_filled_well_counts_of_an_empty_one_does_not() -> None:
    bench = Bench()
    bench.load("plate:A1", 200)
    bench.pick()
    bench.touch_tip("plate:A1")
    bench.touch_tip("plate:B1")
    assert carried(bench.trace()) == ["plate:A1"]


def test_repeated_pipetting_in_one_well_is_mixing() -> None:
    bench = Bench()
    bench.load("plate:A1", 100)
    bench.pick()
    bench.draw("source:A1", 20)
    bench.give("plate:A1", 20)
    for _ in range(3):
        bench.draw("plate:A1", 50)
        bench.give("plate:A1", 50)
    trace = bench.trace()
    target = well(trace, "plate:A1")
    assert len(target.mixes) == 1
    arrival = target.received[0].visit
    assert trace.mixed_since(target, arrival.index, float("inf"))


def test_overfilling_and_overdrawing_are_noticed_exactly_full_is_not() -> None:
    bench = Bench()
    bench.pick()
    bench.draw("source:A1", 200)
    bench.give("plate:A1", 200)
    assert not bench.trace().imbalances
    bench.draw("source:A1", 1)
    bench.give("plate:A1", 1)
    bench.draw("plate:A1", 250)
    kinds = [imbalance.overfilled for imbalance in bench.trace().imbalances]
    assert kinds == [True, False]


@pytest.mark.parametrize(("nominal", "overfilled"), [(0.3, False), (120.0, True)])
def test_a_nominal_volume_in_millilitres_is_no_capacity(nominal: float, overfilled: bool) -> None:
    well = WellInfo(nominal, 10.67, diameter=6.86)
    info = replace(plate("1", ["A1"]), wells={"A1": well})
    plates = Plates({"1": info}, lambda ref: False, {})
    assert (plates.well(WellRef("1", "A1")).capacity < 250) is overfilled


def test_what_is_drawn_to_empty_a_sample_of_unknown_volume_fills_no_waste() -> None:
    bench = Bench()
    bench.load("plate:A1", None, "sample")
    for _ in range(3):
        bench.pick()
        bench.draw("source:A1", 60)
        bench.give("plate:A1", 60)
        bench.draw("plate:A1", 80)
        bench.give("source:H12", 80)
        bench.drop()
    trace = bench.trace()
    assert well(trace, "source:H12").volume == pytest.approx(240)
    assert not trace.imbalances  # of 240 µL 60 are not known to be liquid; the well holds 200


def test_a_source_without_declared_volume_never_runs_dry() -> None:
    bench = Bench()
    bench.pick()
    for _ in range(50):
        bench.draw("source:A1", 200)
        bench.give("plate:A1", 200, top=0.0)
        bench.draw("plate:A1", 200)
        bench.give("source:B1", 0)
    assert not [i for i in bench.trace().imbalances if i.visit.well.ref.labware == "source"]


@pytest.mark.parametrize(
    ("text", "new"),
    [
        ("Replace the plate in slot 1 with a new one", True),
        ("Bitte die Platte wechseln", True),
        ("Replace the tips", False),
        ("Remove the lid", False),
    ],
)
def test_a_plate_replaced_in_a_pause_is_a_new_plate(text: str, new: bool) -> None:
    bench = Bench()
    bench.pick()
    bench.draw("source:A1", 150)
    bench.give("plate:A1", 150)
    bench.say(EventKind.PAUSED, text)
    bench.draw("source:A1", 150)
    bench.give("plate:A1", 150)
    trace = bench.trace()
    assert (("plate", 1, "A1") in trace.wells) is new
    assert bool(trace.imbalances) is not new


def test_what_comes_back_is_the_same_plate_of_unknown_volumes() -> None:
    bench = Bench()
    bench.pick()
    bench.draw("source:A1", 150)
    bench.give("plate:A1", 150)
    bench.say(EventKind.PAUSED, "Spin the plate, put it back in slot 1 and resume")
    bench.draw("source:A1", 150)
    bench.give("plate:A1", 150)
    trace = bench.trace()
    assert not trace.imbalances
    assert not well(trace, "plate:A1").known


def test_a_module_shakes_the_plate_that_is_on_it_and_no_other() -> None:
    bench = Bench()
    bench.pick()
    bench.draw("source:A1", 50)
    bench.give("plate:A1", 50)
    bench.say(EventKind.MODULE, "set and wait for shake speed 500", "plate")
    bench.say(EventKind.MODULE, "open lid", "source")
    trace = bench.trace()
    assert trace.mixed_since(well(trace, "plate:A1"), 0, float("inf"))
    assert not trace.mixed_since(well(trace, "source:A1"), 0, float("inf"))


def test_a_plate_taken_off_the_deck_comes_back_as_a_new_one() -> None:
    bench = Bench()
    bench.pick()
    bench.draw("source:A1", 150)
    bench.give("plate:A1", 150)
    bench.say(EventKind.LABWARE_MOVED, "", "plate")
    bench.say(EventKind.LABWARE_MOVED, "1", "plate")
    bench.draw("source:A1", 150)
    bench.give("plate:A1", 150)
    assert not bench.trace().imbalances


@pytest.mark.parametrize("cycles", [1, 2, 7])
def test_mixing_with_the_volume_just_given_is_mixing(cycles: int) -> None:
    bench = Bench()
    bench.load("plate:A1", 100)
    bench.pick()
    bench.draw("source:A1", 50)
    bench.line = 10
    bench.give("plate:A1", 50)
    for _ in range(cycles):
        bench.line = 10
        bench.draw("plate:A1", 50, mixing=True)
        bench.line = 10
        bench.give("plate:A1", 50, mixing=True)
    trace = bench.trace()
    target = well(trace, "plate:A1")
    arrival = target.received[0].visit
    assert trace.mixed_since(target, arrival.index, float("inf"))
    assert target.volume == pytest.approx(150)


def test_a_multi_channel_pipette_that_picks_one_tip_has_one_tip() -> None:
    """The other nozzles hang beside the rack."""
    box = TipBox()
    lead = WellRef("rack", "H12")
    pair = replace(PIPETTE, channels=2)
    box.pick_up(Operation(OperationKind.PICK_UP_TIP, pair, ("A1", "B1"), ()), [lead, None])
    assert box.on("left", "A1") is not None
    assert box.on("left", "B1") is None


def test_what_was_drawn_off_to_the_last_is_met_again_once_the_well_is_filled_anew() -> None:
    bench = Bench()
    bench.load("plate:A1", 50)
    for step in ("off", "wash"):
        bench.pick()
        if step == "off":
            bench.draw("plate:A1", 50)
            bench.give("source:H12", 50)
        else:
            bench.draw("source:A1", 80)
            bench.give("plate:A1", 80)
        bench.drop()
    bench.pick()
    bench.draw("plate:A1", 80)
    bench.drop()
    trace = bench.trace()
    assert carried(trace, 1) == ["source:A1"], "nothing is met in a well that is empty"
    assert carried(trace, 2) == ["source:A1", "plate:A1"]


def test_a_well_is_not_meant_to_hold_what_its_source_was_given_later() -> None:
    bench = Bench()
    bench.load("source:A1", 50)
    for source, into, volume in (
        ("source:A1", "plate:A1", 20),
        ("source:B1", "source:A1", 20),
        ("source:A1", "plate:B1", 50),
        ("source:C1", "source:A1", 20),
        ("source:A1", "plate:C1", 10),
    ):
        bench.pick()
        bench.draw(source, volume)
        bench.give(into, volume)
        bench.drop()
    case = case_of(bench.trace(), "generic", {})
    meant = {w.ref.address: {one.ref.address for one in held} for w, held in case.meant.items()}
    assert meant["plate:A1"] == {"source:A1"}
    assert meant["plate:C1"] == {"source:A1", "source:B1", "source:C1"}
