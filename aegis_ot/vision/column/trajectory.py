"""Four frames, one judgement: signs that a pipetting cycle did not go as the protocol says.

The frames of one cycle explain each other. TRANSIT shows the reagent's colour, which is then
looked for after the dispense; DISPENSE and POST_DISPENSE show the same retained column at the
same height, so their evidence adds up and a glint in one of them does not count for much.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ...vocabulary import KeyframeKind
from ..tips import TipGeometry
from .evidence import (
    IMPOSSIBLE,
    Dye,
    EmptyColour,
    combine,
    long_step,
    mean_dye,
    step_evidence,
)
from .measure import (
    ColumnMeasurement,
    Reference,
    ceiling,
    column_evidence,
    dye_at,
    expected_top,
    read_column,
)
from .profile import TipProfile
from .strip import Array

LOADED = (KeyframeKind.ASPIRATE, KeyframeKind.TRANSIT)
DELIVERED = (KeyframeKind.DISPENSE, KeyframeKind.POST_DISPENSE)

Looks = Mapping[KeyframeKind, TipProfile]
Volumes = Mapping[KeyframeKind, float]

_SEARCH = 0.05
"""Standard deviation of where a column is looked for around where it should end, u."""

_SEEN = 3.0
"""Log-likelihood ratio from which the end of a loaded column counts as seen."""

_SD = (0.004, 0.02)
"""Standard deviation of an empty tip's colour step: what a few dozen frames can prove, and what
still tells anything."""

_NEAR = 0.06
"""A meniscus this close to its expected place is the expected one, u."""


@dataclass(frozen=True)
class TipModel:
    """What earlier normal trajectories taught about one tip class.

    Attributes:
        height_scale: See :class:`~.measure.Reference`.
        offset: Where menisci stand at a keyframe less where the scale says, u.
        spread: Their standard deviation, u.
        empty: See :class:`~.measure.Reference`.
    """

    height_scale: float = 1.0
    offset: Mapping[KeyframeKind, float] = field(
        default_factory=lambda: dict.fromkeys(KeyframeKind, 0.0)
    )
    spread: Mapping[KeyframeKind, float] = field(
        default_factory=lambda: dict.fromkeys(KeyframeKind, 0.03)
    )
    empty: EmptyColour = EmptyColour()


@dataclass(frozen=True)
class RunReference:
    """What this run's own normal wells taught; nothing at first.

    Attributes:
        dyes: Colour of the full column in each of them.
        shift: Where menisci stand less where the tip model says, u.
    """

    dyes: tuple[Dye, ...] = ()
    shift: Mapping[KeyframeKind, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Signs:
    """What speaks against a trajectory; larger is worse. ``None``: could not be told.

    Attributes:
        retained: Log-likelihood ratio of a column left after the dispense, both frames; 0 where
            they speak against one.
        retained_top: Where it would end, u.
        gap: Strength of the strongest break in the column, by keyframe.
        misfill: How far the column's end is from where it should be, by keyframe, u; negative
            values mean too much liquid.
        absent: Log-likelihood ratio of no column where there should be one.
        dye: Colour of the full column, as far as it is known.
        own_dye: The same from this trajectory alone.
        measured: The column in each frame.
    """

    retained: float | None
    retained_top: float
    gap: Mapping[KeyframeKind, float]
    misfill: Mapping[KeyframeKind, float]
    absent: float | None
    dye: Dye | None
    own_dye: Dye | None
    measured: Mapping[KeyframeKind, ColumnMeasurement] = field(repr=False)


def weigh(
    looks: Looks, tip: TipGeometry, expected: Volumes, model: TipModel, run: RunReference
) -> Signs:
    """Weigh the frames of one trajectory, as many as there are.

    Args:
        looks: Signals of the frames in which a tip was found.
        tip: Its geometry.
        expected: Liquid that should be in the tip at each keyframe, µL.
        model: Tip model of this tip class.
        run: What this run's normal wells taught.
    """
    measured: dict[KeyframeKind, ColumnMeasurement] = {}
    gap: dict[KeyframeKind, float] = {}
    misfill: dict[KeyframeKind, float] = {}
    own = _own_dye(looks, tip, expected, model, run)
    dye = mean_dye([*run.dyes, *([own] if own is not None else [])])
    for kind in LOADED:
        volume = expected.get(kind, 0.0)
        if kind not in looks or volume <= 0:
            continue
        # At the ASPIRATE a lit column outshines its own colour.
        known = dye if kind is KeyframeKind.TRANSIT and _coloured(dye) else None
        found = read_column(looks[kind], tip, volume, _reference(model, known))
        measured[kind] = found
        if found.presence > _SEEN:
            misfill[kind] = found.top - place(kind, volume, tip, model, run)
        if found.presence > 0:
            gap[kind] = found.gap.strength if found.gap is not None else 0.0
    retained, top = _retained(looks, tip, expected, model, run, dye)
    for kind in DELIVERED:
        if kind in looks:
            reference = _reference(model, dye)
            volume = expected.get(kind, 0.0)
            measured[kind] = read_column(looks[kind], tip, volume, reference)
    absent = _absent(looks, tip, expected, model, run)
    return Signs(retained, top, gap, misfill, absent, dye, own, measured)


def place(
    kind: KeyframeKind, volume_ul: float, tip: TipGeometry, model: TipModel, run: RunReference
) -> float:
    """Where the meniscus of a volume should stand at a keyframe, u."""
    top = expected_top(tip, volume_ul, Reference(height_scale=model.height_scale))
    return top + model.offset.get(kind, 0.0) + run.shift.get(kind, 0.0)


def learn_run(signs: Sequence[Signs], model: TipModel) -> RunReference:
    """What a run's own normal wells teach, shrunk towards the tip model."""
    dyes = tuple(sign.own_dye for sign in signs if sign.own_dye is not None)
    shift: dict[KeyframeKind, float] = {}
    for kind in LOADED:
        seen = [s.misfill[kind] for s in signs if abs(s.misfill.get(kind, 1.0)) < _NEAR]
        if seen:
            # One reading is about as uncertain as plates differ, so the prior counts as half
            # a well.
            shift[kind] = float(np.median(seen)) * len(seen) / (len(seen) + 0.5)
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
        evidence = np.clip(column_evidence(look, tip, blind) + step_evidence(look), 0.0, 15.0)
        kernel = np.exp(-0.5 * (np.arange(-4, 5) / 1.5) ** 2)
        smooth = np.convolve(evidence, kernel / kernel.sum(), mode="same")
        height = tip.height_of(volume) / tip.length_mm
        votes += np.interp(1.0 - scales * height, look.u, smooth)
    if not loaded or votes.max() <= 0:
        return TipModel(empty=empty)
    scale = float(scales[int(np.argmax(votes))])
    reference = Reference(empty=empty, height_scale=scale, height_sd=0.03)
    offset, spread = dict.fromkeys(KeyframeKind, 0.0), dict.fromkeys(KeyframeKind, 0.03)
    for wanted in LOADED:
        misses = []
        for kind, look, volume in loaded:
            found = read_column(look, tip, volume, reference) if kind is wanted else None
            if found is not None and found.presence > _SEEN:
                misses.append(found.top - expected_top(tip, volume, reference))
        near = np.array([miss for miss in misses if abs(miss) < _NEAR])
        if len(near) >= 4:
            offset[wanted] = float(np.median(near))
            deviation = 1.48 * float(np.median(np.abs(near - offset[wanted])))
            spread[wanted] = float(np.clip(deviation, 0.008, 0.05))
    return TipModel(scale, offset, spread, empty)


def _coloured(dye: Dye | None) -> bool:
    """Whether the reagent is known to have a colour that a tip shows."""
    return dye is not None and float(np.hypot(dye.red, dye.blue)) > max(4 * dye.sd, 0.02)


def _empty_colour(
    trajectories: Sequence[tuple[Looks, Volumes]], tip: TipGeometry
) -> EmptyColour:
    """Colour steps along tips that were emptied."""
    steps = [
        [
            float(np.median(step.size[(step.sd < np.inf) & (np.abs(look.u - 0.75) < 0.12)]))
            for step in (
                long_step(look.u, look.colour[:, i], ceiling(tip), 0.97) for i in (0, 1)
            )
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


def _reference(model: TipModel, dye: Dye | None) -> Reference:
    return Reference(dye, model.empty, model.height_scale, _SEARCH)


def _own_dye(
    looks: Looks, tip: TipGeometry, expected: Volumes, model: TipModel, run: RunReference
) -> Dye | None:
    """Colour step at the place where the full column should end in TRANSIT.

    Not at the place that fits best: that would find colour in noise.
    """
    kind = KeyframeKind.TRANSIT
    volume = expected.get(kind, 0.0)
    if kind not in looks or volume <= 0:
        return None
    look = looks[kind]
    row = int(np.argmin(np.abs(look.u - place(kind, volume, tip, model, run))))
    return dye_at(look, tip, row, model.empty)


def _retained(
    looks: Looks,
    tip: TipGeometry,
    expected: Volumes,
    model: TipModel,
    run: RunReference,
    dye: Dye | None,
) -> tuple[float | None, float]:
    """The column left after the dispense: ratio and upper end."""
    seen = [kind for kind in DELIVERED if kind in looks]
    if not seen:
        return None, 1.0
    parts = [column_evidence(looks[k], tip, _reference(model, dye)) for k in seen]
    joint = combine(*parts) if len(parts) == 2 else parts[0]
    u = looks[seen[-1]].u
    # No more than was drawn can be left; a little more where a failure accumulates.
    full = max((expected.get(kind, 0.0) for kind in LOADED), default=0.0)
    if full > 0:
        highest = place(KeyframeKind.TRANSIT, full, tip, model, run) - _NEAR
        joint = np.where(u > highest, joint, IMPOSSIBLE)
    due = max(expected.get(kind, 0.0) for kind in seen)
    if due > 0:
        # Some should be left (a multi-dispense): only more than that speaks against it.
        where = place(KeyframeKind.TRANSIT, due, tip, model, run)
        usual = float(joint[np.abs(u - where) < _NEAR].max(initial=0.0))
        joint = np.where(u < where - _NEAR, joint - max(usual, 0.0), IMPOSSIBLE)
    row = int(np.argmax(joint))
    return max(float(joint[row]), 0.0), float(u[row])


def _absent(
    looks: Looks, tip: TipGeometry, expected: Volumes, model: TipModel, run: RunReference
) -> float | None:
    """No column where one should be: the run's dye is known, and is not seen in TRANSIT."""
    kind = KeyframeKind.TRANSIT
    dye = mean_dye(list(run.dyes))
    volume = expected.get(kind, 0.0)
    if kind not in looks or volume <= 0 or dye is None or not _coloured(dye):
        return None
    look: TipProfile = looks[kind]
    evidence: Array = column_evidence(look, tip, _reference(model, dye))
    where = place(kind, volume, tip, model, run)
    near = np.abs(look.u - where) < 2 * _NEAR
    return -float(evidence[near].max(initial=IMPOSSIBLE))
