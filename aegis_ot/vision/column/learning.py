"""What normal trajectories teach: about a tip class, and about the run at hand."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...vocabulary import KeyframeKind
from ..tips import TipGeometry
from .evidence import EmptyColour, colour_steps, step_evidence
from .measure import Reference, ceiling, column_evidence, expected_top, read_column
from .trajectory import (
    DELIVERED,
    LOADED,
    NEAR,
    SEEN,
    Looks,
    RunReference,
    Signs,
    TipModel,
    Volumes,
)

_BLIND = 3e-3
"""Chance per row that a frame's best meniscus is none: about one frame in two."""

_LEAST_PX = 1.2
"""How well a meniscus can be placed at best, px."""

_PRIOR_WELLS = 1.5
"""Wells of a run that what earlier plates taught of a meniscus's place is worth: one reading is off
by more than plates differ. On rendered plates a first well tells 0.4 of the next one's shift."""

_SD = (0.004, 0.02)
"""Standard deviation of an empty tip's colour step: what a few dozen frames can prove, and what
still tells anything."""


def learn_run(signs: Sequence[Signs]) -> RunReference:
    """What a run's own normal wells teach, shrunk towards the tip model."""
    seen_dyes = [sign.own_dye if sign.own_dye is not None else sign.spent_dye for sign in signs]
    dyes = tuple(dye for dye in seen_dyes if dye is not None)
    shift: dict[KeyframeKind, float] = {}
    for kind in LOADED:
        seen = [s.misfill[kind] for s in signs if abs(s.misfill.get(kind, 1.0)) < NEAR]
        if seen:
            shift[kind] = float(np.median(seen)) * len(seen) / (len(seen) + _PRIOR_WELLS)
    return RunReference(dyes, shift)


def learn_tip(trajectories: Sequence[tuple[Looks, Volumes]], tip: TipGeometry) -> TipModel:
    """Fit the tip model of one tip class on normal trajectories.

    The height scale is voted for by every loaded frame, so that frames in which the meniscus
    cannot be seen do no harm; then each keyframe gets its own offset and spread.
    """
    scales = np.arange(0.4, 1.3, 0.005)
    votes = np.zeros(len(scales))
    loaded = [
        (kind, looks[kind], volumes[kind])
        for looks, volumes in trajectories
        for kind in LOADED
        if kind in looks and volumes.get(kind, 0.0) > 0
    ]
    empty = _empty_colour(trajectories, tip)
    blind = Reference(empty=empty)
    for _, look, volume in loaded:
        evidence = (column_evidence(look, tip, blind) + step_evidence(look)).astype(np.float64)
        chance = np.exp(np.clip(evidence - evidence.max(), -30.0, 0.0))
        kernel = np.exp(-0.5 * (np.arange(-6, 7) / 2.0) ** 2)
        chance = np.convolve(chance, kernel / kernel.sum(), mode="same")
        height = tip.height_of(volume) / tip.length_mm
        votes += np.log(_BLIND + np.interp(1.0 - scales * height, look.u, chance / chance.sum()))
    if not loaded or np.ptp(votes) <= 0:
        return TipModel(empty=empty)
    scale = float(scales[int(np.argmax(votes))])
    reference = Reference(empty=empty, height_scale=scale, height_sd=0.03)
    length = float(np.median([look.length for _, look, _ in loaded]))
    offset, spread = dict.fromkeys(KeyframeKind, 0.0), dict.fromkeys(KeyframeKind, 0.03)
    for wanted in LOADED:
        misses = []
        for kind, look, volume in loaded:
            found = read_column(look, tip, volume, reference) if kind is wanted else None
            if found is not None and found.presence > SEEN:
                misses.append(found.top - expected_top(tip, volume, reference))
        near = np.array([miss for miss in misses if abs(miss) < NEAR])
        if len(near) >= 4:
            offset[wanted] = float(np.median(near))
            # A high quantile, for the readings have tails: 0.85 of a normal lies within 1.44 sd.
            deviation = float(np.quantile(np.abs(near - offset[wanted]), 0.85)) / 1.44
            spread[wanted] = float(np.clip(deviation, max(0.008, _LEAST_PX / length), 0.05))
    return TipModel(scale, offset, spread, empty)


def _empty_colour(trajectories: Sequence[tuple[Looks, Volumes]], tip: TipGeometry) -> EmptyColour:
    """Colour steps along tips that were emptied."""
    steps = [
        [
            float(np.median(step.size[(step.sd < np.inf) & (np.abs(look.u - 0.75) < 0.12)]))
            for step in colour_steps(look, ceiling(tip), 0.97)
        ]
        for looks, volumes in trajectories
        for kind, look in looks.items()
        if kind in DELIVERED and volumes.get(kind, 0.0) <= 0
    ]
    if len(steps) < 6:
        return EmptyColour()
    (red, blue), (red_sd, blue_sd) = (
        np.median(steps, axis=0),
        1.48 * np.median(np.abs(steps - np.median(steps, axis=0)), axis=0),
    )
    return EmptyColour(
        float(red), float(blue), float(np.clip(red_sd, *_SD)), float(np.clip(blue_sd, *_SD))
    )
