"""Whether the change of each well between two pictures agrees with the run's record.

A liquid's colour per µL is fitted over the wells that received it (Beer-Lambert: from above, dye
darkens a well by its amount), so a well is judged beside the others, and never by a liquid's name.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..vision.plate import Change
from .plate_record import RecordedPlate

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

AGREES, CONTRADICTS, UNJUDGED = "agrees", "contradicts", "unjudged"
ODD = ("lighter", "uneven")
"""Reasons of unjudged wells that a person should see close up."""

_OFF, _DEVIATIONS = 0.25, 4.0
"""Share of the expected change, and robust standard deviations, by which a well must be off."""

_LEAST_NOISE = 0.015
"""Standard deviation of a channel that is taken at least; natural logarithm of light."""

_LEAST_PER_MM, _LEAST = 0.01, 0.1
"""Change that is taken for none at least: by mm from well to well, since light falls the less
evenly the farther the plate's surface is from the well's middle; and of all plates."""

_FEW = 3
"""Wells from which on a level or a colour is theirs, and no accident of one."""

_ALONE = 0.45
"""Weight of a well in its own expectation (leverage) from which the others say too little."""

_SEEN, _HALF = 1.25, 2.0
"""Least change that can be missed, in limits: a fainter one is not told from none; and of which a
half can be."""

_ROUNDS = 8
"""Of the robust fit."""


@dataclass(frozen=True)
class WellReading:
    """What the pictures say of one well.

    Attributes:
        well: Its name.
        state: ``"agrees"``, ``"contradicts"`` or ``"unjudged"``.
        why: Of an unjudged one: ``"hidden"``, ``"unknown"`` (content), ``"alone"`` (too few others
            hold its liquid), ``"faint"`` (its liquids show too little in any well), ``"weak"`` (it
            changed, but half of its volume could look alike), ``"lighter"`` (than before: no dye
            does that) or ``"uneven"`` (only a part of it contradicts). Else ``"known"`` where the
            run had failed it, or empty.
        score: How far it is off, by what is allowed.
        share: What it shows of the expected change, 1 for all; ``None`` if none was expected.
        other: Whether its colour is off rather than its amount.
    """

    well: str
    state: str
    why: str = ""
    score: float = 0.0
    share: float | None = None
    other: bool = False


@dataclass(frozen=True)
class PlateReading:
    """All wells of a plate, row by row, and whether the filled ones became lighter instead of
    darker."""

    wells: list[WellReading]
    lighter: bool

    def of(self, state: str) -> list[WellReading]:
        """Those in a state, the farthest off first."""
        return sorted((one for one in self.wells if one.state == state), key=lambda one: -one.score)

    @property
    def shows(self) -> bool:
        """Whether any well shows the change that its liquids make elsewhere."""
        return any((one.share or 0.0) > _OFF for one in self.wells)

    @property
    def contradicting(self) -> int:
        """Wells that contradict the record and the run's own verdict."""
        return sum(one.state == CONTRADICTS and not one.why for one in self.wells)


def read_plate(change: Change, recorded: RecordedPlate) -> PlateReading:
    """Judge each well's change by what the record lets expect."""
    names, wells = recorded.plate.names, recorded.wells
    gained = [wells[name].gained if name in wells else {} for name in names]
    unknown = np.array([name in wells and wells[name].unknown for name in names])
    failed = np.array([name in wells and wells[name].failed for name in names])
    told = ~change.blinded & ~unknown
    filled = np.array([bool(one) for one in gained])
    quarters, seen, least = _beside_quiet(change.absorbed, told & ~filled, recorded)
    shows = np.linalg.norm(seen, axis=1) > least
    fitted, silent = _fitted(gained, told & ~failed, shows)
    expected, weight, known = _expected(gained, seen, fitted)
    size, off = np.linalg.norm(expected, axis=1), np.linalg.norm(seen - expected, axis=1)
    limit = np.maximum(_OFF * size, least)
    score = off / limit
    # Walls that are seen aside, glints and shadows reach some of a well, a change of content all.
    everywhere = np.linalg.norm(quarters - expected[:, None], axis=2).min(axis=1) > limit
    faint = filled & (size < _SEEN * least)
    alone = filled & ~known & (shows | faint) | fitted & (weight > _ALONE) & ~silent
    reasons = (("hidden", change.blinded), ("unknown", unknown), ("alone", alone),
               ("faint", faint & (score <= 1)),
               ("weak", filled & (size < _HALF * least) & (score <= 1)),
               ("lighter", (score > 1) & (seen.sum(axis=1) < -least)),
               ("uneven", (score > 1) & ~everywhere))  # fmt: skip
    readings = []
    for n, name in enumerate(names):
        why = next((reason for reason, holds in reasons if holds[n]), "")
        share, other = None, False
        if filled[n] and not faint[n] and (not why or why == "weak"):
            share = float(seen[n] @ expected[n] / size[n] ** 2)
            other = bool(np.linalg.norm(seen[n] - share * expected[n]) > limit[n])
        state = UNJUDGED if why else CONTRADICTS if score[n] > 1 else AGREES
        why = why or ("known" if failed[n] else "")
        readings.append(WellReading(name, state, why, float(score[n]), share, other))
    darker = seen[fitted & shows].sum(axis=1)
    return PlateReading(readings, bool(darker.size and np.median(darker) < 0))


def _beside_quiet(
    quarters: Array, quiet: Flags, recorded: RecordedPlate
) -> tuple[Array, Array, float]:
    """The change of quarters and wells beside that of wells without a delivery; the least told."""
    spread = np.full(3, _LEAST_NOISE)
    if quiet.sum() >= _FEW:
        quarters = quarters - np.median(quarters[quiet], axis=0)
    absorbed = np.median(quarters, axis=1)
    if quiet.sum() >= _FEW:
        # Of small square wells the tail counts too: some parts of the plate are read worse.
        part, deviations = (0.95, 1.96) if recorded.plate.square else (0.5, 0.6745)
        tail = np.quantile(np.abs(absorbed[quiet]), part, axis=0) / deviations
        spread = np.maximum(tail, spread)
    noise = _DEVIATIONS * float(np.linalg.norm(spread))
    return quarters, absorbed, max(noise, _LEAST, _LEAST_PER_MM * recorded.plate.pitch_mm)


def _fitted(
    gained: Sequence[Mapping[str, float]], told: Flags, shows: Flags
) -> tuple[Flags, Flags]:
    """Wells that tell the liquids' colours, and those of them whose liquids show nothing.

    Wells of the same liquids are looked at together. Where several show a change, those that show
    none got nothing, and tell no colour. Where hardly any does, the liquids are clear, or none of
    the wells got any: they tell that it is clear, unless one of the liquids shows elsewhere by
    itself.
    """
    sets: dict[frozenset[str], list[int]] = {}
    for n in np.flatnonzero(told):
        if gained[n]:
            sets.setdefault(frozenset(gained[n]), []).append(int(n))
    coloured = {
        liquids: int(shows[places].sum()) >= min(_FEW, (len(places) + 1) // 2)
        for liquids, places in sets.items()
    }
    by_itself = {liquid for liquids, seen in coloured.items() if seen and len(liquids) == 1
                 for liquid in liquids}  # fmt: skip
    fitted, silent = np.zeros_like(told), np.zeros_like(told)
    for liquids, places in sets.items():
        if coloured[liquids]:
            fitted[[n for n in places if shows[n]]] = True
        elif not liquids & by_itself:
            fitted[places] = silent[places] = True
    return fitted, silent


def _expected(
    gained: Sequence[Mapping[str, float]], seen: Array, fitted: Flags
) -> tuple[Array, Array, Flags]:
    """Change that the record lets expect: each liquid's colour per µL, fitted, times its volume.

    Returns:
        The change, ``(wells, 3)``; each well's weight in it; whether the fit tells it at all.
    """
    liquids = sorted({liquid for one in gained for liquid in one})
    volumes = np.array([[one.get(liquid, 0.0) for liquid in liquids] for one in gained])
    weight = fitted.astype(float)
    if not liquids or not fitted.any():
        return np.zeros_like(seen), weight, ~volumes.any(axis=1)
    volumes /= volumes.max()
    colours = np.zeros((len(liquids), 3))
    for _ in range(_ROUNDS):
        root = np.sqrt(weight)[:, None]
        colours = np.linalg.pinv(volumes * root) @ (seen * root)
        off = np.linalg.norm(seen - volumes @ colours, axis=1)
        scale = max(1.4826 * float(np.median(off[fitted])), _LEAST_NOISE)
        weight = fitted / np.maximum(off / scale, 1.0) ** 2
    # Without outliers' weights: a well that is off must not free the others of it.
    solve = np.linalg.pinv(volumes[fitted])
    leverage = np.einsum("ij,jk,ik->i", volumes, solve @ solve.T, volumes)
    outside = volumes - volumes @ solve @ volumes[fitted]
    return volumes @ colours, leverage, np.abs(outside).max(axis=1) < 1e-6
