"""A run in one line: its state, its wells, and what a button causes."""

from __future__ import annotations

from typing import Any

from aegis_ot.run_view import RunView, run_view

from .overviews import delivery, hold, overview, row

NOW = 110.0
PLAN = {
    "plates": [{"labware": "p", "label": "plate", "slot": "4", "rows": 8, "columns": 12}],
    "planned": [{"labware": "p", "wells": [f"A{n}"]} for n in range(1, 13)],
    "planned_wells": 12,
}


def view(*deliveries: dict[str, Any], **changes: Any) -> RunView:
    return run_view(overview(*deliveries, **changes), NOW)


def test_a_row_of_tips_counts_as_its_wells_and_the_failed_one_is_named() -> None:
    failed = row(1, "..F.....", holds=[hold(1)])
    run = view(row(0, "........"), failed)
    assert run.state == "paused"
    assert run.headline == "C2 failed: partial dispense"
    assert run.counts == {"pass": 15, "fail": 1, "wells": 16, "deliveries": 2}
    assert (run.wells_done, run.wells_planned) == (16, None)
    assert run.asks[0].well == "C2"
    assert run.asks[0].answers[0].causes.startswith("C2 stays marked as failed; ")


def test_each_well_of_a_row_that_was_put_right_keeps_its_own_verdict() -> None:
    (plate,) = view(row(0, ".F......", recovered=True)).plates
    assert [plate.wells[f"{letter}1"].state for letter in "ABC"] == ["pass", "recovered", "pass"]


def test_a_plate_has_the_size_that_the_robot_told_and_shows_what_is_still_to_come() -> None:
    run = view(delivery(0), **PLAN)
    (plate,) = run.plates
    assert (len(plate.rows), len(plate.columns)) == (8, 12)
    assert plate.planned == [f"A{n}" for n in range(2, 13)]
    assert (run.wells_done, run.wells_planned) == (1, 12)
    before = view(**PLAN)
    assert [one.title for one in before.plates] == ["plate, slot 4"], "before the first delivery"


def test_a_well_that_is_to_receive_more_is_not_done() -> None:
    twice = PLAN | {"planned": [{"labware": "p", "wells": ["A1"]}] * 2, "planned_wells": 1}
    assert view(delivery(0), **twice).wells_done == 0


def test_the_time_left_is_told_by_the_usual_step_and_not_by_pauses() -> None:
    done = [delivery(n) for n in range(5)]
    for number, one in enumerate(done):
        for keyframe in one["keyframes"]:
            keyframe["captured"] += 10.0 * number + (500.0 if number == 4 else 0.0)
    assert view(*done, **PLAN).left_s == 70.0
    assert view(*done[:2], **PLAN).left_s is None, "too early to tell"
    assert view(*done).left_s is None, "no plan"


def test_a_button_says_what_the_robot_does_next() -> None:
    failed = delivery(0, "fail", holds=[hold(0, next="the tip is dropped")])
    on, fine, stop = view(failed, **PLAN).asks[0].answers
    assert on.causes == "A1 stays marked as failed; the tip is dropped, then A2 is filled"
    assert fine.causes == "A1 is marked as passed; the tip is dropped, then A2 is filled"
    assert stop.causes == "11 wells stay without their liquid"
    entering = delivery(0, "fail", holds=[hold(0, next="the tip enters A2 of plate (slot 4)")])
    assert view(entering, **PLAN).asks[0].answers[0].causes.endswith("failed; A2 is filled")
    older = delivery(0, "fail", holds=[hold(0)])
    assert view(older).asks[0].answers[0].causes.endswith("the robot does its next step")


def test_a_run_ends_in_the_words_of_its_wells() -> None:
    ended = {"finished": {"at": 120.0, "outcome": "succeeded", "detail": ""}}
    assert view(delivery(0), delivery(1), **ended).headline == "Ended: all 2 wells passed"
    bad = view(delivery(0), delivery(1, "fail"), **ended)
    assert (bad.headline, bad.bad) == ("Ended: 1 well failed", True)
    other = ended | {"layer1": {"verdict": "not as rehearsed", "findings": [], "note": "A1."}}
    differs = view(delivery(0), **other)
    assert (differs.headline, differs.bad) == ("Ended: the well passed; not as rehearsed", True)
    stopped = {"finished": {"at": 120.0, "outcome": "stopped", "detail": ""}}
    assert view(**stopped).headline == "Stopped by a person: no well was filled"


def test_all_of_it_that_stayed_is_no_partial_dispense() -> None:
    failed = delivery(0, "fail", holds=[hold(0)])
    failed["verdict"] |= {"measured_ul": 100.0, "expected_ul": 0.0}
    assert view(failed).headline == "A1 failed: no dispense"


def test_a_usual_wait_for_a_verdict_is_no_alarm() -> None:
    waits = view(delivery(0), delivery(1, None, held_for_s=0.8))
    assert (waits.state, waits.reading, waits.asks, waits.others) == ("running", "A2", [], [])
    assert waits.headline == "reading A2; no well has failed", "the well is read in the first line"
    late = view(delivery(1, None, held_for_s=3.5))
    assert (late.state, late.headline) == ("holding", "for the camera to judge A2")


def test_while_liquid_is_drawn_the_well_that_it_is_for_is_named_and_not_its_source() -> None:
    draws = delivery(1, None)
    draws["keyframes"] = draws["keyframes"][:1]
    draws["keyframes"][0]["destinations"] = []
    draws["well"] = "A1 of Stocks (slot 2)"
    run = view(delivery(0), draws, **PLAN)
    assert run.headline == "drawing for A2; no well has failed"
    assert run.plates[0].planned[0] == "A2", "its well stays marked as one to come"
    assert view(delivery(0), draws).headline == "drawing liquid; no well has failed", "no plan"
    done = delivery(1, abandoned={"reason": "camera"})
    done["keyframes"] = draws["keyframes"]
    assert view(delivery(0), done, **PLAN).plates[0].planned[0] == "A3", "given up is begun"
