"""What a run asks of a person at this moment, and what its robot does."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..vocabulary import KeyframeKind

_HOLD_SHOWN_S = 1.0
"""A hold shorter than this is the usual wait for a verdict."""

_SILENT_S = 600.0
"""A robot that said nothing for so long may be off; a long incubation is the other reason."""

_DOES = {
    KeyframeKind.ASPIRATE: "drawing",
    KeyframeKind.TRANSIT: "carrying",
    KeyframeKind.DISPENSE: "dispensing",
    KeyframeKind.POST_DISPENSE: "has delivered",
}


_BREAKS = (
    "What it does next was not rehearsed, and breaks a rule; the run log has the finding. Resume "
    "to do it all the same, or stop the run."
)
_UNSERVED = {
    "camera": (
        "no frame",
        "Of its next step no frame was taken: see the camera, or the store.",
    ),
    "busy": ("it is not served", "The sidecar has too much else to do."),
    "link": ("it had no link", "The robot did not reach the sidecar."),
}
"""Why a robot paused by itself that the sidecar did not serve."""
_THEN_UNWATCHED = "When it is resumed it tries again; if that fails, the run goes on unwatched."


@dataclass(frozen=True)
class Situation:
    """Something that a person should see at once.

    Attributes:
        kind: ``"paused"``, ``"ordered"``, ``"question"``, ``"holding"``, ``"camera"``, ``"store"``,
            ``"unrecorded"``, ``"notification"`` or ``"silent"``.
        title: In a few words.
        text: What was seen.
        trajectory: The delivery that it is about; ``None`` for trouble.
        well: Of that delivery.
        left_s: Time until the robot acts by itself, s; ``None`` if it waits for ever.
        then: What it does then.
        judged: Whether there is a verdict, so that it can be confirmed or corrected.
    """

    kind: str
    title: str
    text: str
    trajectory: int | None = None
    well: str = ""
    left_s: float | None = None
    then: str = ""
    judged: bool = False

    @property
    def asks(self) -> bool:
        """Whether a person has to answer."""
        return self.kind in ("paused", "question")


def situations(overview: Mapping[str, Any], now: float) -> list[Situation]:
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
                "silent",
                f"The robot has said nothing for {silent / 60:.0f} min",
                "It may wait or incubate as its protocol says; else see whether it is on.",
            )
        )
    return found


def _unrecorded(overview: Mapping[str, Any]) -> Iterator[Situation]:
    """What people said counts, but the store has no room for it."""
    told = overview.get("unrecorded") or ()
    if told:
        what = ", ".join(f"{one['by']}: {one.get('action') or one['outcome']}" for one in told[-5:])
        yield Situation(
            "unrecorded",
            "Not yet on record",
            f"{what}. It counts already; the workstation's disk takes nothing now, and it is "
            "written down as soon as there is room. Do not switch the workstation off before.",
        )


def doing(overview: Mapping[str, Any]) -> str:
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
        more = f" and {len(wells) - 1} more" if len(wells) > 1 else ""
        text += f" {where} {place(wells[0])}{more}"
    line = f", line {last['line']}" if last.get("line") else ""
    return f"{text}{line} ({last['mount']} {last['pipette']})"


def last_word(overview: Mapping[str, Any]) -> float:
    """When the robot was last heard of, seconds since the epoch."""
    moments = [float(overview.get("registered") or 0.0)]
    moments += [k["captured"] for t in overview["trajectories"] for k in t["keyframes"]]
    moments += [hold["at"] for t in overview["trajectories"] for hold in t["holds"]]
    return max(moments)


def place(well: Mapping[str, Any]) -> str:
    """``"B3 of plate in slot 4"``."""
    labware = well["label"] or well["labware"]
    slot = f" in slot {well['slot']}" if well["slot"] else ""
    return f"{well['name']} of {labware}{slot}"


def _last_keyframe(overview: Mapping[str, Any]) -> Mapping[str, Any] | None:
    keyframes = [k for t in overview["trajectories"] for k in t["keyframes"]]
    return max(keyframes, key=lambda k: k["sequence"], default=None)


def _paused(overview: Mapping[str, Any]) -> Iterator[Situation]:
    """The robot told of a hold that ends in a pause, and has gone on with nothing since."""
    keyframes = [k for t in overview["trajectories"] for k in t["keyframes"]]
    moved = max((float(k["captured"]) for k in keyframes), default=0.0)
    for trajectory, hold in _last_holds(overview):
        if hold["policy"] != "pause" or hold["paused_s"] is not None:
            continue
        if hold["at"] < moved and overview.get("mode") != "watch":
            continue  # it moves; a watched robot ends its move first, and says when it goes on
        told = _told(overview, trajectory["trajectory"], hold["at"])
        where = trajectory["trajectory"], trajectory["well"]
        if hold["resolution"] == "operator":
            who = _who_paused(overview)
            text = f"{who} paused it from this page.{told}"
            yield Situation("paused", "The robot is paused", text, *where)
            continue
        if hold["resolution"] == "layer1":
            yield Situation("paused", "The robot is paused by Layer 1", f"{_BREAKS}{told}", *where)
            continue
        if hold["resolution"] in _UNSERVED:
            what, text = _UNSERVED[hold["resolution"]]
            text = f"{text} {_THEN_UNWATCHED}{told}"
            yield Situation("paused", f"The robot is paused: {what}", text, *where)
            continue
        verdict = trajectory["verdict"] or {}
        failure = str(verdict.get("failure") or "").replace("_", " ")
        outcome = str(verdict.get("outcome") or "no verdict")
        what = failure or {"pass": "passed", "fail": "failed"}.get(outcome, outcome)
        reason = verdict.get("reason") or f"No verdict: {hold['resolution']}."
        yield Situation(
            "paused",
            f"The robot is paused: {what}",
            f"{reason}{told}",
            *where,
            judged=bool(verdict),
        )


def _last_holds(overview: Mapping[str, Any]) -> Iterator[tuple[Mapping[str, Any], dict[str, Any]]]:
    """Each trajectory that was held for, and its last hold."""
    for trajectory in overview["trajectories"]:
        if trajectory["holds"]:
            yield trajectory, trajectory["holds"][-1]


def _told(overview: Mapping[str, Any], trajectory: int, paused_at: float) -> str:
    """What a person has told the paused robot already."""
    for action in reversed(overview.get("actions") or ()):
        stop = action["action"] == "stop"  # it holds for every pause
        if not stop and (action["action"] == "pause" or action["at"] < paused_at):
            return ""
        if stop or action["trajectory"] == trajectory:
            word = {"resume": "go on", "stop": "end the run"}[action["action"]]
            return f" {action['by']} told the robot to {word}; it has not answered yet."
    return ""


def _who_paused(overview: Mapping[str, Any]) -> str:
    actions = reversed(overview.get("actions") or ())
    return next((str(one["by"]) for one in actions if one["action"] == "pause"), "Somebody")


def _ordered(overview: Mapping[str, Any]) -> Iterator[Situation]:
    """What a person told the robot while it moved, until it does it."""
    order = overview.get("order")
    if order:
        what = {"pause": "pause", "stop": "end the run"}[order["action"]]
        text = "It does so at its next step of a delivery or in a hold, its own screen at once."
        yield Situation("ordered", f"{order['by']} told the robot to {what}", text)


def _questions(
    overview: Mapping[str, Any], trajectories: Sequence[Mapping[str, Any]]
) -> Iterator[Situation]:
    policy = (overview.get("guard") or {}).get("on_undecided") or ""
    for trajectory in trajectories:
        if trajectory.get("awaiting") != "operator":
            continue
        verdict = trajectory["judged"] or {}
        yield Situation(
            "question",
            "Your decision is needed",
            str(verdict.get("reason") or "No gate could settle this well."),
            trajectory["trajectory"],
            trajectory["well"],
            trajectory.get("awaiting_s"),
            _policy_words(policy) or "the robot is told that it is undecided",
            judged=True,
        )


def _holding(
    overview: Mapping[str, Any], trajectories: Sequence[Mapping[str, Any]]
) -> Iterator[Situation]:
    guard = overview.get("guard") or {}
    for trajectory in trajectories:
        held = trajectory.get("held_for_s")
        if held is None or held < _HOLD_SHOWN_S or trajectory["verdict"]:
            continue
        if trajectory.get("awaiting") == "operator":
            continue
        most = guard.get("verdict_timeout_s")
        yield Situation(
            "holding",
            "The robot holds for a verdict",
            "It touches no further well until this one is judged.",
            trajectory["trajectory"],
            trajectory["well"],
            None if most is None else max(0.0, most - held),
            _policy_words(guard.get("on_link_loss") or ""),
        )


def _trouble(incident: Mapping[str, Any]) -> Situation:
    titles = {
        "camera": "The camera is in trouble",
        "store": "The store is in trouble",
        "model": "The vision model does not answer",
        "hold": "A hold ended without a verdict",
        "layer1": "The run is not as rehearsed",
    }
    title = titles.get(incident["kind"], f"Trouble: {incident['kind']}")
    return Situation(incident["kind"], title, incident["text"])


def _policy_words(policy: str) -> str:
    return {
        "pause": "the robot pauses",
        "abort": "the robot ends the run",
        "continue": "the robot goes on",
    }.get(policy, "")
