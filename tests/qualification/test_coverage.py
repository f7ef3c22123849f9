"""The measurement of claims against the truth, on laboratories that are known without frames."""

from __future__ import annotations

from collections import defaultdict
from functools import lru_cache
from typing import Any

import numpy as np
from scipy.special import ndtr

from aegis_ot.planted import LEFT, NORMAL
from aegis_ot.qualification.opening import JudgedDelivery
from aegis_ot.qualification.plan import CALIBRATING, QualificationPlan, make_plan
from aegis_ot.vocabulary import KeyframeKind
from benchmarks.qualification_claims import coverage, rising

FRAMES = [{"kind": kind.value, "late": False} for kind in KeyframeKind]


@lru_cache
def plan_of(seed: int) -> QualificationPlan:
    return make_plan("p300_single_gen2", "left", ["dye"], 30, seed)


def judged(
    plan: QualificationPlan,
    rng: np.random.Generator,
    middle: float,
    false_alarms: float = 0.02,
    others: float = 0.8,
) -> list[JudgedDelivery]:
    """By a laboratory that catches half of the leftovers of size ``middle``, more of larger ones,
    and eight in ten other faults."""
    deliveries = []
    for number, planned in enumerate(plan.deliveries):
        chance = {NORMAL: false_alarms, LEFT: ndtr(np.log((planned.share or 1) / middle) / 0.3)}
        is_flagged = rng.random() < chance.get(planned.kind, others)
        entry: Any = {"judged": {"outcome": "fail" if is_flagged else "pass"}, "keyframes": FRAMES}
        deliveries.append(JudgedDelivery(planned, number < CALIBRATING, entry))
    return deliveries


def test_nine_in_ten_claims_of_20_laboratories_hold() -> None:
    rng = np.random.default_rng(44)
    held = defaultdict(list)
    for seed in range(20):
        middle, alarms = rng.uniform(0.1, 0.7), rng.uniform(0.0, 0.05)
        told = [judged(plan_of(100 + n), rng, middle, alarms) for n in range(1, 9)]
        for row in coverage(judged(plan_of(seed), rng, middle, alarms), told, plan_of(seed)):
            held[row["claim"]].append(row["covered"])
    assert set(held) >= {"all", "left", "one size", "normals", "smallest"}
    assert all(np.mean(rows) >= 0.9 for rows in held.values()), held


def test_claims_hold_where_runs_differ() -> None:
    """Each run, and each half that is judged by itself, is calibrated better or worse."""
    rng = np.random.default_rng(46)
    held: dict[str, list[tuple[bool, bool]]] = defaultdict(list)

    def run(seed: int) -> list[JudgedDelivery]:
        luck = 0.7 * rng.normal()
        others = float(ndtr(lab + luck))
        return judged(plan_of(seed), rng, middle * float(np.exp(luck)), 0.0, others)

    for seed in range(40):
        middle, lab = rng.uniform(0.2, 0.9), rng.normal()
        told = [[each for _ in range(30) for each in run(200)]]
        first, other = run(seed), run(seed)
        apart = [
            *(d for d in first if d.planned.half == 1),
            *(d for d in other if d.planned.half == 2),
        ]
        anew = {each.planned.well: each.is_flagged for each in apart}
        for row in coverage(first, told, plan_of(seed), anew):
            if "exact" in row:
                held[row["claim"]].append((row["covered"], row["exact"]))
    holding = {name: np.mean(rows, axis=0) for name, rows in held.items()}
    assert all(now >= 0.9 for now, _ in holding.values()), holding
    assert holding["left"][1] < 0.9  # the exact intervals, as if every run calibrated alike


def test_claims_of_another_laboratory_do_not_hold() -> None:
    rng, plan = np.random.default_rng(45), plan_of(1)
    for claimed, true in ((0.05, 2.0), (2.0, 0.05)):
        told = [judged(plan_of(n), rng, true) for n in range(2, 6)]
        rows = {row["claim"]: row for row in coverage(judged(plan, rng, claimed), told, plan)}
        assert not any(rows[name]["covered"] for name in ("all", "left", "smallest"))


def test_a_larger_leftover_is_caught_no_less_often() -> None:
    assert rising([(1, 2), (0, 2), (2, 2), (1, 2)]) == [0.25, 0.25, 0.75, 0.75]
