"""What a person can answer, each with what it causes: the words on the page's buttons."""

from __future__ import annotations

from dataclasses import dataclass

from ..vocabulary import in_few_words
from .overview import HoldEntry, RunOverview
from .plates import still_planned

RECOVERY = "recovery"
"""Resolution of a pause in which a step that failed waits to be recovered from."""


@dataclass(frozen=True)
class Answer:
    """One button.

    Attributes:
        words: What the sidecar is told: ``"pass resume"``.
        label: In two or three words.
        causes: What happens then.
        kind: ``"pass"``, ``"fail"``, ``"stop"`` or ``""``.
    """

    words: str
    label: str
    causes: str = ""
    kind: str = ""


def answers_to_pause(
    overview: RunOverview, hold: HoldEntry, well: str, outcome: str
) -> tuple[Answer, ...]:
    """Of a robot that is paused.

    Args:
        overview: Of the run.
        hold: The hold that ended in the pause.
        well: Which well it is about, in short.
        outcome: Its verdict as it stands; ``""`` without one.
    """
    then = next_step(overview, hold)
    stop = Answer("stop", "Stop the run", _stopped(overview), "stop")
    if hold["resolution"] == RECOVERY:
        again = "the robot does it once more, then goes on"
        return (
            Answer("retry", "Try that step again", again, "pass"),
            Answer("resume", "Go on after it", "the robot does its next step"),
            stop,
        )
    if outcome not in ("fail", "undecided"):
        return Answer("resume", "Continue", then), stop
    label, verb = ("Continue", "stays") if outcome == "fail" else ("It failed: continue", "is")
    fine = f"{well} is marked as passed; {then}"
    return (
        Answer("fail resume", label, f"{well} {verb} marked as failed; {then}", "fail"),
        Answer("pass resume", "It is fine: continue", fine, "pass"),
        stop,
    )


def answers_to_question(overview: RunOverview, well: str, fails: str) -> tuple[Answer, ...]:
    """Of a verdict that is held back for a person."""
    passed = f"{well} is marked as passed; the robot goes on"
    failed = f"{well} is marked as failed; {fails or 'the robot is told so'}"
    return Answer("pass", "It passed", passed, "pass"), Answer("fail", "It failed", failed, "fail")


def next_step(overview: RunOverview, hold: HoldEntry) -> str:
    """What the robot does when it goes on: ``"the tip is dropped, then A2 is filled"``."""
    if hold["resolution"] in ("camera", "busy", "link"):
        return "the robot tries again; if that fails, it goes on unwatched"
    said, coming = str(hold.get("next") or ""), still_planned(overview)
    steps = [said] if said else []
    if coming:
        wells = list(coming[0]["wells"])
        # The step that waits may be the delivery itself.
        steps = [step for step in steps if not step.startswith(f"the tip enters {wells[0]} ")]
        steps.append(f"{in_few_words(wells)} {'are' if len(wells) > 1 else 'is'} filled")
    return ", then ".join(steps) or "the robot does its next step"


def _stopped(overview: RunOverview) -> str:
    wells = {(one["labware"], well) for one in still_planned(overview) for well in one["wells"]}
    if not wells:
        return "the robot does nothing more"
    if len(wells) == 1:
        return "1 well stays without its liquid"
    return f"{len(wells)} wells stay without their liquid"
