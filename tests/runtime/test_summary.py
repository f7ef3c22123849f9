"""The line at the end of a run counts wells: no attempts, and none that nobody saw."""

from __future__ import annotations

import platform
from dataclasses import replace

import pytest

from aegis_ot.runtime.descriptions import about_run
from aegis_ot.runtime.summary import WatchSummary
from aegis_ot.vocabulary import (
    ChannelOutcome,
    ChannelVerdict,
    Gate,
    Outcome,
    Route,
    Verdict,
)


def judged(number: int, outcome: Outcome) -> Verdict:
    return Verdict("run", number, outcome, Route.GREY_ZONE)


def test_attempts_are_counted_as_the_well_that_they_were_for() -> None:
    summary = WatchSummary(watching=True, places={0: "D4", 1: "D4", 2: "D4", 3: "A1", 4: "A1"})
    told = (Outcome.FAIL, Outcome.FAIL, Outcome.PASS, Outcome.FAIL, Outcome.UNDECIDED)
    summary.verdicts = {number: judged(number, outcome) for number, outcome in enumerate(told)}
    summary.attempts = {1: 0, 2: 0, 4: 3}
    summary.recovered = {0}
    assert summary.text().startswith(
        "Layer 2 watched 2 deliveries: 0 passed, 1 failed (A1), 1 put right (D4); held"
    )


def test_a_row_that_nobody_saw_counts_when_the_operator_decides_on_it() -> None:
    hidden = (ChannelVerdict("A1", None, ChannelOutcome.UNOBSERVED),)
    unseen = Verdict("run", 0, Outcome.PASS, Route.GREY_ZONE, channels=hidden)
    summary = WatchSummary(watching=True, places={0: "A1"}, verdicts={0: unseen})
    assert summary.of(Outcome.PASS) == ()
    summary.verdicts[0] = replace(unseen, gate=Gate.OPERATOR)
    assert summary.of(Outcome.PASS) == (0,)


def test_a_delivery_without_a_verdict_is_undecided() -> None:
    summary = WatchSummary(watching=True, places={0: "A1", 1: "B1", 2: "C1"})
    summary.verdicts = {0: judged(0, Outcome.PASS), 1: judged(1, Outcome.UNDECIDED)}
    summary.lost = {2: "timeout"}
    assert summary.text().startswith(
        "Layer 2 watched 3 deliveries: 1 passed, 2 undecided (B1, C1), 1 of them without a verdict;"
    )


def test_a_simulation_does_not_say_that_the_run_is_unwatched() -> None:
    assert "Layer 2 watches the run itself" in WatchSummary(watching=False).text()


def test_a_live_run_is_told_by_the_robots_own_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DEV_ROBOT_NAME", "blue-robot")
    assert about_run(None, "run", "p.py", False)["robot_name"] == "blue-robot"
    assert about_run(None, "run", "p.py", True)["robot_name"] == platform.node()
