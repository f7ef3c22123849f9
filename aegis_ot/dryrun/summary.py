"""What came of a dry run, well by well."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..reports.run_html import ReportedRun
from ..run_view import state_of
from ..run_view.overview import (
    DeliveryEntry,
    KeyframeEntry,
    RunOverview,
    channels_of,
    last_keyframe,
    verdict_of,
    well_name,
)
from ..vocabulary import FailureType, Gate, Outcome, Route, WellRef, from_json, in_few_words

if TYPE_CHECKING:
    from ..adapters.opentrons.rehearsal import Recording


@dataclass(frozen=True)
class WellRow:
    """One watched well.

    Attributes:
        trajectory: Number of the trajectory in the run.
        well: Where the liquid went, for people.
        address: The same in short, ``"3:D4"``.
        wells: All that the delivery went into, each as the robot names it.
        refs: The same, for programs.
        pipette: Opentrons pipette name.
        volume_ul: Commanded, µL per channel.
        score: Anomaly score; ``None`` without frames.
        limit: Score up to which it could pass silently; ``None`` before the run is calibrated.
        recovered: Whether it failed, and the robot put the well right.
        unobserved: Whether the camera saw none of its tips: neither passed nor failed.
        p_value: How often a normal well of this run looks this unusual.
        route: Where triage sent it.
        gate: Who settled it.
        outcome: The verdict; ``None`` if the run ended before it was in.
        failure: What went wrong, for a fail.
        reason: One sentence.
        hold_s: How long the robot held for it, s.
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
    measured_ul: float | None = None
    line: int | None = None
    limit: float | None = None
    p_value: float | None = None
    recovered: bool = False
    unobserved: bool = False
    wells: tuple[str, ...] = ()
    refs: tuple[WellRef, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether it was seen, and passed."""
        return self.outcome is Outcome.PASS and not self.unobserved

    @property
    def flagged(self) -> bool:
        """Whether it failed, and was not put right, or could not be settled, or has no verdict."""
        return self.outcome is not Outcome.PASS and not self.recovered


@dataclass(frozen=True)
class DryRun:
    """A finished dry run.

    Attributes:
        protocol: File name.
        report: Layer 1's report, ``None`` if it was turned off.
        reported: What its report shows.
        wells: Every watched well, in order.
        outcome: ``"succeeded"``, ``"stopped"`` (by the guard), ``"rejected"`` (by Layer 1) or
            ``"failed"`` (the protocol raised).
        detail: Why it did not succeed.
        touched_after_failure: Wells that the failed tip entered after the first fail.
        seconds: Wall time of the simulated run, s.
        notes: What a person should know of it, in sentences.
        recording: Of its rehearsal.
    """

    protocol: str
    report: Any
    reported: ReportedRun
    wells: tuple[WellRow, ...]
    outcome: str
    detail: str = ""
    touched_after_failure: tuple[str, ...] = ()
    seconds: float = 0.0
    notes: tuple[str, ...] = ()
    recording: Recording | None = None

    @property
    def flagged(self) -> tuple[WellRow, ...]:
        """The wells that failed or could not be settled."""
        return tuple(row for row in self.wells if row.flagged)


_ASKED = Outcome.UNDECIDED.value, Route.CALIBRATION.value

_UNANSWERED = (
    "Here nobody could answer, so its wells stay undecided; --first-wells trust takes them for "
    "right."
)


def unproven(overview: RunOverview, trusted: bool) -> Iterator[str]:
    """Of which liquids nothing was seen to leave a tip, though wells of it passed on trust, or wait
    for an answer that nobody is there to give. Where first wells are trusted, what stays open does
    so for another reason."""
    plain: dict[tuple[str, str], bool] = {}
    waiting: set[tuple[str, str]] = set()
    for entry in overview["trajectories"]:
        known, verdict = entry["evidence"].get("calibration"), verdict_of(entry)
        if not known:
            continue
        key = str(known["stream"][2] or "the liquid"), str(known["stream"][0])
        if verdict.get("outcome") == Outcome.PASS.value:
            plain[key] = plain.get(key, False) or known.get("strength") is not None
        elif not trusted and (verdict.get("outcome"), verdict.get("route")) == _ASKED:
            plain.setdefault(key, False)
            waiting.add(key)
    for key, shown in plain.items():
        if not shown:
            liquid, pipette = key
            yield (
                f"In no well was {liquid} seen to leave the tip of the {pipette}: none may have "
                "been drawn or dispensed, or it is too clear or the tip too small for this view. "
                "On a robot you are asked about the first well. "
                + (_UNANSWERED if key in waiting else "Here its first wells were taken for right.")
            )


def rows_of(overview: RunOverview) -> tuple[WellRow, ...]:
    """Turn the sidecar's overview of a run into rows."""
    return tuple(_row(entry) for entry in overview["trajectories"] if entry["abandoned"] is None)


def _wells(keyframe: KeyframeEntry) -> list[WellRef]:
    wells = keyframe.get("destinations") or keyframe.get("sources") or ()
    return [from_json(WellRef, well) for well in wells]


def _address(wells: Sequence[WellRef], entry: DeliveryEntry) -> str:
    """Of a row of tips the wells that its verdict is about."""
    outcome = verdict_of(entry).get("outcome")
    about = [
        well_name(one)
        for one in channels_of(entry)
        if one["outcome"] == outcome != Outcome.PASS.value
    ]
    named = [well for well in wells if well.name in about] or wells
    words = in_few_words(well.name for well in named)
    return words.replace(named[0].name, named[0].address, 1) if named else "-"


def _row(entry: DeliveryEntry) -> WellRow:
    verdict, last = verdict_of(entry), last_keyframe(entry)
    wells = _wells(last)
    outcome = Outcome(verdict["outcome"]) if verdict else None
    if outcome is None and entry.get("unjudged"):
        outcome = Outcome.UNDECIDED
    return WellRow(
        trajectory=entry["trajectory"],
        well=entry["well"],
        address=_address(wells, entry),
        pipette=last.get("pipette", ""),
        volume_ul=last.get("commanded_ul", 0.0),
        score=verdict.get("score"),
        route=Route(verdict["route"]) if verdict else None,
        gate=Gate(verdict.get("gate", "none")),
        outcome=outcome,
        failure=FailureType(verdict["failure"]) if verdict.get("failure") else None,
        reason=verdict.get("reason") or entry.get("unjudged") or "",
        hold_s=sum(hold["seconds"] for hold in entry["holds"]),
        measured_ul=verdict.get("measured_ul"),
        line=last.get("line"),
        limit=(entry["evidence"].get("band") or (None, None))[1],
        p_value=entry["evidence"].get("p_value"),
        recovered=bool(entry.get("recovered")),
        unobserved=state_of(entry) == "unobserved",
        wells=tuple(map(str, wells)),
        refs=tuple(wells),
    )
