"""What fitting on its own qualification brings a laboratory: before and after, on further runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from aegis_ot.planted import LEFT
from aegis_ot.qualification.counting import Rate

JUDGES = BEFORE, AFTER = "shipped", "fitted"
"""The shipped limits, and those with the laboratory's own."""

_DRAWS = 4000


def gain_row(name: str, counts: Mapping[str, Mapping[str, Any]], is_fitted: bool) -> dict[str, Any]:
    """One laboratory.

    Args:
        name: Of the laboratory.
        counts: What a certificate says of its further runs, by judge.
        is_fitted: Whether its qualification taught anything.
    """
    return {
        "lab": name,
        "is_fitted": is_fitted,
        **{
            judge: {
                "caught": count["caught"],
                "normals_flagged": count["normals_flagged"],
                "planted": {_name_of(row): row["caught"] for row in count["rows"]},
            }
            for judge, count in counts.items()
        },
    }


def _name_of(row: Mapping[str, Any]) -> str:
    return f"{LEFT} {100 * row['share']:g} %" if row["kind"] == LEFT else str(row["kind"])


def share_gained(found: Sequence[Mapping[str, Any]]) -> tuple[float, float, float]:
    """How much of what was missed is caught after, and its 95 % interval: laboratories differ, so
    they are drawn again, not their wells (bootstrap, seeded). ``nan`` where nothing was missed."""
    before, after, planted = (
        np.array([lab[judge]["caught"][key] for lab in found], dtype=float)
        for judge, key in ((BEFORE, "hits"), (AFTER, "hits"), (BEFORE, "of"))
    )
    drawn = np.random.default_rng(0).integers(len(found), size=(_DRAWS, len(found)))
    drawn = np.vstack([np.arange(len(found)), drawn])
    missed = (planted - before)[drawn].sum(axis=1)
    gained = (after - before)[drawn].sum(axis=1)
    shares = np.divide(gained, missed, out=np.full(len(drawn), np.nan), where=missed > 0)
    if np.isnan(shares[0]):
        return (float("nan"),) * 3
    low, high = np.nanquantile(shares[1:], (0.025, 0.975))
    return float(shares[0]), float(low), float(high)


def show_gain(found: Sequence[Mapping[str, Any]]) -> str:
    """A line for each laboratory, their sums by what was planted, and the share gained."""
    lines = [f"{len(found)} simulated laboratories, before -> after fit"]
    for lab in found:
        note = "" if lab["is_fitted"] else "; its qualification taught nothing"
        lines.append(
            f"{lab['lab']}: caught {_beside([lab], 'caught')}, "
            f"normals flagged {_beside([lab], 'normals_flagged')}{note}"
        )
    planted = {name for lab in found for name in lab[BEFORE]["planted"]}
    for name in sorted(planted, key=lambda each: (not each.startswith(LEFT), len(each), each)):
        lines.append(f"{name:12} {_beside(found, 'planted', name)}")
    for name, key in (("caught", "caught"), ("flagged", "normals_flagged")):
        lines.append(f"{name:12} {_beside(found, key)}; {_intervals(found, key)}")
    share, low, high = share_gained(found)
    lines.append(
        f"of what was missed {share:.0%} is caught after "
        f"({low:.0%} to {high:.0%}, laboratories drawn again)"
    )
    return "\n".join(lines) + "\n"


def _sums(found: Sequence[Mapping[str, Any]], path: Sequence[str]) -> list[Rate]:
    sums = []
    for judge in JUDGES:
        rates = [lab[judge] for lab in found]
        for step in path:
            rates = [rate[step] for rate in rates if step in rate]
        sums.append(Rate(*(sum(rate[key] for rate in rates) for key in ("hits", "of"))))
    return sums


def _beside(found: Sequence[Mapping[str, Any]], *path: str) -> str:
    before, after = _sums(found, path)
    return f"{before.hits} -> {after.hits} of {after.of}"


def _intervals(found: Sequence[Mapping[str, Any]], *path: str) -> str:
    shown = [f"{low:.0%} to {high:.0%}" for low, high in (r.interval for r in _sums(found, path))]
    return " -> ".join(shown)
