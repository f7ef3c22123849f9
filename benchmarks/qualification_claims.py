"""The claims of a qualification beside the truth of its laboratory."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from scipy.stats import t

from aegis_ot.planted import LEFT
from aegis_ot.qualification.certificate import count_liquid
from aegis_ot.qualification.counting import CAUGHT, Rate
from aegis_ot.qualification.opening import JudgedDelivery
from aegis_ot.qualification.plan import QualificationPlan


def counted(
    deliveries: Sequence[JudgedDelivery],
    plan: QualificationPlan,
    anew: Mapping[str, bool] | None = None,
) -> dict[str, Any]:
    """What the certificate says of them."""
    return count_liquid(plan.liquids[0], deliveries, plan, anew)


def coverage(
    judged: Sequence[JudgedDelivery],
    told: Sequence[Sequence[JudgedDelivery]],
    plan: QualificationPlan,
    anew: Mapping[str, bool] | None = None,
) -> list[dict[str, Any]]:
    """The claims of a qualification beside the truth.

    Args:
        judged: Its deliveries.
        told: Those of each further qualification of the same laboratory.
        plan: Of the first.
        anew: As for :func:`~aegis_ot.qualification.certificate.certificate`.
    """
    claim = counted(judged, plan, anew)
    truth = counted([each for run in told for each in run], plan)
    runs = [_rates(counted(run, plan)) for run in told]
    true = _rates(truth)
    rows = []
    for (name, size), rate in _rates(claim).items():
        if (name, size) in true:
            of_runs = [rates[name, size] for rates in runs if (name, size) in rates]
            rows.append({"claim": name, **_beside(rate, true[name, size], of_runs)})
    if claim["smallest_leftover"]:
        sizes = {
            row["share"]: (row["caught"]["hits"], row["caught"]["of"])
            for row in truth["rows"] if row["kind"] == LEFT
        }  # fmt: skip
        rows.append({"claim": "smallest", **_smallest(claim["smallest_leftover"], sizes)})
    return rows


def _rates(told: dict[str, Any]) -> dict[tuple[str, float], dict[str, Any]]:
    """All rates of a certificate, by name and, of leftovers, size."""
    sizes = {
        ("one size", row["share"]): row["caught"] for row in told["rows"] if row["kind"] == LEFT
    }
    kinds = {(kind, 0.0): rate for kind, rate in told["by_kind"].items()}
    whole = {("all", 0.0): told["caught"], ("normals", 0.0): told["normals_flagged"]}
    return kinds | sizes | whole


def _beside(
    claim: dict[str, Any], truth: dict[str, Any], runs: Sequence[dict[str, Any]]
) -> dict[str, Any]:
    rate = truth["hits"] / truth["of"]
    rates = [each["hits"] / each["of"] for each in runs if each["of"]]
    noise = 0.0
    if len(rates) > 1:
        noise = float(t.ppf(0.975, len(rates) - 1) * np.std(rates, ddof=1) / len(rates) ** 0.5)
    low, high = claim["low"], claim["high"]
    exact = Rate(claim["hits"], claim["of"]).interval
    return {
        "low": low, "high": high, "truth": rate, "noise": noise, "covered": low <= rate <= high,
        "near": low - noise <= rate <= high + noise, "width": high - low,
        "exact": exact[0] <= rate <= exact[1], "exact_width": exact[1] - exact[0],
    }  # fmt: skip


def _smallest(claim: dict[str, Any], sizes: dict[float, tuple[int, int]]) -> dict[str, Any]:
    """The truth lies between the largest size that is caught less often and the next."""
    rates = dict(zip(sizes, rising(list(sizes.values())), strict=True))
    low = max((size for size, rate in rates.items() if rate < CAUGHT), default=0.0)
    high = min((size for size, rate in rates.items() if rate >= CAUGHT), default=None)
    covered = (claim["high"] is None or (high is not None and claim["high"] >= low)) and (
        high is None or claim["low"] <= max(high, claim["planted"])  # "this or less"
    )
    return {"low": claim["low"], "high": claim["high"], "truth": [low, high], "covered": covered}


def rising(counts: Sequence[tuple[int, int]]) -> list[float]:
    """Rates that never fall from one size to the next, nearest to what was counted (isotonic)."""

    def pooled(first: int, last: int) -> float:
        part = counts[first : last + 1]
        return sum(hits for hits, _ in part) / sum(of for _, of in part)

    many = len(counts)
    return [
        max(min(pooled(a, b) for b in range(at, many)) for a in range(at + 1)) for at in range(many)
    ]


def show(found: Sequence[dict[str, Any]]) -> str:
    """The claims that hold, of those made."""
    rows = [row for lab in found for row in lab["rows"]]
    lines = [f"{len(found)} simulated laboratories, {len(rows)} claims"]
    for name in (*dict.fromkeys(row["claim"] for row in rows), "in all"):
        alike = [row for row in rows if name in (row["claim"], "in all")]
        holding = sum(row["covered"] for row in alike)
        line = f"{name:10} {holding} of {len(alike)} hold"
        if rates := [row for row in alike if "width" in row]:
            near = sum(row["near"] and not row["covered"] for row in rates)
            exact = sum(row["exact"] for row in rates)
            wide, was = (np.mean([row[key] for row in rates]) for key in ("width", "exact_width"))
            line += (
                f" ({near} of the misses near), {100 * wide:.0f} points wide; "
                f"exact ones {exact} of {len(rates)}, {100 * was:.0f} wide"
            )
        lines.append(line)
    return "\n".join(lines) + "\n"
