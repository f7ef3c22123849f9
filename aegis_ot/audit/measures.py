"""What each well shows when it is read beside all the others of its liquid, itself left out."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np

from ..progress import Progress
from ..vision.column import Wetness, ceiling
from ..vision.column_reader import MeasuredColumns, Well
from ..vision.delivery import Shown
from ..vision.first_wells import FirstWells
from ..vision.gates import GateInput, VolumetricGate
from ..vision.run_scorer import RunScorer
from ..vision.scorers.ensemble import EnsembleScorer
from ..vision.tips import tip_for
from ..vision.types import FREE
from ..vocabulary import KeyframeKind, Outcome, Route
from .wells import RunWell

T = TypeVar("T")

TRANSIT, AFTER = FREE

HEIGHTS = (0.25, 0.4, 0.55, 0.75, 1.0)
"""Shares of the full column's height over which a column left behind is looked for."""

_TEACHERS = 16
"""Other wells that teach the reader what empty and full tips look like: more than it remembers
would teach it nothing."""

_REFERENCE = 8
"""Wells, spread over the run, that the scorer adapts to; beyond eight more change little."""

_FIRST_SHARE, _FIRST_LEAST = 1 / 3, 4
"""Share of the wells that are the run's first ones, and how many they are at least."""

ANOTHER_EDGE = 0.04
"""A meniscus farther than this from its place, tip lengths, is no surer a sign: it may be another
edge."""

_LOADED_NEAR = 0.03
"""A meniscus in transit this close to its place, tip lengths, is the drawn column's."""


@dataclass(frozen=True)
class Measures:
    """One well, measured. A sign that could not be told is left out; larger is worse.

    Attributes:
        signs: ``left_25`` to ``left_100``: how filled the lower part of the tip looks after the
            dispense, 0 empty, 1 full, over so many per cent of the column's height; ``retained``:
            root of the log-likelihood ratio of a column left, from both frames after the dispense;
            ``short``: what the column in transit lacks to be full, 0 to 1; ``gap``: logarithm of
            the strongest break in it; ``low``, ``high``: how far it ends below or above its
            place, tip lengths; ``faint``: what the change between transit and after the dispense
            lacks of the liquid's usual one, 0 to 1; ``score``: of the image scorer, nats.
        left_ul: Volume of a column of each of :data:`HEIGHTS`, µL.
        power: How plainly the liquid shows in this run: squared distance of full from empty.
        meniscus: Whether the drawn column's end is seen where it should be in transit.
        contradiction: How the measured columns contradict the protocol's volumes; empty if they
            do not.
        since: The signs of the free frames read beside the run's first wells alone: a fault that
            creeps in has spoiled what the later ones teach.
    """

    signs: Mapping[str, float]
    left_ul: Mapping[str, float] = field(default_factory=dict)
    power: float = 0.0
    meniscus: bool = False
    contradiction: str = ""
    since: Mapping[str, float] = field(default_factory=dict)


def measure(
    wells: Sequence[RunWell], trusted: Sequence[bool], scorer: EnsembleScorer, progress: Progress
) -> list[Measures]:
    """Measure the wells of one liquid, in the order in which they were pipetted.

    Args:
        wells: Of one liquid, pipette and kind of tip.
        trusted: Which of them may teach what is normal.
        scorer: The world model; it is left adapted to this liquid.
        progress: Steps once a well.
    """
    reader = MeasuredColumns()
    reader.expect_heights(RunScorer(scorer, 2).height_factors)
    taught = [(well.looks, well.sample.expected_ul) for well in wells]
    for pair, trust in zip(taught, trusted, strict=True):
        if trust:
            reader.learn(*pair)
    scored = _scores(wells, trusted, scorer)
    told = [well.delivery for well in wells if well.delivery.shown is not Shown.UNKNOWN]
    usual = float(np.median([one.strength for one in told])) if told else 0.0
    proven = FirstWells(ask=False)
    for one in told:
        proven.note(wells[0].liquid, one)
    first = max(round(_FIRST_SHARE * len(wells)), _FIRST_LEAST)
    found = []
    for place, well in enumerate(wells):
        progress.step()
        others = [at for at in range(len(wells)) if at != place and trusted[at]]
        teachers = _spread([taught[at] for at in others], _TEACHERS)
        seen = _read(well, reader, teachers)
        since = _read(well, reader, [taught[at] for at in others if at < first])
        signs = dict(seen.signs) | scored[place][0]
        if usual > 0 and well.delivery.shown is not Shown.UNKNOWN:
            signs["faint"] = 1.0 - well.delivery.strength / usual
        found.append(
            Measures(
                signs, seen.left_ul, seen.power, scored[place][1],
                _contradiction(well, reader, teachers, proven), since.signs,
            )
        )  # fmt: skip
    return found


def _spread(items: Sequence[T], most: int) -> list[T]:
    """At most so many, spread over the run."""
    if len(items) <= most:
        return list(items)
    return [items[round(at)] for at in np.linspace(0, len(items) - 1, most)]


def _read(well: RunWell, reader: MeasuredColumns, others: Sequence[Well]) -> Measures:
    """What its free frames show of the column, by what the others teach."""
    wets = reader.wetness_beside(well.looks, well.sample.expected_ul, others)
    tip = tip_for(well.keyframe.pipette, well.keyframe.capacity_ul)
    top = reader.place(tip, well.sample.expected_ul[TRANSIT])
    signs: dict[str, float] = {}
    volumes: dict[str, float] = {}
    before, after = wets.get(TRANSIT), wets.get(AFTER)
    if before is not None:
        end = _end(well, TRANSIT)
        _put(signs, "short", before, top + 0.02, end, full=True)
        signs["gap"] = math.log1p(before.longest_gap(top + 0.05, end))
    rest = reader.place(tip, well.sample.expected_ul[AFTER])
    if after is not None:
        for share in HEIGHTS:
            name = f"left_{share * 100:.0f}"
            upper = max(rest - share * (rest - top), ceiling(tip))
            _put(signs, name, after, upper, min(rest, _end(well, AFTER)))
            above = float(tip.volume_of((1.0 - upper) * tip.length_mm))
            volumes[name] = max(above - well.sample.expected_ul[AFTER], 0.0)
    return Measures(signs, volumes, 0.0 if before is None else before.power)


def _contradiction(
    well: RunWell, reader: MeasuredColumns, teachers: Sequence[Well], proven: FirstWells
) -> str:
    """What the volumetric gate says against it, all other wells known."""
    readings = reader.read_beside(well.looks, well.sample.expected_ul, teachers)
    found = well.sample.detections.items()
    case = GateInput(
        well.sample, Route.SILENT_PASS, None, readings,
        tuple(kind for kind, tip in found if tip is None), clearly_absent=False,
        delivery=proven.held_against(well.liquid, well.delivery),
    )  # fmt: skip
    said = VolumetricGate().examine(case)
    return said.reason if said.outcome is Outcome.FAIL else ""


def _put(
    signs: dict[str, float], name: str, wet: Wetness, low: float, high: float, full: bool = False
) -> None:
    share, weight = wet.mean(low, high)
    if weight > 0:
        signs[name] = 1.0 - share if full else share


def _end(well: RunWell, kind: KeyframeKind) -> float:
    return well.looks[kind].lowest


def _scores(
    wells: Sequence[RunWell], trusted: Sequence[bool], scorer: EnsembleScorer
) -> list[tuple[dict[str, float], bool]]:
    """Signs of the image scorer, adapted to wells of the whole run but the one that it scores."""
    pairs = zip(wells, trusted, strict=True)
    able = [well for well, trust in pairs if trust and not well.without_tip]
    places = np.unique(
        np.linspace(0, len(able) - 1, min(_REFERENCE, len(able))).round().astype(int)
    )
    chosen = [able[at] for at in places] if able else []
    found: list[tuple[dict[str, float], bool]] = [({}, False)] * len(wells)
    scorer.calibrate([well.sample for well in chosen])
    inside = {well.trajectory for well in chosen}
    for place, well in enumerate(wells):
        if well.trajectory not in inside and not well.without_tip:
            found[place] = _scored(well, scorer)
    for place, well in enumerate(wells):
        if well.trajectory in inside:
            scorer.calibrate([other.sample for other in chosen if other is not well])
            found[place] = _scored(well, scorer)
    return found


def _scored(well: RunWell, scorer: EnsembleScorer) -> tuple[dict[str, float], bool]:
    report = scorer.report(well.sample)
    seen = report.column.signs
    signs = {"score": report.score}
    stayed = seen.retained if seen.undelivered is None else seen.undelivered
    if stayed is not None:
        signs["retained"] = math.sqrt(max(stayed, 0.0))
    off = seen.misfill.get(TRANSIT)
    if off is not None:
        near = min(max(off, -ANOTHER_EDGE), ANOTHER_EDGE)
        signs["low"], signs["high"] = near, -near
    if seen.absent is not None:
        signs["absent"] = seen.absent
    return signs, off is not None and abs(off) < _LOADED_NEAR
