"""Overviews of runs, as the sidecar gives them."""

from __future__ import annotations

from typing import Any

from aegis_ot.vocabulary import KeyframeKind, to_json
from tests.sidecar.helpers import make_keyframe


def delivery(number: int, outcome: str | None = "pass", **changes: Any) -> dict[str, Any]:
    """One delivery with its four keyframes, captured at 100, 101, 102, 103 s."""
    keyframes = [
        to_json(make_keyframe("run", 4 * number + moment))
        | {"captured": 100.0 + moment, "exposed_after_s": 0.02, "frame": f"/f/{moment}.jpg"}
        for moment in range(len(KeyframeKind))
    ]
    verdict = None
    if outcome is not None:
        verdict = {
            "run": "run",
            "trajectory": number,
            "outcome": outcome,
            "route": "grey_zone",
            "gate": "volumetric",
            "score": 2.0,
            "failure": "partial_dispense" if outcome == "fail" else None,
            "reason": "About 52 µL are left.",
            "measured_ul": None,
            "expected_ul": None,
        }
    return {
        "trajectory": number,
        "well": f"{keyframes[-1]['destinations'][0]['name']} of plate (slot 4)",
        "keyframes": keyframes,
        "verdict": verdict,
        "judged": verdict,
        "judged_at": None if verdict is None else 103.2,
        "evidence": {"band": [0.0, 3.0]},
        "decisions": [],
        "holds": [],
        "abandoned": None,
        "awaiting": None,
        "awaiting_s": None,
        "held_for_s": None,
    } | changes


def row(number: int, told: str, **changes: Any) -> dict[str, Any]:
    """One delivery of eight tips: what became of each, as ``"..F?uu.."``, into one column."""
    words = {".": "pass", "F": "fail", "?": "undecided", "u": "unobserved"}
    gravest = next((words[sign] for sign in "F?" if sign in told), "pass")
    entry = delivery(number, gravest, **changes)
    first = entry["keyframes"][-1]["destinations"][0]
    wells = [first | {"name": f"{letter}{number + 1}"} for letter in "ABCDEFGH"]
    for keyframe in entry["keyframes"]:
        keyframe["destinations"] = wells
    entry["verdict"]["channels"] = [
        {
            "nozzle": f"{letter}1",
            "well": well,
            "outcome": words[sign],
            "failure": "no_dispense" if sign == "F" else None,
            "reason": "",
            "measured_ul": None,
            "expected_ul": None,
        }
        for letter, well, sign in zip("ABCDEFGH", wells, told, strict=True)
    ]
    return entry


def overview(*deliveries: dict[str, Any], **changes: Any) -> dict[str, Any]:
    """A run of these deliveries."""
    return {
        "run": "run",
        "protocol": "plate.py",
        "robot": "OT-2",
        "robot_name": "lab-3",
        "api_level": "2.15",
        "package": "0.1",
        "simulated": True,
        "registered": 90.0,
        "finished": None,
        "guard": {"on_undecided": "pause", "on_link_loss": "pause", "verdict_timeout_s": 60.0},
        "layer1": None,
        "sidecar": None,
        "actions": [],
        "incidents": [],
        "trajectories": list(deliveries),
    } | changes


def hold(number: int, at: float = 104.0, policy: str | None = "pause", **changes: Any) -> Any:
    """A hold that ended with the verdict."""
    return {
        "number": number,
        "trajectory": number,
        "seconds": 0.3,
        "resolution": "verdict",
        "policy": policy,
        "paused_s": None,
        "answered": None,
        "at": at,
    } | changes
