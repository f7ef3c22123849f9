"""What a run asks of a person at this moment, and what its robot does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from pydantic import BaseModel, ConfigDict

from ..vocabulary import KeyframeKind, in_few_words
from .answers import RECOVERY, Answer, answers_to_pause, answers_to_question
from .overview import (
    DeliveryEntry,
    HoldEntry,
    IncidentEntry,
    KeyframeEntry,
    RunOverview,
    VerdictEntry,
    WellEntry,
    verdict_of,
)
from .plates import short_name
from .states import failure_in_words

HOLD_SHOWN_S = 3.0
"""A hold shorter than this is the usual wait for a verdict."""

_SILENT_S = 600.0
"""A robot that said nothing for so long may be off; a long incubation is the other reason."""

_DOES = {
    KeyframeKind.ASPIRATE: "drawing",
    KeyframeKind.TRANSIT: "carrying",
    KeyframeKind.DISPENSE: "dispensing",
    KeyframeKind.POST_DISPENSE: "has delivered",
}


_BREAKS = "What it does next was not rehearsed, and breaks a rule; the run log has the finding."
_UNSERVED = {
    "camera": (
        "The camera gave no frame",
        "Of its next step no frame was taken: see the camera, or the store.",
    ),
    "busy": ("The sidecar is too busy", "The sidecar has too much else to do."),
    "link": ("The robot had no link", "The robot did not reach the sidecar."),
}
"""Why a robot paused by itself that the sidecar did not serve."""
_TELLS = {"resume": "continue", "retry": "try that step again", "stop": "stop the run"}
_RECOVER = "The robot waits: put it right, then say here how it goes on, or recover it in the App."
_THEN_UNWATCHED = "It stands still until somebody answers."


class Situation(BaseModel):
    """Something that a person should see at once.

    Attributes:
        kind: ``"paused"``, ``"ordered"``, ``"question"``, ``"holding"``, ``"camera"``, ``"store"``,
            ``"unrecorded"``, ``"notification"`` or ``"silent"``.
        title: In a few words.
        text: What was seen.
        trajectory: The delivery that it is about; ``None`` for trouble.
        well: Of that delivery, in short: ``"C2"``.
        since: When it began, seconds since the epoch; ``None`` where it does not matter.
        left_s: Time until the robot acts by itself, s; ``None`` if it waits for ever.
        then: What it does then.
        judged: Whether there is a verdict, so that it can be confirmed or corrected.
        answers: What a person can say; none where nobody is asked, or somebody has answered.
        answered: Who has answered, and what.
    """

    model_config = ConfigDict(frozen=True)

    kind: str
    title: str
    text: str
    trajectory: int | None = None
    well: str = ""
    since: float | None = None
    left_s: float | None = None
    then: str = ""
    judged: bool = False
    answers: tuple[Answer, ...] = ()
    answered: str = ""

    @property
    def asks(self) -> bool:
        """Whether a person has to answer."""
        return bool(self.answers)


def situations(overview: RunOverview, now: float) -> list[Situation]:
    """What a person should see of a run, the most pressing first; nothing once it has ended.

    Args:
        overview: Answer of ``GET /v1/runs/{run}``.
        now: Seconds since the epoch.
    """
    if overview.get("finished"):
        return []
    trajectories = overview["trajectories"]
    paused = list(_paused(overview))  # such a banner says itself what was told
    found = [*paused, *([] if paused else _ordered(overview)), *_questions(overview, trajectories)]
    found += _holding(overview, trajectories)
    for incident in overview.get("incidents") or ():
        if incident["ended"] is None:
            found.append(_trouble(incident))
    found += _unrecorded(overview)
    silent = now - last_word(overview)
    if not found and silent > _SILENT_S:
        found.append(
            Situation(
                kind="silent",
                title=f"The robot has said nothing for {silent / 60:.0f} min",
                text="It may wait or incubate as its protocol says; else see whether it is on.",
            )
        )
    return found


def _unrecorded(overview: RunOverview) -> Iterator[Situation]:
    """What people said counts, but the store has no room for it."""
    told = overview.get("unrecorded") or ()
    if told:
        what = ", ".join(f"{one['by']}: {one.get('action') or one['outcome']}" for one in told[-5:])
        yield Situation(
            kind="unrecorded",
            title="Not yet on record",
            text=f"{what}. It counts already; the workstation's disk takes nothing now, and it is "
            "written down as soon as there is room. Do not switch the workstation off before.",
        )


def doing(overview: RunOverview) -> str:
    """What the robot did last, in one line: ``"dispensing 100 µL into B3 of plate in slot 4"``."""
    last = _last_keyframe(overview)
    if last is None:
        return "No delivery has been seen yet."
    kind = KeyframeKind(last["kind"])
    wells = last["sources"] if kind is KeyframeKind.ASPIRATE else last["destinations"]
    wells = wells or last["sources"] or last["destinations"]
    where = {KeyframeKind.ASPIRATE: "from", KeyframeKind.TRANSIT: "to"}.get(kind, "into")
    liquid = f" of {last['reagent']}" if last.get("reagent") else ""
    text = f"{_DOES[kind]} {float(last['commanded_ul']):g} µL{liquid}"
    if wells:
        words = in_few_words(str(well["name"]) for well in wells)
        text += f" {where} {words}{place(wells[0]).removeprefix(str(wells[0]['name']))}"
    line = f", line {last['line']}" if last.get("line") else ""
    return f"{text}{line} ({last['mount']} {last['pipette']})"


def last_word(overview: RunOverview) -> float:
    """When the robot was last heard of, seconds since the epoch."""
    moments = [float(overview.get("registered") or 0.0)]
    moments += [k["captured"] for t in overview["trajectories"] for k in t["keyframes"]]
    moments += [hold["at"] for t in overview["trajectories"] for hold in t["holds"]]
    return max(moments)


def place(well: WellEntry) -> str:
    """``"B3 of plate in slot 4"``."""
    labware = well["label"] or well["labware"]
    slot = f" in slot {well['slot']}" if well["slot"] else ""
    return f"{well['name']} of {labware}{slot}"


def _last_keyframe(overview: RunOverview) -> KeyframeEntry | None:
    keyframes = [k for t in overview["trajectories"] for k in t["keyframes"]]
    return max(keyframes, key=lambda k: k["sequence"], default=None)


def _paused(overview: RunOverview) -> Iterator[Situation]:
    """The robot told of a hold that ends in a pause, and has gone on with nothing since."""
    keyframes = [k for t in overview["trajectories"] for k in t["keyframes"]]
    moved = max((float(k["captured"]) for k in keyframes), default=0.0)
    for trajectory, hold in _last_holds(overview):
        if hold["policy"] != "pause" or hold["paused_s"] is not None:
            continue
        if hold["at"] < moved and overview.get("mode") != "watch":
            continue  # it moves; a watched robot ends its move first, and says when it goes on
        well = short_name(trajectory)
        title, text, outcome = _why_paused(overview, hold, well, trajectory)
        answered = _told(overview, trajectory["trajectory"], hold["at"])
        yield Situation(
            kind="paused",
            title=title,
            text=text,
            trajectory=trajectory["trajectory"],
            well=well,
            since=hold["at"],
            judged=bool(outcome),
            answers=() if answered else answers_to_pause(overview, hold, well, outcome),
            answered=answered,
        )


def _why_paused(
    overview: RunOverview, hold: HoldEntry, well: str, trajectory: DeliveryEntry
) -> tuple[str, str, str]:
    """Title, text, and the verdict that is in question, ``""`` if it is about none."""
    if hold["resolution"] == "operator":
        return f"{_who_paused(overview)} paused the robot", "It was told so on this page.", ""
    if hold["resolution"] == "layer1":
        return "The next step breaks a rule", _BREAKS, ""
    if hold["resolution"] == RECOVERY:
        said = hold.get("next")
        return "A step failed", f"{said}. {_RECOVER}" if said else _RECOVER, ""
    if hold["resolution"] in _UNSERVED:
        title, text = _UNSERVED[hold["resolution"]]
        return f"{title} at {well}", f"{text} {_THEN_UNWATCHED}", ""
    verdict, failure = verdict_of(trajectory), failure_in_words(trajectory)
    outcome = str(verdict.get("outcome") or "")
    words = {"pass": "passed", "fail": "failed", "undecided": "could not be judged"}
    what = f"{well} {words.get(outcome, 'has no verdict')}"
    reason = verdict.get("reason") or f"No verdict: {hold['resolution']}."
    return what + (f": {failure}" if failure else ""), str(reason), outcome


def _last_holds(overview: RunOverview) -> Iterator[tuple[DeliveryEntry, HoldEntry]]:
    """Each trajectory that was held for, and its last hold."""
    for trajectory in overview["trajectories"]:
        if trajectory["holds"]:
            yield trajectory, trajectory["holds"][-1]


def _told(overview: RunOverview, trajectory: int, paused_at: float) -> str:
    """What a person has told the paused robot already."""
    for action in reversed(overview.get("actions") or ()):
        stop = action["action"] == "stop"  # it holds for every pause
        if not stop and (action["action"] == "pause" or action["at"] < paused_at):
            return ""
        if stop or action["trajectory"] == trajectory:
            word = _TELLS[action["action"]]
            return f"{action['by']} answered: {word}. The robot has not moved yet."
    return ""


def _who_paused(overview: RunOverview) -> str:
    actions = reversed(overview.get("actions") or ())
    return next((str(one["by"]) for one in actions if one["action"] == "pause"), "Somebody")


def _ordered(overview: RunOverview) -> Iterator[Situation]:
    """What a person told the robot while it moved, until it does it."""
    order = overview.get("order")
    if order:
        what = {"pause": "pause", "stop": "end the run"}[order["action"]]
        yield Situation(
            kind="ordered",
            title=f"{order['by']} told the robot to {what}",
            text="It does so at its next step of a delivery or in a hold, its own screen at once.",
        )


def _questions(overview: RunOverview, trajectories: Sequence[DeliveryEntry]) -> Iterator[Situation]:
    guard = overview.get("guard") or {}
    for trajectory in trajectories:
        if trajectory.get("awaiting") != "operator":
            continue
        verdict: VerdictEntry = trajectory["judged"] or {}
        well = short_name(trajectory)
        policy = _policy_words(guard.get("on_undecided") or "")
        yield Situation(
            kind="question",
            title=f"Is {well} right?",
            text=str(verdict.get("reason") or "No check could settle this well."),
            trajectory=trajectory["trajectory"],
            well=well,
            left_s=trajectory.get("awaiting_s"),
            then=policy or "the robot is told that it is undecided",
            judged=True,
            answers=answers_to_question(overview, well, _policy_words(guard.get("on_fail") or "")),
        )


def _holding(overview: RunOverview, trajectories: Sequence[DeliveryEntry]) -> Iterator[Situation]:
    guard = overview.get("guard") or {}
    for trajectory in trajectories:
        held = trajectory.get("held_for_s")
        if held is None or held < HOLD_SHOWN_S or trajectory["verdict"]:
            continue
        if trajectory.get("awaiting") == "operator":
            continue
        most = guard.get("verdict_timeout_s")
        well = short_name(trajectory)
        yield Situation(
            kind="holding",
            title=f"for the camera to judge {well}",
            text="Nothing for you to do: then the robot goes on.",
            trajectory=trajectory["trajectory"],
            well=well,
            left_s=None if most is None else max(0.0, most - held),
            then=_policy_words(guard.get("on_link_loss") or ""),
        )


def _trouble(incident: IncidentEntry) -> Situation:
    titles = {
        "camera": "The camera is in trouble",
        "store": "The store is in trouble",
        "model": "The vision model does not answer",
        "hold": "A hold ended without a verdict",
        "layer1": "The run is not as rehearsed",
    }
    title = titles.get(incident["kind"], f"Trouble: {incident['kind']}")
    return Situation(kind=incident["kind"], title=title, text=incident["text"])


def _policy_words(policy: str) -> str:
    return {
        "pause": "the robot pauses",
        "abort": "the robot ends the run",
        "continue": "the robot goes on",
    }.get(policy, "")
