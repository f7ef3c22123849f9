"""Which wells a synthetic data set holds, and what the tip holds at each of their keyframes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aegis_ot.errors import ConfigurationError
from aegis_ot.simulation.scene import TipContent
from aegis_ot.vocabulary import KeyframeKind

REAGENTS = ("red", "yellow", "water")

_PARTIALS = ("partial_25", "partial_50", "partial_75")
_REST = (
    *("partial_single",) * 9,
    *("partial_accumulated",) * 6,
    *("no_dispense",) * 6,
    *("air_bubble",) * 6,
)
FAILURES = (*_PARTIALS, *sorted(set(_REST)))
"""Failure types of a data set in the paper's shape, a missing tip apart."""

_KEPT = {"partial_25": 0.75, "partial_50": 0.5, "partial_75": 0.25, "no_dispense": 1.0}


@dataclass(frozen=True)
class PlannedWell:
    """One trajectory of a data set before it is rendered: ``""`` is a normal one."""

    plate: int
    reagent: str
    failure: str


def paper_plan(plates: int = 16, rng: np.random.Generator | None = None) -> list[PlannedWell]:
    """The wells of a set in the paper's shape.

    With 16 plates: 26 normal, 36 failures (25, 50 and 75 % dispensed three each, nine single and
    six accumulated partials, six without dispense, six bubbles; twelve of each kind of reagent)
    and two without a tip. Other numbers of plates keep these proportions. A plate's first well
    is normal, and it has one reagent.

    Raises:
        ConfigurationError: Fewer than one plate.
    """
    if plates < 1:
        raise ConfigurationError(f"A data set needs at least one plate, not {plates}.")
    rng = rng or np.random.default_rng(0)
    normals, failures = round(26 * plates / 16), round(36 * plates / 16)
    # Each reagent gets its share of every kind of failure.
    kinds = [*_PARTIALS * 3, *_REST] * (failures // 36 + 1)
    by_reagent: dict[str, list[str]] = {reagent: [] for reagent in REAGENTS}
    for kind in sorted(set(kinds), key=kinds.index):
        for i in range(round(kinds.count(kind) * failures / len(kinds))):
            by_reagent[REAGENTS[i % 3]].append(kind)
    short = failures - sum(len(queue) for queue in by_reagent.values())
    for i in range(max(short, 0)):
        by_reagent[REAGENTS[i % 3]].append("partial_single")
    for queue in by_reagent.values():
        rng.shuffle(queue)

    reagents = [REAGENTS[plate % 3] for plate in range(plates)]
    wells: list[list[str]] = [[""] for _ in range(plates)]
    for plate in range(normals - plates):
        wells[plate % plates].append("")
    homes = {r: [p for p in range(plates) if reagents[p] == r] or [0] for r in REAGENTS}
    for reagent, queue in by_reagent.items():
        for i, kind in enumerate(queue):
            wells[homes[reagent][i % len(homes[reagent])]].append(kind)
    for plate in range(round(2 * plates / 16)):
        wells[plate].append("no_tip")
    plan = []
    for plate, kinds_here in enumerate(wells):
        later = kinds_here[1:]
        rng.shuffle(later)
        plan += [PlannedWell(plate, reagents[plate], kind) for kind in ["", *later]]
    return plan


def normal_plan(plates: int, wells: int) -> list[PlannedWell]:
    """Plates of normal wells only: what a world model is fitted on. One reagent per plate.

    Raises:
        ConfigurationError: Fewer than one plate or well.
    """
    if plates < 1 or wells < 1:
        raise ConfigurationError(
            f"A data set needs at least one plate and one well, not {plates} and {wells}."
        )
    return [
        PlannedWell(plate, REAGENTS[plate % len(REAGENTS)], "")
        for plate in range(plates)
        for _ in range(wells)
    ]


def contents_of(
    failure: str, volume: float, rng: np.random.Generator, film: float = 0.004
) -> tuple[dict[KeyframeKind, TipContent], float | None]:
    """What a tip holds at each keyframe of one trajectory, and the retained fraction, if any.

    ``failure`` is a failure type of the data set format, empty for a normal one.
    """
    if failure == "no_tip":
        return dict.fromkeys(KeyframeKind, TipContent(present=False)), None
    drawn, gap, kept = volume, 0.0, 0.0
    before = 0.0
    if failure in _KEPT:
        kept = _KEPT[failure]
    elif failure == "partial_single":
        kept = float(rng.uniform(0.15, 0.85))
    elif failure == "partial_accumulated":
        kept = float(rng.uniform(0.15, 0.6))
        before = kept * volume * float(rng.uniform(0.3, 1.0))
    elif failure == "air_bubble":
        gap = volume * float(rng.uniform(0.03, 0.12))
        drawn = volume - gap
    elif failure == "no_aspirate":
        drawn = 0.0
    full = TipContent(
        liquid_ul=before + drawn, gap_ul=gap, gap_below_ul=drawn * float(rng.uniform(0.2, 0.7))
    )
    left = kept * volume
    wet = film * drawn
    empty = TipContent(liquid_ul=left, film_ul=wet, film_to_ul=full.liquid_ul + gap)
    states = {
        KeyframeKind.ASPIRATE: full,
        KeyframeKind.TRANSIT: full,
        KeyframeKind.DISPENSE: empty,
        KeyframeKind.POST_DISPENSE: empty,
    }
    return states, kept if kept > 0 else (1.0 if failure == "no_dispense" else None)
