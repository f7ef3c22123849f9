"""The line at the end of a run counts wells, and no attempts to put them right."""

from __future__ import annotations

from aegis_ot.runtime.summary import WatchSummary
from aegis_ot.vocabulary import Outcome, Route, Verdict


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
