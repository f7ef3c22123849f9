"""Four frames, one judgement: signs that a pipetting cycle did not go as the protocol says.

The frames of one cycle explain each other. TRANSIT shows the reagent's colour, which is then
looked for after the dispense; DISPENSE and POST_DISPENSE show the same retained column at the
same height, so their evidence adds up and a glint in one of them does not count for much.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ...vocabulary import KeyframeKind
from ..tips import TipGeometry
from .breaks import lit
from .contrast import Deliveries
from .evidence import (
    ALIKE,
    IMPOSSIBLE,
    DyeColour,
    EmptyColour,
    combine,
    edge_evidence,
    mean_dye,
    taper,
)
from .measure import (
    Reference,
    ceiling,
    dye_at,
    expected_top,
    possible_tops,
    read_column,
    tip_colour_evidence,
)
from .profile import TipProfile

LOADED = (KeyframeKind.ASPIRATE, KeyframeKind.TRANSIT)
DELIVERED = (KeyframeKind.DISPENSE, KeyframeKind.POST_DISPENSE)

Looks = Mapping[KeyframeKind, TipProfile]
Volumes = Mapping[KeyframeKind, float]

_SEARCH = 0.05
"""Standard deviation of where a column is looked for around where it should end, u."""

SEEN = 3.0
"""Log-likelihood ratio from which the end of a loaded column counts as seen."""

_GLINT = 8.0
"""See :func:`~.evidence.combine`."""

_STRAY, _SHORTEST_LEFT = 0.2, 0.08
"""How far all rows of one pair stray together, as a share of what leaves a tip, and the shortest
column that is told by them, u: nearer to the orifice its rim glints."""

_ENOUGH_ABOVE = 0.1
"""Length of empty tip above a column that its colour can be compared with, u."""

NEAR = 0.06
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
    empty: EmptyColour = field(default_factory=EmptyColour)


@dataclass(frozen=True)
class RunReference:
    """What this run's own normal wells taught; nothing at first.

    Attributes:
        dyes: Colour of the full column in each of them.
        shift: Where menisci stand less where the tip model says, u.
        deliveries: What leaves the tip in them.
    """

    dyes: tuple[DyeColour, ...] = ()
    shift: Mapping[KeyframeKind, float] = field(default_factory=dict)
    deliveries: Deliveries = field(default_factory=Deliveries)


@dataclass(frozen=True)
class Signs:
    """What speaks against a trajectory; larger is worse. ``None``: could not be told.

    Attributes:
        retained: Log-likelihood ratio of a column left after the dispense, both frames; 0 where
            they speak against one. ``None`` where ``undelivered`` says it.
        undelivered: The same by what left the tip in the run's normal wells since TRANSIT.
        gap: Strength of the strongest break in the column, by keyframe.
        misfill: How far the column's end is from where it should be, by keyframe, u; negative
            values mean too much liquid.
        absent: Log-likelihood ratio of no column where there should be one.
        lit: Keyframes whose column guides light: its end, and a break in it, are sharp to see.
        own_dye: Colour of the full column from this trajectory alone: TRANSIT against the empty tip
            above.
        spent_dye: TRANSIT against the tip after the dispense: right only for a normal one.
    """

    retained: float | None
    gap: Mapping[KeyframeKind, float]
    misfill: Mapping[KeyframeKind, float]
    absent: float | None
    lit: frozenset[KeyframeKind]
    own_dye: DyeColour | None
    spent_dye: DyeColour | None
    undelivered: float | None = None


def weigh(
    looks: Looks,
    tip: TipGeometry,
    expected: Volumes,
    model: TipModel,
    run: RunReference,
    at_one_place: bool = False,
) -> Signs:
    """Weigh the frames of one trajectory, as many as there are.

    Args:
        looks: Signals of the frames in which a tip was found.
        tip: Its geometry.
        expected: Liquid that should be in the tip at each keyframe, µL.
        model: Tip model of this tip class.
        run: What this run's normal wells taught.
        at_one_place: Whether the tip hangs at the same place in TRANSIT and POST_DISPENSE.
    """
    gap: dict[KeyframeKind, float] = {}
    misfill: dict[KeyframeKind, float] = {}
    glowing: set[KeyframeKind] = set()
    own = _own_dye(looks, tip, expected, model, run)
    dye = mean_dye([*run.dyes, *([own] if own is not None else [])])
    for kind in LOADED:
        volume = expected.get(kind, 0.0)
        if kind not in looks or volume <= 0:
            continue
        # At the ASPIRATE a lit column outshines its own colour.
        known = dye if kind is KeyframeKind.TRANSIT and _coloured(dye) else None
        found = read_column(looks[kind], tip, volume, _reference(model, known))
        where = place(kind, volume, tip, model, run)
        if lit(looks[kind], where):
            glowing.add(kind)
        if found.presence > SEEN:
            misfill[kind] = found.top - where
        if found.presence > 0:
            gap[kind] = found.gap or 0.0
    undelivered = _undelivered(looks, tip, expected, model, run) if at_one_place else None
    retained = None
    if undelivered is None:
        retained = _retained(looks, tip, expected, model, run, dye)
    absent = _absent(looks, tip, expected, model, run)
    spent = _spent_dye(looks, tip, expected, model, run)
    return Signs(retained, gap, misfill, absent, frozenset(glowing), own, spent, undelivered)


def place(
    kind: KeyframeKind, volume_ul: float, tip: TipGeometry, model: TipModel, run: RunReference
) -> float:
    """Where the meniscus of a volume should stand at a keyframe, u."""
    top = expected_top(tip, volume_ul, Reference(height_scale=model.height_scale))
    return top + model.offset.get(kind, 0.0) + run.shift.get(kind, 0.0)


def _coloured(dye: DyeColour | None) -> bool:
    """Whether the reagent is known to have a colour that a tip shows."""
    return dye is not None and float(np.hypot(dye.red, dye.blue)) > max(3 * dye.sd, 0.04)


def _reference(model: TipModel, dye: DyeColour | None) -> Reference:
    return Reference(dye, model.empty, model.height_scale, _SEARCH)


def _own_dye(
    looks: Looks, tip: TipGeometry, expected: Volumes, model: TipModel, run: RunReference
) -> DyeColour | None:
    """Colour step at the place where the full column should end in TRANSIT.

    Not at the place that fits best: that would find colour in noise.
    """
    kind = KeyframeKind.TRANSIT
    volume = expected.get(kind, 0.0)
    if kind not in looks or volume <= 0:
        return None
    look = looks[kind]
    where = place(kind, volume, tip, model, run)
    if where - ceiling(tip) < _ENOUGH_ABOVE:
        return None
    return dye_at(look, tip, int(np.argmin(np.abs(look.u - where))), model.empty)


def _spent_dye(
    looks: Looks, tip: TipGeometry, expected: Volumes, model: TipModel, run: RunReference
) -> DyeColour | None:
    """Colour of the rows that were full in TRANSIT and are empty now."""
    before, after = KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE
    volume = expected.get(before, 0.0)
    if before not in looks or after not in looks or volume <= 0 or expected.get(after, 0.0) > 0:
        return None
    full, spent = looks[before], looks[after]
    rows = (full.u > place(before, volume, tip, model, run) + 0.02) & (full.u < 0.92)
    if int(rows.sum()) < 8:
        return None
    left = (full.colour[rows] - spent.colour[rows]).astype(np.float64)
    weight = taper(full.u[rows])[:, None]
    red, blue = (weight * left).sum(axis=0) / (weight**2).sum()
    # Lamp and background are the same in both, the places of the two tips are not.
    return DyeColour(float(red), float(blue), max(model.empty.red_sd, model.empty.blue_sd))


def _retained(
    looks: Looks,
    tip: TipGeometry,
    expected: Volumes,
    model: TipModel,
    run: RunReference,
    dye: DyeColour | None,
) -> float | None:
    """Ratio of a column left after the dispense."""
    seen = [kind for kind in DELIVERED if kind in looks]
    if not seen:
        return None
    reference = _reference(model, dye)
    colours = [tip_colour_evidence(looks[kind], tip, reference) for kind in seen]
    edges = [edge_evidence(looks[kind]) for kind in seen]
    # A glint in one frame alone is no meniscus. But colour in one frame is colour, for labware
    # may hide the column in the other.
    edge = combine(edges[0], edges[1], _GLINT) if len(edges) > 1 else edges[0]
    colour = sum(colours[1:], colours[0])
    if _coloured(dye):
        # A dye shows below its meniscus: without it, a bright bar is a glint.
        edge = np.minimum(edge, np.maximum(colour, 0.0))
    joint = colour + edge
    joint = np.where(possible_tops(looks[seen[-1]], tip), joint, IMPOSSIBLE)
    u = looks[seen[-1]].u
    # No more than was drawn can be left; a little more where a failure accumulates.
    full = max((expected.get(kind, 0.0) for kind in LOADED), default=0.0)
    if full > 0:
        highest = place(KeyframeKind.TRANSIT, full, tip, model, run) - NEAR
        joint = np.where(u > highest, joint, IMPOSSIBLE)
    due = max(expected.get(kind, 0.0) for kind in seen)
    if due > 0:
        # Some should be left (a multi-dispense): only more than that speaks against it.
        where = place(KeyframeKind.TRANSIT, due, tip, model, run)
        usual = float(joint[np.abs(u - where) < NEAR].max(initial=0.0))
        joint = np.where(u < where - NEAR, joint - max(usual, 0.0), IMPOSSIBLE)
    return max(float(joint.max()), 0.0)


def _undelivered(
    looks: Looks, tip: TipGeometry, expected: Volumes, model: TipModel, run: RunReference
) -> float | None:
    """Ratio of a column left after the dispense, by what left the tip in the run's normal wells."""
    before, after = KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE
    volume = expected.get(before, 0.0)
    if before not in looks or after not in looks or volume <= 0 or expected.get(after, 0.0) > 0:
        return None
    full = max(place(before, volume, tip, model, run) + NEAR, ceiling(tip))
    wet = run.deliveries.read_pair(looks[before], looks[after], full)
    return None if wet is None else wet.strongest(_STRAY, _SHORTEST_LEFT)


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
    evidence = tip_colour_evidence(look, tip, _reference(model, dye), ALIKE)
    where = place(kind, volume, tip, model, run)
    near = np.abs(look.u - where) < 2 * NEAR
    return -float(evidence[near].max(initial=IMPOSSIBLE))
