"""A whole run in figures: counts, calibration, holds, time, costs. Plain values, as the JSON
report of a run holds them."""

from __future__ import annotations

import statistics
from collections.abc import Iterable, Sequence
from typing import Any

from .overview import DeliveryEntry, RunOverview, channels_of, last_keyframe, verdict_of, well_name
from .plates import PlateView, count_wells, plates_of, wells_of
from .states import state_of

FORMAT = "aegis-ot run report"
VERSION = 1

PAUSES = ("operator", "camera", "busy", "link")
"""Resolutions of holds that were pauses from the start."""

ALWAYS = ("run", "title", "protocol", "robot", "robot_name", "api_level", "package", "registered")


def run_account(overview: RunOverview) -> dict[str, Any]:
    """Everything about a run but its pictures.

    Returns:
        ``run``, ``protocol``, ``robot`` and the like; ``frames`` (``"simulated"`` or ``"real"``);
        ``finished``; ``counts`` of wells by state, ``wells`` in all, and of ``deliveries``: a row
        of eight tips is one delivery into eight wells; ``unobserved`` (wells whose tip the camera
        did not see);
        ``plates``; ``wells``; ``flagged`` (numbers of the
        deliveries that failed, are undecided, or that a person decided); ``calibration`` per
        liquid and pipette; ``holds``; ``decisions``; ``latency`` (s); ``costs``; ``incidents``;
        ``recoveries``; ``audit`` (the look back after the run, ``None`` before there was one);
        ``layer1``; ``guard`` and ``sidecar`` (settings and versions).
    """
    trajectories = overview["trajectories"]
    plates = plates_of(overview)
    unseen = _unobserved(trajectories)
    return {
        "format": FORMAT,
        "version": VERSION,
        **{name: overview.get(name, "") for name in ALWAYS},
        "frames": "simulated" if overview.get("simulated") else "real",
        "finished": overview.get("finished"),
        "counts": count_wells(plates, trajectories),
        "unobserved": unseen,
        "plates": [_plate(plate) for plate in plates],
        "wells": [_well(trajectory) for trajectory in trajectories],
        "flagged": [t["trajectory"] for t in trajectories if is_flagged(t)],
        "calibration": _calibration(trajectories),
        "holds": [hold | {"well": t["well"]} for t in trajectories for hold in t["holds"]],
        "decisions": sorted(
            _decisions(trajectories) + _actions(overview), key=lambda one: one["at"]
        ),
        "latency": _latency(trajectories),
        "costs": overview.get("costs"),
        "incidents": overview.get("incidents") or [],
        "recoveries": _recoveries(overview),
        "audit": overview.get("audit"),
        "layer1": overview.get("layer1"),
        "guard": overview.get("guard"),
        "sidecar": overview.get("sidecar"),
    }


def is_flagged(trajectory: DeliveryEntry) -> bool:
    """Whether a person should look at it: it failed, is undecided, or somebody changed it."""
    state = state_of(trajectory)
    return state in ("fail", "undecided", "recovered") or bool(trajectory["decisions"])


def _plate(plate: PlateView) -> dict[str, Any]:
    return {
        "labware": plate.key,
        "title": plate.title,
        "wells": {name: well.state for name, well in plate.wells.items()},
    }


def _well(trajectory: DeliveryEntry) -> dict[str, Any]:
    last, verdict = last_keyframe(trajectory), verdict_of(trajectory)
    said = ("outcome", "failure", "route", "gate", "score", "measured_ul", "expected_ul")
    return {
        "trajectory": trajectory["trajectory"],
        "well": trajectory["well"],
        "state": state_of(trajectory),
        "commanded_ul": last.get("commanded_ul"),
        "pipette": last.get("pipette"),
        "line": last.get("line"),
        **{name: verdict.get(name) for name in said},
        "reason": verdict.get("reason") or trajectory.get("unjudged"),
        # Of several tips it would be one's alone.
        "drawn_estimate_ul": None
        if verdict.get("channels")
        else trajectory["evidence"].get("drawn_ul"),
        "band": trajectory["evidence"].get("band"),
        "judged_first": (trajectory["judged"] or {}).get("outcome"),
        "abandoned": trajectory["abandoned"],
        "channels": [
            {**channel, "well": well_name(channel)} for channel in channels_of(trajectory)
        ],
    }


def _unobserved(trajectories: Iterable[DeliveryEntry]) -> list[str]:
    """Wells, each delivery counted, whose tip the camera did not see."""
    return [
        str(well_name(channel) or f"nozzle {channel['nozzle']}")
        for trajectory in trajectories
        for channel in channels_of(trajectory)
        if channel["outcome"] == "unobserved" and trajectory["abandoned"] is None
    ]


def _calibration(trajectories: Iterable[DeliveryEntry]) -> list[dict[str, Any]]:
    """Per liquid and pipette: which wells calibrated, and the band that the last well met."""
    streams: dict[tuple[str, ...], dict[str, Any]] = {}
    for trajectory in trajectories:
        evidence = trajectory["evidence"]
        stream = tuple(map(str, (evidence.get("calibration") or {}).get("stream") or ()))
        if not stream:
            continue
        known = streams.setdefault(stream, {"stream": list(stream), "wells": [], "band": None})
        calibrating = [well.well for _, well in wells_of(trajectory) if well.state == "calibration"]
        known["wells"] += [name for name in calibrating if name not in known["wells"]]
        known["band"] = evidence.get("band") or known["band"]
    return list(streams.values())


def _decisions(trajectories: Iterable[DeliveryEntry]) -> list[dict[str, Any]]:
    return [
        decision
        | {"trajectory": trajectory["trajectory"], "well": trajectory["well"], "action": None}
        for trajectory in trajectories
        for decision in trajectory["decisions"]
    ]


def _actions(overview: RunOverview) -> list[dict[str, Any]]:
    """What people told the robot from the page: resume, stop."""
    wells = {t["trajectory"]: t["well"] for t in overview["trajectories"]}
    return [
        action | {"well": wells.get(action["trajectory"], ""), "outcome": None}
        for action in overview.get("actions") or ()
    ]


def _recoveries(overview: RunOverview) -> list[dict[str, Any]]:
    """What the robot did by itself about failed deliveries, with the well of each."""
    wells = {t["trajectory"]: t["well"] for t in overview["trajectories"]}
    return [
        one | {"well": wells.get(one["trajectory"], "")} for one in overview.get("recoveries") or ()
    ]


def _latency(trajectories: Sequence[DeliveryEntry]) -> dict[str, Any]:
    """Where the time went, s: trigger to exposure, last frame to verdict, holds."""
    exposures = [k["exposed_after_s"] for t in trajectories for k in t["keyframes"]]
    verdicts = [
        t["judged_at"] - t["keyframes"][-1]["captured"]
        for t in trajectories
        if t["judged_at"] is not None and t["keyframes"]
    ]
    holds = [
        hold["seconds"]
        for t in trajectories
        for hold in t["holds"]
        if hold["resolution"] not in PAUSES  # which are nobody's delay
    ]
    return {
        "trigger_to_exposure_s": _spread(exposures),
        "last_frame_to_verdict_s": _spread(verdicts),
        "hold_s": _spread(holds) | {"sum": round(sum(holds), 3)},
    }


def _spread(values: Sequence[float]) -> dict[str, Any]:
    if not values:
        return {"count": 0, "median": None, "p95": None, "longest": None}
    ordered = sorted(values)
    place = min(len(ordered) - 1, round(0.95 * (len(ordered) - 1)))
    return {
        "count": len(ordered),
        "median": round(statistics.median(ordered), 4),
        "p95": round(ordered[place], 4),
        "longest": round(ordered[-1], 4),
    }
