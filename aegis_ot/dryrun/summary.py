"""What came of a dry run, well by well."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ..vocabulary import FailureType, Gate, KeyframeKind, Outcome, Route
from .closeups import close_up


@dataclass(frozen=True)
class WellRow:
    """One watched well.

    Attributes:
        trajectory: Number of the trajectory in the run.
        well: Where the liquid went, for people.
        address: The same in short, ``"3:D4"``.
        pipette: Opentrons pipette name.
        volume_ul: Commanded, µL per channel.
        score: Anomaly score; ``None`` without frames.
        route: Where triage sent it.
        gate: Who settled it.
        outcome: The verdict; ``None`` if the run ended before it was in.
        failure: What went wrong, for a fail.
        reason: One sentence.
        hold_s: How long the robot held for it, s.
        frames: JPEG of each keyframe, by kind.
        close_ups: JPEG of the tip in it, for flagged wells and where a tip was found.
        measured_ul: Left in the tip after the dispense as measured, µL.
        line: Source line of the protocol.
    """

    trajectory: int
    well: str
    address: str
    pipette: str
    volume_ul: float
    score: float | None
    route: Route | None
    gate: Gate
    outcome: Outcome | None
    failure: FailureType | None
    reason: str
    hold_s: float
    frames: Mapping[KeyframeKind, bytes]
    measured_ul: float | None = None
    line: int | None = None
    close_ups: Mapping[KeyframeKind, bytes] = field(default_factory=dict)

    @property
    def flagged(self) -> bool:
        """Whether it failed or could not be settled."""
        return self.outcome in (Outcome.FAIL, Outcome.UNDECIDED)


@dataclass(frozen=True)
class DryRun:
    """A finished dry run.

    Attributes:
        protocol: File name.
        report: Layer 1's report, ``None`` if it was turned off.
        wells: Every watched well, in order.
        outcome: ``"succeeded"``, ``"stopped"`` (by the guard), ``"rejected"`` (by Layer 1) or
            ``"failed"`` (the protocol raised).
        detail: Why it did not succeed.
        touched_after_failure: Wells that the failed tip entered after the first fail.
        seconds: Wall time of the simulated run, s.
    """

    protocol: str
    report: Any
    wells: tuple[WellRow, ...]
    outcome: str
    detail: str = ""
    touched_after_failure: tuple[str, ...] = ()
    seconds: float = 0.0

    @property
    def flagged(self) -> tuple[WellRow, ...]:
        """The wells that failed or could not be settled."""
        return tuple(row for row in self.wells if row.flagged)


def rows_of(overview: Mapping[str, Any], frames: Mapping[int, bytes]) -> tuple[WellRow, ...]:
    """Turn the sidecar's account of a run into rows.

    Args:
        overview: Answer of ``GET /v1/runs/{run}``.
        frames: JPEG by sequence number.
    """
    return tuple(
        _row(entry, frames) for entry in overview["trajectories"] if entry["abandoned"] is None
    )


def _address(keyframe: Mapping[str, Any]) -> str:
    wells = keyframe.get("destinations") or keyframe.get("sources") or ()
    if not wells:
        return "-"
    more = f" +{len(wells) - 1}" if len(wells) > 1 else ""
    return f"{wells[0]['slot']}:{wells[0]['name']}{more}"


def _row(entry: Mapping[str, Any], frames: Mapping[int, bytes]) -> WellRow:
    verdict = entry["verdict"] or {}
    last = entry["keyframes"][-1] if entry["keyframes"] else {}
    images = {
        KeyframeKind(keyframe["kind"]): frames[keyframe["sequence"]]
        for keyframe in entry["keyframes"]
        if keyframe["sequence"] in frames
    }
    outcome = Outcome(verdict["outcome"]) if verdict else None
    boxes = entry["evidence"].get("boxes", {}) if outcome is not Outcome.PASS else {}
    close_ups = {
        kind: cut
        for kind, image in images.items()
        if kind.value in boxes and (cut := close_up(image, boxes[kind.value])) is not None
    }
    return WellRow(
        trajectory=entry["trajectory"],
        well=entry["well"],
        address=_address(last),
        pipette=last.get("pipette", ""),
        volume_ul=last.get("commanded_ul", 0.0),
        score=verdict.get("score"),
        route=Route(verdict["route"]) if verdict else None,
        gate=Gate(verdict.get("gate", "none")),
        outcome=outcome,
        failure=FailureType(verdict["failure"]) if verdict.get("failure") else None,
        reason=verdict.get("reason", ""),
        hold_s=float((entry["hold"] or {}).get("seconds", 0.0)),
        frames=images,
        close_ups=close_ups,
        measured_ul=verdict.get("measured_ul"),
        line=last.get("line"),
    )
