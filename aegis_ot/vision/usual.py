"""What a run's normal wells showed of themselves, each read before it was learned.

Their readings are the only honest measure of how far a reading can be trusted here: templates
of one pair of frames look perfect, whatever the background did between the two.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeVar

import numpy as np

from .column import Wetness

T = TypeVar("T")

LEFT = np.array([0.25, 0.5, 0.75, 1.0])
"""Shares of the column's height that are tried for what normal wells show of a column left."""

ENOUGH = 3
"""Normal wells that must have been read before they were learned, until readings are proven."""

_MEMORY = 32
_PRIOR_WEIGHT = 3.0
_PRIOR = (1.5, 0.1, 0.35)
"""Standard deviation of a frame's wetness before the run has shown it: the first over the root
of the liquid's power, within the other two. What moves a whole frame (what is behind the tip,
the lamp, a film on the wall) is about the same for all liquids, so a plain one stands out more."""

_PAIRED_PRIOR = (0.75, 0.1, 0.35)
"""The same of two frames at one place: what moves a whole frame moves the other one, too."""

_AXIS_PX = 0.9
"""How far two frames' tips are laid beside each other instead of upon each other, px: over the
bore's width, that share of a row is seen of the wall instead. With it, one normal well read by
another of its plate strays by 1.0 standard deviations (root mean square) on rendered and on
simulated plates, p20 (bore 2 px) as p1000 (6 px); without it, by 2.3 and 1.4 to 1.6."""

_LEAST_SD = 0.06

IN_ANY_LIGHT = 16.0
"""Power of a liquid that is seen in a frame 1.6 to 3 times brighter or darker than the run's too:
on simulated frames of development seeds 704 of 830 wells with liquid left in the tip were read so,
and of 279 normal ones none was misread; in fainter liquids 25 of 136, and 1 of 48."""

_MISFIT_LEAST = 3.0
_MISFIT_FACTOR = 3.0
_MISFIT_SHARE = 0.1
"""A frame whose rows look like neither an empty nor a filled tip, by this, by this multiple of what
the run's normal ones usually show and by this share of what the liquid changes, was laid beside
the tip, or something else is before it."""

_PAIR_MISFIT = 2.5
"""The same multiple of two frames at one place. On simulated frames of development seeds normal
pairs show 1.8 times the usual at most, columns left 1.3; pairs laid beside the tip 3.3 to 3.6."""

_EXPOSURE = 1.4
"""A frame this many times brighter or darker than the run's others teaches nothing, and is read
only if the liquid shows plainly."""


class Usual:
    """Readings of one run's normal wells, with one liquid."""

    def __init__(self) -> None:
        self._lights: list[float] = []
        self._dry: list[tuple[float, ...]] = []
        self._wet: list[float] = []
        self._misfits: list[float] = []

    def anew(self) -> Usual:
        """Nothing but how bright the run's frames are."""
        usual = Usual()
        usual._lights = self._lights
        return usual

    def note_light(self, light: float) -> None:
        """Median brightness of a normal well's frame."""
        _keep(self._lights, light)

    def note_full(self, share: float | None, misfit: float) -> None:
        """Mean wetness of a column that was full (``None``: not told), and how its rows fit."""
        if share is not None:
            _keep(self._wet, share - 1.0)
        _keep(self._misfits, misfit)

    def note_pair(self, misfit: float) -> None:
        """How the rows of a normal well's two frames at one place fit."""
        _keep(self._misfits, misfit)

    def note_empty(self, shares: Sequence[float]) -> None:
        """Mean wetness of an empty tip over columns of the heights :data:`LEFT`, ``nan``: not told.

        A short column is few rows in the narrow end, and strays farther than a long one.
        """
        _keep(self._dry, tuple(shares))

    def tested(self, *, full: bool) -> int:
        """How many normal tips, full or empty, were read before they were learned."""
        return len(self._wet if full else self._dry)

    def variance(
        self, wet: Wetness, bore_px: float, *, full: bool, height: float | None = 1.0
    ) -> float:
        """Of a normal frame's mean wetness over rows whose bore is ``bore_px`` wide, px.

        ``height``: of the column that they would be, as a share of the full one's; ``None``: they
        do not reach down to the orifice.
        """
        scale, low, high = _PAIRED_PRIOR if wet.paired else _PRIOR
        prior = float(np.clip(scale / math.sqrt(max(wet.power, 1e-3)), low, high)) ** 2
        if not wet.paired:
            prior += (_AXIS_PX / max(bore_px, 0.5)) ** 2
        known = self._wet if full else self._left(height)
        total = _PRIOR_WEIGHT * prior + float(np.sum(np.square(known)))
        return max(total / (_PRIOR_WEIGHT + len(known)), _LEAST_SD**2)

    def _left(self, height: float | None) -> list[float]:
        if height is None:
            return [max(0.0, *filter(math.isfinite, shares)) for shares in self._dry]
        at = int(np.argmin(np.abs(LEFT - height)))
        return [max(shares[at], 0.0) for shares in self._dry if math.isfinite(shares[at])]

    def fits(self, wet: Wetness) -> bool:
        """Whether a frame's rows look like tips, empty or filled, of this run."""
        if wet.paired and len(self._misfits) >= ENOUGH:
            return wet.misfit <= _PAIR_MISFIT * float(np.median(self._misfits))
        usual = _MISFIT_FACTOR * float(np.median(self._misfits or [0.0]))
        return wet.misfit <= max(_MISFIT_LEAST, usual, _MISFIT_SHARE * wet.power)

    def comparable(self, light: float) -> bool:
        """Whether a frame is about as bright as the run's others."""
        return len(self._lights) < ENOUGH or alike(light, float(np.median(self._lights)))

    def readable(self, wet: Wetness, light: float) -> bool:
        """Whether a frame of this brightness can be read; one blown out or black fits no tip."""
        return wet.power >= IN_ANY_LIGHT or self.comparable(light)


def alike(light: float, other: float) -> bool:
    """Whether two frames are about as bright as each other."""
    return 1 / _EXPOSURE < (light + 1) / (other + 1) < _EXPOSURE


def _keep(kept: list[T], value: T) -> None:
    kept.append(value)
    del kept[:-_MEMORY]
