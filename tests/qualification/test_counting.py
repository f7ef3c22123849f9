"""What a certificate claims holds, on laboratories whose truth is known."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
import pytest
from scipy.stats import norm

from aegis_ot.planted import LEFT, NORMAL
from aegis_ot.qualification.counting import Rate, rate_of, smallest_leftover, spread_between
from aegis_ot.qualification.plan import make_plan

LABORATORIES = 60


def test_an_interval_is_exact() -> None:
    assert Rate(0, 10).interval == pytest.approx((0.0, 0.3085), abs=1e-4)
    assert Rate(9, 10).interval == pytest.approx((0.555, 0.9975), abs=1e-3)
    assert Rate(0, 0).interval == (0.0, 1.0)


@pytest.mark.parametrize("of", [1, 2, 14, 24])
def test_an_interval_widens_with_the_spread_and_holds_the_share(of: int) -> None:
    for hits in range(of + 1):
        narrow = Rate(hits, of).interval
        for spread in (0.02, 0.1, 0.4, 1.0):
            low, high = Rate(hits, of, spread).interval
            assert 0.0 <= low <= hits / of <= high <= 1.0
            assert low <= narrow[0]
            assert narrow[1] <= high
            narrow = low, high


def test_a_run_whose_wells_are_all_alike_is_worth_one_well() -> None:
    assert Rate(24, 24, 1.0).interval == pytest.approx(Rate(1, 1).interval)
    assert Rate(0, 24, 1.0).interval == pytest.approx(Rate(0, 1).interval)


def test_halves_that_agree_leave_the_interval_as_it_is() -> None:
    assert spread_between([((5, 7), (5, 7)), ((1, 2), (1, 2)), ((0, 6), (1, 6))]) == 0.0
    assert spread_between([((7, 7), (7, 7)), ((0, 6), (0, 6))]) == 0.0  # nothing tells
    assert spread_between([((1, 1), (0, 1))]) == 0.0  # as one well, nor does that
    assert spread_between([]) == 0.0


def test_halves_that_differ_have_a_spread() -> None:
    some, more = spread_between([((4, 7), (2, 7))]), spread_between([((5, 7), (2, 7))])
    assert 0 < some < more < spread_between([((7, 7), (0, 7))]) == 1.0
    # What agrees beside it makes it smaller.
    assert spread_between([((5, 7), (2, 7)), ((3, 6), (3, 6))]) < more


def test_the_spread_is_found_on_average() -> None:
    """Of halves whose rates are drawn (beta distribution) with a spread that is known."""
    rng = np.random.default_rng(5)
    for true in (0.05, 0.2, 0.5):
        found = []
        for _ in range(300):
            groups = []
            for middle, size in ((0.5, 12), (0.3, 12), (0.6, 24)):
                more = (1 - true) / true
                rates = rng.beta(middle * more, (1 - middle) * more, size=2)
                one, other = (int(rng.binomial(size, rate)) for rate in rates)
                groups.append(((one, size), (other, size)))
            found.append(spread_between(groups))
        assert np.mean(found) == pytest.approx(true, abs=0.1)


@pytest.mark.parametrize("hits", [0, 1, 2, 3, 4])
def test_more_caught_never_lowers_an_interval(hits: int) -> None:
    fewer, more = Rate(hits, 5).interval, Rate(hits + 1, 5).interval
    assert fewer[0] < more[0]
    assert fewer[1] <= more[1]


def _curve(rng: np.random.Generator) -> tuple[float, float, float]:
    return rng.uniform(0.05, 0.8), rng.uniform(0.1, 0.6), rng.choice([0.0, 0.0, 0.03])


def _chance(middle: float, width: float, lapse: float, false_alarms: float, share: float) -> float:
    """How often a leftover of this size is caught."""
    caught = norm.cdf(np.log(share / middle) / width)
    return float(false_alarms + (1 - false_alarms) * (1 - lapse) * caught)


def test_claims_cover_the_truth_of_drawn_laboratories() -> None:
    """Rates of each kind, and the smallest leftover: nine times in ten at least."""
    rng = np.random.default_rng(4)
    rates = smallest = told = 0
    for seed in range(LABORATORIES):
        middle, width, lapse = _curve(rng)
        false_alarms = rng.uniform(0.0, 0.05)

        rising = partial(_chance, middle, width, lapse, false_alarms)

        plan = make_plan("p300_single_gen2", "left", ["dye"], 30, seed)
        left = [each.share for each in plan.deliveries if each.kind == LEFT]
        normals = sum(each.kind == NORMAL for each in plan.deliveries)
        caught = [bool(rng.random() < rising(share)) for share in left]
        alarms = rate_of(rng.random(normals) < false_alarms)
        low, high = rate_of(caught).interval
        rates += low <= np.mean([rising(share) for share in left]) <= high
        claim = smallest_leftover(left, caught, alarms)
        assert claim is not None
        least = next((s for s in np.geomspace(0.02, 1, 500) if rising(s) >= 0.9), math.inf)
        high = math.inf if claim.high is None else 1.02 * claim.high
        low = 0.0 if claim.low <= claim.planted else claim.low  # "this or less"
        smallest += low <= 1.02 * least and least <= high
        told += claim.high is not None
    assert rates >= 0.9 * LABORATORIES
    assert smallest >= 0.9 * LABORATORIES
    assert told > 0.05 * LABORATORIES  # no claim holds by saying nothing


def test_leftovers_that_are_all_missed_have_no_smallest() -> None:
    shares = [0.1, 0.3, 0.5, 0.75, 1.0] * 3
    claim = smallest_leftover(shares, [False] * len(shares), Rate(0, 18))
    assert claim is not None
    assert claim.share is None
    assert claim.high is None
    assert smallest_leftover([], [], Rate(0, 18)) is None


def test_leftovers_that_are_all_caught_have_a_small_one() -> None:
    shares = [0.1, 0.2, 0.3, 0.5, 0.75, 1.0] * 3
    claim = smallest_leftover(shares, [True] * len(shares), Rate(0, 18))
    assert claim is not None
    assert claim.share is not None
    # Less was never planted: "10 % or less" is all that can be said.
    assert claim.share == claim.low == claim.planted == 0.1


def test_the_smallest_leftover_is_less_certain_where_runs_differ() -> None:
    shares = [0.1, 0.2, 0.3, 0.4, 0.5, 0.75, 1.0] * 2
    caught = [share >= 0.3 for share in shares]
    claims = [smallest_leftover(shares, caught, Rate(0, 18), spread) for spread in (0.0, 0.1, 0.5)]
    assert all(claim is not None for claim in claims)
    lows, highs = zip(*((c.low, c.high or math.inf) for c in claims if c is not None), strict=True)
    assert list(lows) == sorted(lows, reverse=True)
    assert list(highs) == sorted(highs)
    assert lows[0] > lows[-1]


def test_nothing_is_told_of_leftovers_where_normal_wells_are_flagged_too() -> None:
    shares = [0.1, 0.3, 0.5, 1.0] * 3
    assert smallest_leftover(shares, [True] * len(shares), Rate(9, 18)) is None
    assert smallest_leftover(shares, [True] * len(shares), Rate(18, 18)) is None
    claim = smallest_leftover(shares, [True] * len(shares), Rate(1, 1))
    assert claim is not None
    assert claim.share == 0.1
