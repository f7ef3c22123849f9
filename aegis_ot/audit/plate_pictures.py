"""Whether the change of each well between two pictures agrees with the run's record."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..vision.plate import Change
from .plate_record import RecordedPlate

Array = NDArray[np.float64]

_OFF, _DEVIATIONS = 0.25, 4.0
"""Share of the expected change, and robust standard deviations, by which a well must be off."""

_ROUNDS = 8
"""Of the robust fit."""


@dataclass(frozen=True)
class WellChange:
    """A well that contradicts the record.

    Attributes:
        well: Its name.
        score: How far it is off, by what is allowed.
        share: What it shows of the expected change, 1 for all; ``None`` if none was expected.
    """

    well: str
    score: float
    share: float | None


def contradictions(change: Change, recorded: RecordedPlate) -> list[WellChange]:
    """Wells whose colour changed otherwise than the record says, the farthest off first.

    Blinded wells, and those whose content nobody knows, are left out: the caller must say so.
    """
    names = recorded.plate.names
    wells = recorded.wells
    told = np.array(
        [not change.blinded[n] and not (name in wells and wells[name].unknown)
         for n, name in enumerate(names)]
    )  # fmt: skip
    untouched = told & np.array([name not in wells for name in names])
    base = untouched if untouched.sum() >= 3 else told
    seen = change.absorbed - np.median(change.absorbed[base], axis=0)
    noise = np.maximum(1.4826 * np.median(np.abs(seen[base]), axis=0), 0.01)
    expected = _expected({name: one.gained for name, one in wells.items()}, names, seen, told)
    size = np.linalg.norm(expected, axis=1)
    off = np.linalg.norm(seen - expected, axis=1)
    limit = np.maximum(_OFF * size, _DEVIATIONS * float(np.linalg.norm(noise)))
    found = []
    for place in np.flatnonzero(told & (off > limit)):
        share = None
        if size[place] > 0:
            share = float(seen[place] @ expected[place] / size[place] ** 2)
        found.append(WellChange(names[place], float(off[place] / limit[place]), share))
    return sorted(found, key=lambda one: -one.score)


def _expected(
    gained: Mapping[str, Mapping[str, float]],
    names: list[str],
    seen: Array,
    told: NDArray[np.bool_],
) -> Array:
    """Change that the record lets expect: each liquid's colour per µL, fitted, times its volume."""
    liquids = sorted({liquid for one in gained.values() for liquid in one})
    volumes = np.array([[gained.get(name, {}).get(one, 0.0) for one in liquids] for name in names])
    if not liquids:
        return np.zeros_like(seen)
    weight = told.astype(float)
    colours = np.zeros((len(liquids), 3))
    for _ in range(_ROUNDS):
        root = np.sqrt(weight)[:, None]
        colours = np.linalg.lstsq(volumes * root, seen * root, rcond=None)[0]
        off = np.linalg.norm(seen - volumes @ colours, axis=1)
        scale = max(1.4826 * float(np.median(off[told])), 0.01)
        weight = told / np.maximum(off / scale, 1.0) ** 2
    return np.asarray(volumes @ colours, np.float64)
