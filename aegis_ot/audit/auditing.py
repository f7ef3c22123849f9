"""The audit of one run: every well read again with all that the run tells, and ranked."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

from ..progress import Progress
from ..sidecar.store import Store
from ..vision.gates import ConfirmingGate, GateInput
from ..vision.scorers.ensemble import EnsembleScorer
from ..vision.types import Detector, TrajectorySample
from ..vocabulary import Outcome, Route, counted
from .measures import Measures, measure
from .patterns import drifts, no_liquid
from .reasons import SPEAKS, drift_words, liquid_words, neighbour_words, no_liquid_words, reasons
from .result import Audit, Suspect
from .surprise import WellStanding, standings
from .wells import RunWell, by_liquid, run_wells

STANDS_OUT = 8.0
"""Score from which a person should look, nats, if more than one sign speaks. On simulated
development runs one run in ten without a fault had a well of such a score, each for one sign in one
frame; faults spoke by two at least."""

_CONTRADICTED = 6.0
"""What a contradiction of the volumetric gate counts, nats."""

_GRAVE = 15.0
"""Score of no liquid in any well: it concerns them all."""

_FEW = 4
"""Wells of a liquid that are too few to be compared with each other."""

_FAILED, _PASSED = 6.0, -2.0
"""What a vision model's word counts, nats: one voice alone."""


@dataclass(frozen=True)
class _Ranked:
    """A suspect, and what a vision model is shown of it."""

    suspect: Suspect
    well: RunWell
    normal: TrajectorySample | None


def audit_run(
    store: Store,
    run: str,
    detector: Detector,
    scorer: EnsembleScorer,
    model: ConfirmingGate | None = None,
    progress: Progress | None = None,
) -> Audit:
    """Read every well of a finished run again and rank its silent passes.

    Args:
        store: Where the run is kept.
        run: Its identifier.
        detector: Finds the tips.
        scorer: The world model; it is adapted to the run.
        model: A vision model within a budget, asked about the silent passes in their order.
        progress: Told how far it is.

    Raises:
        ConfigurationError: The run is not in the store.
        StoreError: The store cannot be read.
    """
    progress = progress or Progress()
    wells, left_out = run_wells(store, run, detector, progress)
    ranked: list[_Ranked] = []
    notes: list[str] = []
    progress.begin("Comparing wells", len(wells))
    for stream in by_liquid(wells):
        ranked += _judge(stream, wells, scorer, progress)
        passed = sum(well.outcome == Outcome.PASS.value for well in stream)
        if passed < _FEW:
            notes.append(
                f"Only {counted(passed, 'well')} of {liquid_words(stream[0])} passed: too few to "
                "be compared with each other."
            )
    if left_out:
        notes.append(
            f"{counted(left_out, 'delivery', 'deliveries')} of several tips, given up, or without "
            "readable frames: not audited."
        )
    ranked.sort(key=_order)
    suspects, costs = _asked(ranked, model, progress)
    row = store.run(run) or {}
    return Audit(
        run,
        time.time(),
        "simulated" if row.get("simulated") else "real",
        len(wells),
        left_out,
        sum(_silent(well) for well in wells),
        suspects,
        costs,
        notes,
    )


def _silent(well: RunWell) -> bool:
    """Whether it passed, and no person has looked at it."""
    return well.outcome == Outcome.PASS.value and not well.entry["decisions"]


def _found_right(well: RunWell) -> bool:
    """Whether a person was asked about it, and passed it or let the run go on."""
    if well.outcome == Outcome.UNDECIDED.value:
        return any(hold["answered"] for hold in well.entry["holds"])
    return well.outcome == Outcome.PASS.value and bool(well.entry["decisions"])


def _order(one: _Ranked) -> tuple[float, int]:
    return -one.suspect.score, one.suspect.shown


def _judge(
    stream: Sequence[RunWell],
    run: Sequence[RunWell],
    scorer: EnsembleScorer,
    progress: Progress,
) -> list[_Ranked]:
    """The silent passes of one liquid, and what they have in common."""
    trusted = [well.outcome == Outcome.PASS.value for well in stream]
    measured = measure(stream, trusted, scorer, progress)
    found = standings(measured, trusted)
    silent = [place for place, well in enumerate(stream) if _silent(well)]
    if not silent:
        return []
    others = sum(trusted) - 1
    singles = {
        place: _single(stream[place], measured[place], found[place], others, run)
        for place in silent
    }
    plainest = min(silent, key=lambda place: singles[place].score)
    normal = stream[plainest].recorded
    ranked = [_Ranked(one, stream[place], normal) for place, one in singles.items()]
    ranked += [
        _Ranked(one, next(well for well in stream if well.trajectory == one.shown), normal)
        for one in _common(stream, measured, silent)
    ]
    return ranked


def _single(
    well: RunWell, measured: Measures, standing: WellStanding, others: int, run: Sequence[RunWell]
) -> Suspect:
    near = list(neighbour_words(well, run))
    score = standing.total + sum(counts for _, counts in near)
    voices = sum(surprise >= SPEAKS for _, surprise in standing.strongest().values())
    if measured.contradiction:
        score += _CONTRADICTED
        voices += 1
    why = [*reasons(well, measured, standing, others), *(said for said, _ in near)]
    why = why or [f"Nothing speaks against it beside {counted(others, 'other well')}."]
    return Suspect(
        "well",
        (well.trajectory,),
        (str(well.entry["well"]),),
        score,
        tuple(why),
        score >= STANDS_OUT and voices > 1,
        well.trajectory,
    )


def _common(
    stream: Sequence[RunWell], measured: Sequence[Measures], silent: Sequence[int]
) -> list[Suspect]:
    """What concerns many wells of a liquid at once."""
    if no_liquid(stream, measured):
        seen = next((well for well in stream if _found_right(well)), None)
        why = no_liquid_words(stream, seen)
        return [_group("no_liquid", stream, silent, _GRAVE, why, stands_out=seen is None)]
    found = []
    for drift in drifts(measured):
        places = [place for place in drift.places if place in silent]
        if places:
            found.append(_group("drift", stream, places, drift.score, drift_words(drift, stream)))
    return found


def _group(
    kind: str,
    stream: Sequence[RunWell],
    places: Sequence[int],
    score: float,
    why: Sequence[str],
    stands_out: bool = True,
) -> Suspect:
    wells = [stream[place] for place in places]
    return Suspect(
        kind,
        tuple(well.trajectory for well in wells),
        tuple(str(well.entry["well"]) for well in wells),
        score,
        tuple(why),
        stands_out,
        wells[-1].trajectory,
    )


def _asked(
    ranked: Sequence[_Ranked], model: ConfirmingGate | None, progress: Progress
) -> tuple[list[Suspect], list[dict[str, object]]]:
    """The suspects with a vision model's word, as far as its budget goes, and what it took."""
    suspects = [one.suspect for one in ranked]
    if model is None:
        return suspects, []
    progress.begin("Asking the model", len(ranked))
    costs: list[dict[str, object]] = []
    for place, one in enumerate(ranked):
        sample = replace(one.well.recorded, detections=one.well.sample.detections)
        said = model.examine(GateInput(sample, Route.SILENT_PASS, normal=one.normal))
        progress.step()
        if not said.costs:
            break  # the budget is spent, or the model does not answer
        costs += [vars(cost) for cost in said.costs]
        suspects[place] = _heard(one.suspect, said.outcome, said.reason)
    suspects.sort(key=lambda one: (-one.score, one.shown))
    return suspects, costs


def _heard(suspect: Suspect, outcome: Outcome, reason: str) -> Suspect:
    counts = {Outcome.FAIL: _FAILED, Outcome.PASS: _PASSED}.get(outcome, 0.0)
    score = max(suspect.score + counts, 0.0)
    word = {Outcome.FAIL: "fails it", Outcome.PASS: "passes it"}.get(outcome, "cannot tell")
    return replace(
        suspect,
        score=score,
        why=(*suspect.why, f"A vision model {word}: {reason}"),
        stands_out=outcome is Outcome.FAIL
        or (suspect.stands_out and (suspect.kind != "well" or score >= STANDS_OUT)),
        model={"outcome": outcome.value, "reason": reason},
    )
