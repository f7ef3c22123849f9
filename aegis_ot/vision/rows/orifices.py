"""A row by its lower ends alone: before a pipette's dark head collars of real tips are faint."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from ..types import Ends
from .both_ends import LEAST_HEAT, SEEN
from .fit import PITCH_MM, STRAY, Floats, Row, fitted

_LONGEST = 0.6, 3.2
"""Lengths that a row's own steps may give its tips, times the one that is expected."""

_STEP_COST = 0.1
"""What each step between the two tips that a line is laid through costs, in heat: fewer steps hold
where two ways to number the same tips explain as much."""


_SHARED = 0.6
"""Two lines that share this many of their ends are one."""

_ENDS = 40
"""The warmest ends of a view; a row is among these."""

_FLAT = 1.5
"""Lower ends alone hardly tell a taper from a few misplaced pixels: how much a flat row is
preferred, row widths."""

_ABOVE = 0.04, 0.25
"""How far above a lower end another one may stand that is seen instead, tip lengths."""

_LEVEL = 0.04
"""By how much the tips of one row differ in that, tip lengths."""


def find_by_orifices(ends: Ends, length: float, tip_mm: float, count: int) -> Row | None:
    """The likeliest of :func:`rows_by_orifices`; ``None`` without two ends in line."""
    return next(iter(rows_by_orifices(ends, length, tip_mm, count, 1)), None)


def rows_by_orifices(ends: Ends, length: float, tip_mm: float, count: int, most: int) -> list[Row]:
    """Rows that are seen squarely, by their lower ends alone: collars before a dark head are faint.

    Nozzles stand 9 mm apart, which gives the scale, and with it the length of the tips. An end
    counts from the heat that a whole tip needs: strays of that heat seldom stand in line.

    Args:
        ends: What looks like an end of a tip, px.
        length: Of a tip, px, about: from 0.6 to 3.2 times it is tried.
        tip_mm: Of a tip, mm.
        count: Tips that there should be.
        most: Rows that are wanted.

    Returns:
        The likeliest first; no two that share most of their tips.
    """
    sure = sorted((o for o in ends.orifices if o.heat >= LEAST_HEAT), key=lambda o: -o.heat)
    tips = np.array(sorted((o.x, o.y, o.x, o.y, o.heat) for o in sure[:_ENDS])).reshape(-1, 5)
    lines: list[tuple[float, dict[int, int]]] = []
    for first, second in combinations(range(len(tips)), 2):
        for steps in range(1, count):
            step = (tips[second, :2] - tips[first, :2]) / steps
            if not _LONGEST[0] <= step[0] * tip_mm / PITCH_MM / length <= _LONGEST[1]:
                continue
            line = _in_line(tips, first, step, count)
            if len(line) > 1:
                score = sum(tips[at, 4] for at in line.values()) - _STEP_COST * steps
                lines.append((score, line))
    lines.sort(key=lambda each: -each[0])
    rows = []
    for line in _unlike(lines, most):
        wide = float(np.ptp(tips[list(line.values()), 0]))
        row = _raised(ends, fitted(tips, line, flat=_FLAT * wide), length)
        step_px = abs(float(row.middle_step[0]))
        rows.append(row.moved((0.0, -step_px * tip_mm / PITCH_MM, 0.0, 0.0)))
    return rows


def _unlike(lines: Sequence[tuple[float, dict[int, int]]], most: int) -> list[dict[int, int]]:
    """The first lines of which no two share most of their ends."""
    kept: list[dict[int, int]] = []
    for _, line in lines:
        if len(kept) == most:
            break
        ends = set(line.values())
        shared = (len(ends & set(one.values())) / min(len(ends), len(one)) for one in kept)
        if all(share < _SHARED for share in shared):
            kept.append(line)
    return kept


def _raised(ends: Ends, row: Row, length: float) -> Row:
    """The row where its ends are seen, if most of its tips have another end just above: see
    :data:`~.both_ends.SEEN`."""
    rises: list[float] = []
    for number, heat in row.heats.items():
        x, y = row.ends(number)[2:]
        step = abs(float(row.ends(number + 1)[2] - x))
        above = [
            float(y - end.y)
            for end in ends.orifices
            if abs(end.x - x) <= STRAY * step
            and _ABOVE[0] * length <= y - end.y <= _ABOVE[1] * length
            and end.heat >= SEEN * heat
        ]
        rises += [max(above)] if above else []
    usual = float(np.median(rises)) if rises else 0.0
    alike = [rise for rise in rises if abs(rise - usual) <= _LEVEL * length]
    if 2 * len(alike) <= len(row.heats):
        return row
    return row.moved((0.0, -usual, 0.0, -usual))


def _in_line(tips: Floats, first: int, step: Floats, count: int) -> dict[int, int]:
    """The warmest of what stands at each step from ``first``, within ``count`` places in all."""
    numbers = np.round((tips[:, 0] - tips[first, 0]) / step[0]).astype(int)
    off = np.abs(tips[:, :2] - tips[first, :2] - numbers[:, None] * step)
    near = (off <= STRAY * step[0]).all(axis=1) & (np.abs(numbers) < count)
    found: dict[int, int] = {}
    for at in np.flatnonzero(near):
        number = int(numbers[at])
        if number not in found or tips[at, 4] > tips[found[number], 4]:
            found[number] = int(at)
    while max(found) - min(found) >= count:  # too many: the fainter end is none
        del found[min((min(found), max(found)), key=lambda number: tips[found[number], 4])]
    return found
