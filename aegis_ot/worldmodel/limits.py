"""A laboratory's own limits, fitted on its normal wells and the failures that it planted.

Few dozen wells teach few numbers: a logistic regression with weights of at least 0 (more of a
reading is never good news), drawn towards none (ridge). What stayed in the tip and what was drawn
wrongly are told from normal wells apart, each by the readings that speak of it. Every well is then
judged by a fit of the others, so that limit and report rest on no well that taught its own weights.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.stats import binom

from ..vision.gates import GateInput
from ..vision.lab_limits import AFTER, LOADED, READINGS, LabLimit, LabLimits, limit_key, readings_of
from ..vocabulary import KeyframeKind
from .cascade import JudgedWell, run_cascade
from .leave_one_out import HeldOut

Array = NDArray[np.float64]

ENOUGH, ENOUGH_ALIKE = 10, 4
"""Normal wells, and failures, from which limits are fitted, and failures of one part of it."""

PLATE = 96
FALSE_STOPS = 1.0
"""False stops per plate that are aimed at, if nothing else is wanted."""

CAUGHT = 0.9
"""How often the smallest leftover is to be caught."""

_RIDGES = (1.0, 3.0, 10.0)
_LEAST_SPREAD = 0.05
_CERTAIN = 0.05
"""Where failures are beyond the limit no more often than normal wells may be, unless by a chance
smaller than this, the readings tell nothing."""

_PRIOR_WELLS = 4.0
"""How many normal wells above their median the scale of those below it is worth."""

_NOT_DRAWN = ("no_aspirate", "air_bubble")
"""Failures, as data sets have them, of which nothing stays in the tip."""


@dataclass(frozen=True)
class LimitGoal:
    """What a limit is to do.

    Attributes:
        false_stops: Normal wells per plate of 96 that it may flag; aimed at, not proven.
        smallest: Instead: share of the volume that, left in the tip, is to be caught nine times in
            ten, whatever that flags.
    """

    false_stops: float = FALSE_STOPS
    smallest: float | None = None


@dataclass(frozen=True)
class FittedLimit:
    """What a limit would have done to the wells that made it, each judged by a fit of the others.

    Attributes:
        tip, liquid: For which it holds.
        failures, normals: Wells, whose tips were seen and which the run was not calibrated on.
        caught_before, caught: Failures flagged without it, and with it.
        flagged_before, flagged: The same of normal wells.
        used: Whether it is used: not if it catches too few to tell that from chance.
    """

    tip: str
    liquid: str
    failures: int
    normals: int
    caught_before: int
    caught: int
    flagged_before: int
    flagged: int
    used: bool

    def to_json(self) -> dict[str, str | int | bool]:
        return asdict(self)


@dataclass(frozen=True)
class LimitFit:
    """What came of a fit.

    Attributes:
        limits: Those that are used.
        reports: Of each liquid with enough wells.
        judged: All wells, as they were judged without limits.
        beyond: Of ``judged``, whether a limit that is used, fitted on the others, would flag it.
    """

    limits: LabLimits
    reports: list[FittedLimit]
    judged: list[JudgedWell]
    beyond: list[bool]


def fit_limits(held: HeldOut, wanted: LimitGoal | None = None) -> LimitFit:
    """Play every plate as a live run, and fit limits on what was read.

    Args:
        held: Wells with true labels, and what scores each plate: no model that learned from it.
        wanted: See :class:`LimitGoal`.
    """
    noted = _Noted()
    models = {id(model): model for model in held.models.values()}.values()
    for model in models:
        model.lab_limits = noted  # type: ignore[attr-defined]
    judged = run_cascade(held)
    for model in models:
        del model.lab_limits  # type: ignore[attr-defined]
    groups: dict[tuple[str, str], list[int]] = defaultdict(list)
    readings = [noted.readings.get(_id(well)) for well in judged]
    for number, (well, told) in enumerate(zip(judged, readings, strict=True)):
        if told is not None:
            groups[limit_key(well.sample)].append(number)
    limits: dict[tuple[str, str], list[LabLimit]] = {}
    reports, beyond = [], [False] * len(judged)
    for key, members in groups.items():
        wells = [judged[number] for number in members]
        failures = sum(well.scored.failed for well in wells)
        if min(failures, len(wells) - failures) < ENOUGH:
            continue
        known = np.stack([told for number in members if (told := readings[number]) is not None])
        fitted, over, report = _fit_one(key, wells, known, wanted or LimitGoal())
        reports.append(report)
        if report.used:
            limits[key] = fitted
            for number, is_over in zip(members, over, strict=True):
                beyond[number] = bool(is_over)
    return LimitFit(LabLimits(limits), reports, judged, beyond)


def _id(well: JudgedWell) -> str:
    return f"{well.verdict.run}-{well.verdict.trajectory}"


class _Noted(LabLimits):
    """Notes the readings of wells, and has no limit for them."""

    def __init__(self) -> None:
        super().__init__({})
        self.readings: dict[str, Array] = {}

    def beyond(self, case: GateInput, wet: Mapping[KeyframeKind, tuple[float, ...]]) -> float:
        self.readings[case.sample.id] = readings_of(case, wet)
        return 0.0


def _fit_one(
    key: tuple[str, str], wells: Sequence[JudgedWell], readings: Array, wanted: LimitGoal
) -> tuple[list[LabLimit], NDArray[np.bool_], FittedLimit]:
    failed = np.array([well.scored.failed for well in wells])
    flagged = np.array([well.flagged for well in wells])
    left = np.array([well.sample.retained_fraction or 0.0 for well in wells])
    types = np.array([well.sample.failure_type for well in wells])
    stays = (left > 0) | np.char.startswith(types, "partial") | (types == "no_dispense")
    parts = ((AFTER, failed & ~np.isin(types, _NOT_DRAWN)), (LOADED, failed & ~stays))
    limits, beyond = [], np.zeros(len(wells), dtype=bool)
    for names, own in parts:
        if own.sum() < ENOUGH_ALIKE:
            continue
        alike, asked = ~failed | own, np.isin(READINGS, names)
        known = np.where(asked, readings, np.nan)
        limit, odds = _fit_part(known[alike], own[alike], left[alike], wanted)
        over = limit.log_odds(known) > limit.limit
        over[alike] = odds > limit.limit
        if _tells(over[own], over[~failed], wanted):
            limits.append(limit)
            beyond |= over
    after = flagged | beyond
    report = FittedLimit(
        *key, int(failed.sum()), int((~failed).sum()),
        int(flagged[failed].sum()), int(after[failed].sum()),
        int(flagged[~failed].sum()), int(after[~failed].sum()), bool(limits),
    )  # fmt: skip
    return limits, beyond, report


def _fit_part(
    readings: Array, failed: NDArray[np.bool_], left: Array, wanted: LimitGoal
) -> tuple[LabLimit, Array]:
    """A limit, and the log odds of each well by a fit of the others."""
    odds = {ridge: _left_out(readings, failed, ridge) for ridge in _RIDGES}
    ridge = min(_RIDGES, key=lambda one: _loss(odds[one], failed, _balance(failed)))
    edge = _edge(odds[ridge], failed, left, wanted)
    return replace(fit_weights(readings, failed, ridge), limit=edge), odds[ridge]


def _edge(odds: Array, failed: NDArray[np.bool_], left: Array, wanted: LimitGoal) -> float:
    """The limit that does what is wanted to wells judged by a fit of the others."""
    if wanted.smallest is not None:
        meant = np.sort(odds[failed & (left >= wanted.smallest - 1e-9)])
        if len(meant):
            return float(meant[math.floor((1 - CAUGHT) * len(meant))]) - 1e-6
    # A few dozen normal wells have no quantile of one in two hundred: beyond their median they fall
    # off exponentially. Ridge shrinks log odds: the usual scale is that of the other side.
    normal = odds[~failed]
    middle, half = float(np.median(normal)), 0.5 * len(normal)
    over, under = (float(np.maximum(side * (normal - middle), 0.0).sum()) for side in (1.0, -1.0))
    scale = (over + _PRIOR_WELLS * under / half) / (_PRIOR_WELLS + half)
    beyond = middle + scale * math.log(0.5 / _rate(wanted))
    # Nor is a well flagged that is more like the normal ones: their log odds are below 0.
    return max(beyond, float(normal.max()), 0.0)


def _rate(wanted: LimitGoal) -> float:
    """Normal wells that one of both limits may flag, as a share."""
    return min(max(wanted.false_stops, 1e-3) / PLATE / 2, 0.5)


def _tells(failures: NDArray[np.bool_], normals: NDArray[np.bool_], wanted: LimitGoal) -> bool:
    """Whether failures are beyond a limit more often than normal wells, or than those may be."""
    usual = max(_rate(wanted), float(normals.mean()))
    return bool(binom.sf(failures.sum() - 1, len(failures), usual) < _CERTAIN)


def fit_weights(readings: Array, failed: NDArray[np.bool_], ridge: float) -> LabLimit:
    """A limit's weights, by regularised logistic regression; its limit is 0.

    Args:
        readings: ``(wells, readings)``; ``nan`` where not told.
        failed: ``(wells,)``.
        ridge: How strongly weights are drawn to 0.
    """
    normal = readings[~failed]
    told = ~np.isnan(normal).all(axis=0)
    usual = np.zeros(readings.shape[1])
    usual[told] = np.nanmedian(normal[:, told], axis=0)
    strayed = np.where(np.isnan(readings), 0.0, readings - usual)
    spread = np.sqrt((strayed**2).mean(axis=0) / 2 + strayed[~failed].var(axis=0) / 2)
    spread = np.maximum(spread, _LEAST_SPREAD)
    limit = LabLimit(np.zeros(readings.shape[1]), usual, spread, 0.0, 0.0)
    scaled = np.clip(strayed / spread, -4.0, 4.0)
    weight = _balance(failed)

    def loss(parameters: Array) -> tuple[float, Array]:
        odds = scaled @ parameters[1:] + parameters[0]
        off = weight * (1.0 / (1.0 + np.exp(-odds)) - failed)
        penalty = ridge * parameters[1:]
        total = _loss(odds, failed, weight) + 0.5 * float(penalty @ parameters[1:])
        return total, np.concatenate(([off.sum()], scaled.T @ off + penalty))

    start = np.zeros(readings.shape[1] + 1)
    bounds = [(None, None), *[(0.0, None)] * readings.shape[1]]
    best = minimize(loss, start, jac=True, method="L-BFGS-B", bounds=bounds).x
    return LabLimit(best[1:], limit.usual, limit.spread, float(best[0]), 0.0)


def _left_out(readings: Array, failed: NDArray[np.bool_], ridge: float) -> Array:
    """Log odds of each well by a fit of the others."""
    odds = np.empty(len(failed))
    for number in range(len(failed)):
        others = np.arange(len(failed)) != number
        fitted = fit_weights(readings[others], failed[others], ridge)
        odds[number] = fitted.log_odds(readings[[number]])[0]
    return odds


def _balance(failed: NDArray[np.bool_]) -> Array:
    """Weights by which normal wells and failures count alike."""
    share = failed.mean()
    return np.where(failed, 0.5 / max(share, 1e-9), 0.5 / max(1 - share, 1e-9))


def _loss(odds: Array, failed: NDArray[np.bool_], weight: Array) -> float:
    return float((weight * (np.logaddexp(0.0, odds) - failed * odds)).sum())
