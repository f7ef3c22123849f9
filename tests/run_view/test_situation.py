"""What a run asks of a person, and what its robot does."""

from __future__ import annotations

from typing import Any

from aegis_ot.run_view.situation import doing, situations

from .overviews import delivery, hold, overview

NOW = 110.0


def kinds(run: dict[str, Any], now: float = NOW) -> list[str]:
    return [one.kind for one in situations(run, now)]


def test_a_sound_run_asks_for_nothing() -> None:
    assert kinds(overview(delivery(0), delivery(1))) == []


def test_a_robot_that_told_of_a_pause_stands_until_it_moves() -> None:
    failed = delivery(0, "fail", holds=[hold(0)])
    (paused,) = situations(overview(failed), NOW)
    assert (paused.kind, paused.trajectory, paused.judged) == ("paused", 0, True)
    assert "partial dispense" in paused.title
    assert "52 µL" in paused.text
    assert paused.left_s is None
    assert kinds(overview(failed | {"holds": [hold(0, paused_s=12.0)]})) == []
    moved = delivery(1, None)
    moved["keyframes"][0]["captured"] = 105.0
    assert kinds(overview(failed, moved)) == []


def test_what_a_person_told_the_robot_is_shown_until_it_has_done_it() -> None:
    action = {"trajectory": 0, "action": "resume", "by": "Ada", "note": "", "at": 105.0}
    (paused,) = situations(overview(delivery(0, "fail", holds=[hold(0)]), actions=[action]), NOW)
    assert paused.answered == "Ada answered: continue. The robot has not moved yet."
    assert not paused.answers, "whoever comes later does not answer again"


def test_a_pause_without_a_verdict_can_only_be_resumed_or_stopped() -> None:
    late = delivery(0, None, holds=[hold(0, resolution="timeout")])
    (paused,) = situations(overview(late), NOW)
    assert not paused.judged
    assert "timeout" in paused.text


def test_a_question_counts_down_to_what_the_guard_does() -> None:
    asked = delivery(0, "undecided", awaiting="operator", awaiting_s=41.0)
    (question,) = situations(overview(asked), NOW)
    assert (question.kind, question.left_s, question.then) == ("question", 41.0, "the robot pauses")
    assert question.asks


def test_a_long_hold_shows_and_a_short_one_does_not() -> None:
    assert kinds(overview(delivery(0, None, held_for_s=0.4))) == []
    (held,) = situations(overview(delivery(0, None, held_for_s=20.0)), NOW)
    assert (held.kind, held.left_s) == ("holding", 40.0)


def test_trouble_shows_while_it_lasts() -> None:
    trouble = {"kind": "camera", "text": "no frame", "at": 100.0, "ended": None}
    assert kinds(overview(delivery(0), incidents=[trouble])) == ["camera"]
    assert kinds(overview(delivery(0), incidents=[trouble | {"ended": 105.0}])) == []


def test_a_silent_robot_shows_and_an_ended_run_does_not() -> None:
    assert kinds(overview(delivery(0)), now=2000.0) == ["silent"]
    ended = {"at": 120.0, "outcome": "succeeded", "detail": ""}
    assert kinds(overview(delivery(0, "fail", holds=[hold(0)]), finished=ended), now=2000.0) == []


def test_what_the_robot_does_is_its_last_keyframe() -> None:
    assert doing(overview()) == "No delivery has been seen yet."
    cut = delivery(1, None)
    cut["keyframes"] = cut["keyframes"][:1]
    said = doing(overview(delivery(0), cut))
    assert said.startswith("drawing 100 µL from A1 of reservoir in slot 2, line 12")
    assert "has delivered 100 µL into A1" in doing(overview(delivery(0)))
