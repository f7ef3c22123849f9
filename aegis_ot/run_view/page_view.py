"""A run as its page shows it: one state, one headline, wells counted as wells."""

from __future__ import annotations

import itertools
import statistics
from collections.abc import Mapping, Sequence
from typing import Literal

from pydantic import BaseModel

from ..vocabulary import NOT_AS_REHEARSED, KeyframeKind, counted, in_few_words
from .overview import DeliveryEntry, RunOverview, is_not_as_rehearsed
from .plates import JUDGED, PlateView, count_wells, is_drawing, plates_of, short_name, still_planned
from .situation import Situation, doing, situations
from .summary import is_flagged

State = Literal["running", "holding", "asking", "paused", "ended"]

_LEAST_TIMED = 3
"""Deliveries after which it can be told how long the others will take."""

_ENDED = {
    "succeeded": "Ended",
    "stopped": "Stopped by a person",
    "aborted": "Ended by the guard",
    "failed": "The protocol failed",
    "rejected": "Rejected before anything moved",
    "silent": "The robot fell silent",
}


class RunView(BaseModel):
    """All that the page says of a run in its first line, and what stands behind it.

    Attributes:
        run: Its identifier.
        name: The protocol's own name, else its file's.
        file: The protocol's file.
        robot: Where it runs.
        simulated: Whether the frames are.
        state: Of the run as a whole.
        bad: Whether wells failed, the run was not as rehearsed, or a person has to look.
        headline: What there is to say first: ``"C2 failed: no dispense"``.
        text: What the robot does, or why it does nothing.
        wells_done, wells_planned: Wells that need nothing more, and all that the rehearsal filled;
            ``None`` where no rehearsal told.
        begun, ended, since: When it began, ended, and when its state did; seconds since the epoch.
        left_s: About how long it still takes, s; ``None`` where that cannot be told.
        reading: The well that is being read, if one is.
        read_for_s: For how long the robot has waited for it, s.
        plates: The plates that receive liquid.
        counts: Of wells by state, ``wells`` in all, and of ``deliveries``.
        flagged: Numbers of the deliveries that a person should look at, in their order.
        asks: What a person has to answer.
        others: What else should be seen: trouble, long holds.
    """

    run: str
    name: str
    file: str
    robot: str
    simulated: bool
    state: State
    bad: bool
    headline: str
    text: str
    wells_done: int
    wells_planned: int | None
    begun: float
    ended: float | None
    since: float | None
    left_s: float | None
    reading: str
    read_for_s: float
    plates: list[PlateView]
    counts: dict[str, int]
    flagged: list[int]
    asks: list[Situation]
    others: list[Situation]


def run_view(overview: RunOverview, now: float) -> RunView:
    """Gather it.

    Args:
        overview: Answer of ``GET /v1/runs/{run}``.
        now: Seconds since the epoch.
    """
    trajectories = overview["trajectories"]
    plates, shown = plates_of(overview), situations(overview, now)
    counts = count_wells(plates, trajectories)
    state, first = _state(overview, shown)
    held = [t for t in trajectories if t.get("held_for_s") is not None and not t["verdict"]]
    finished = overview.get("finished")
    coming = {(one["labware"], well) for one in still_planned(overview) for well in one["wells"]}
    done = {
        (plate.key, well.well)
        for plate in plates
        for well in plate.wells.values()
        if well.state in JUDGED
    }
    return RunView(
        run=str(overview["run"]),
        name=str(overview.get("title") or overview.get("protocol") or overview["run"]),
        file=str(overview.get("protocol") or ""),
        robot=str(overview.get("robot_name") or overview.get("robot") or "an unnamed robot"),
        simulated=bool(overview.get("simulated")),
        state=state,
        bad=bool(counts.get("fail") or counts.get("undecided") or is_not_as_rehearsed(overview)),
        headline=_headline(overview, first, counts),
        text=_text(overview, first),
        wells_done=len(done - coming),
        wells_planned=overview.get("planned_wells") or None,
        begun=float(overview.get("registered") or 0.0),
        ended=finished["at"] if finished else None,
        since=None if first is None else first.since,
        left_s=None if finished else _left(overview),
        reading=short_name(held[-1]) if held else "",
        read_for_s=max((one["held_for_s"] or 0.0 for one in held), default=0.0),
        plates=plates,
        counts=counts,
        flagged=[t["trajectory"] for t in trajectories if is_flagged(t)],
        asks=[one for one in shown if one.asks],
        others=[one for one in shown if not one.asks and one.kind != "holding"],
    )


def _state(overview: RunOverview, shown: Sequence[Situation]) -> tuple[State, Situation | None]:
    """The state of the run, and what makes it so."""
    if overview.get("finished"):
        return "ended", None
    kinds: dict[str, State] = {"paused": "paused", "question": "asking", "holding": "holding"}
    for kind, state in kinds.items():
        one = next((one for one in shown if one.kind == kind), None)
        if one is not None:
            return state, one
    return "running", None


def _headline(overview: RunOverview, first: Situation | None, counts: Mapping[str, int]) -> str:
    if first is not None:
        return first.title
    failed, ended = how_wells_stand(counts), overview.get("finished")
    if ended:
        differs = f"; {NOT_AS_REHEARSED}" if is_not_as_rehearsed(overview) else ""
        return f"{_ENDED.get(ended['outcome'], 'Ended')}: {failed}{differs}"
    bad = counts.get("fail") or counts.get("undecided")
    told = failed if bad else "no well has failed"
    last = overview["trajectories"][-1] if overview["trajectories"] else None
    if last is None or last["verdict"] or not last["keyframes"]:
        return told[0].upper() + told[1:]
    if is_drawing(last):
        return f"{_drawing(overview, last)}; {told}"
    given = last["keyframes"][-1]["kind"] == KeyframeKind.POST_DISPENSE.value
    return f"{'reading' if given else 'filling'} {short_name(last)}; {told}"


def _drawing(overview: RunOverview, last: DeliveryEntry) -> str:
    """For which well, as far as a rehearsal tells: the frame shows a source."""
    coming = still_planned(overview)
    planned = coming and last["keyframes"][-1].get("recovers") is None
    return f"drawing for {in_few_words(coming[0]['wells'])}" if planned else "drawing liquid"


def how_wells_stand(counts: Mapping[str, int]) -> str:
    """``"4 wells failed"``, ``"all 48 wells passed"``: the gravest first."""
    if not counts["wells"]:
        return "no well was filled"
    good = counts.get("pass", 0) + counts.get("calibration", 0)
    if good == counts["wells"]:
        return f"all {counted(good, 'well')} passed" if good > 1 else "the well passed"
    words = {
        "fail": "failed", "undecided": "undecided", "recovered": "put right",
        "unobserved": "not seen", "abandoned": "given up",
    }  # fmt: skip
    said = [f"{counts[state]} {word}" for state, word in words.items() if counts.get(state)]
    head, *rest = said or [f"{good} passed"]
    number, _, word = head.partition(" ")
    return ", ".join([f"{counted(int(number), 'well')} {word}", *rest])


def _text(overview: RunOverview, first: Situation | None) -> str:
    if first is not None:
        return first.text
    ended = overview.get("finished")
    return str(ended["detail"] or "") if ended else doing(overview)


def _left(overview: RunOverview) -> float | None:
    """By the usual time from one delivery to the next: pauses do not count."""
    shown = [t["keyframes"] for t in overview["trajectories"] if t["keyframes"]]
    ends = [float(keyframes[-1]["captured"]) for keyframes in shown]
    steps = [later - earlier for earlier, later in itertools.pairwise(ends)]
    left = len(still_planned(overview))
    if len(steps) < _LEAST_TIMED or not overview.get("planned"):
        return None
    return left * statistics.median(steps)
