"""What liquid changes in a tip before this camera, row by row, learned from the run itself.

A dye colours a row of the tip; water bends what is behind it, moves the glints and hides the
bore's inner edge. All of it depends on lamp, panel, camera and tip, and all of it is the same
in the next well. So the run's own empty tips and its own filled ones are the two templates, and
each row of another frame is asked which of them it looks like (Fisher's linear discriminant).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from .profile import TipProfile
from .strip import Array

_MEMORY = 16
"""Frames that a template is made of."""

_PAIRS, _AGREEING = 3, 0.3
"""Wells from which what leaves the tip may be known, and what of it their median one seems to have
kept at most, by the others."""

_SMOOTH = 15
"""Rows over which the liquid's own look is smoothed: it changes slowly along the tip."""

_POWER_MOST = 9.0
"""Most that one row counts for: a glint, or an edge behind the tip, is no column."""

_CORRELATED = 5.0
"""Rows that say the same thing: blur, resampling, and what is behind the tip."""

NOISE = np.array([0.05] * 7 + [0.02] * 2 + [0.05])
"""Standard deviation of :func:`signals` before the run has shown its own."""

_LAG = 4
"""Rows from one to the next that is independent of it."""

_NOISE_ROWS = 150.0
"""How many rows of the run's own that counts for."""


def signals(profile: TipProfile) -> Array:
    """What tells liquid from air in each row, ``(rows, 10)``.

    Brightness across the tip, two colours, and the brightness beside the tip: the last says
    nothing about liquid, but explains what shines through.
    """
    # Against what is beside the tip: how bright the nozzle looks depends on where it is cut.
    beside = profile.background - np.median(profile.background)
    raw = np.concatenate(
        [profile.section - profile.background[:, None], 2 * profile.tint, beside[:, None]],
        axis=1,
    )
    return np.asarray(cv2.blur(raw, (1, 3)), dtype=np.float32)


def change_between(before: TipProfile, after: TipProfile) -> Array:
    """What changed in each row of one tip between two frames, ``(rows, 9)``, in standard
    deviations of such rows: usual ones, or these frames' own where they are noisier.
    """
    change = (signals(before) - signals(after))[:, :-1]
    near = np.diff(change[::_LAG], axis=0)
    own = 1.48 * np.median(np.abs(near), axis=0) / np.sqrt(2)
    return np.asarray(change / np.maximum(np.sqrt(2) * NOISE[:-1], own), dtype=np.float32)


@dataclass(frozen=True)
class Wetness:
    """Rows of one frame between the run's empty tip (0) and its filled one (1).

    Attributes:
        u: ``(rows,)`` 0 collar, 1 orifice.
        share: ``(rows,)``.
        weight: ``(rows,)`` precision of it, correlation counted; 0 where nothing is known.
        power: Typical squared distance of filled from empty, in standard deviations: how well
            this liquid shows before this camera.
        misfit: Typical squared distance of a row from all that lies between empty and filled,
            in variances: 1 where the tip was laid straight as in the other frames.
        paired: Whether it is told by what changed since another frame at the same place.
    """

    u: Array
    share: NDArray[np.float64]
    weight: NDArray[np.float64]
    power: float
    misfit: float = 1.0
    paired: bool = False

    def mean(self, low: float, high: float) -> tuple[float, float]:
        """Weighted mean share of the rows between ``low`` and ``high`` (u), and their weight."""
        rows = (self.u > low) & (self.u < high)
        total = float(self.weight[rows].sum())
        if total <= 0:
            return 0.5, 0.0
        return float(self.weight[rows] @ self.share[rows]) / total, total

    def column(self, low: float, high: float) -> float:
        """Where a column that reaches up from the orifice most likely ends (u), 1 for none.

        It ends between ``low`` and ``high``; rows above ``low`` have no say. Rows of which
        nothing is known do not lengthen it.
        """
        inside = self.u > low
        gain = np.where(inside, self.weight * (self.share - 0.5), 0.0)
        below = np.cumsum(gain[::-1])[::-1]
        ends = np.flatnonzero(inside & (self.u < high))
        if not len(ends):
            return 1.0
        most = float(below[ends].max())
        best = int(ends[np.flatnonzero(below[ends] >= most - 1e-9)[-1]])
        return float(self.u[best]) if most > 0 else 1.0

    def strongest(self, stray: float, shortest: float) -> float:
        """Log-likelihood ratio of a column that reaches up from the orifice, of the likeliest of
        those that are not shorter than ``shortest`` (u); 0 where all rows speak against one.

        ``stray``: standard deviation by which all rows of one frame are off together.
        """
        weight = np.cumsum(self.weight[::-1])
        share = np.cumsum((self.weight * self.share)[::-1]) / np.maximum(weight, 1e-9)
        ratio = (share - 0.5) / (1.0 / np.maximum(weight, 1e-9) + stray**2)
        told = ratio[(weight > 0) & (self.u[::-1] < 1.0 - shortest)]
        return max(float(told.max(initial=0.0)), 0.0)

    def bracketed(self, end: float, reach: float) -> bool:
        """Whether most rows within ``reach`` of a column's end, above it and below, are known."""
        return self.known(end - reach, end) and self.known(end, end + reach)

    def known(self, low: float, high: float) -> bool:
        """Whether anything is known of most rows between ``low`` and ``high`` (u)."""
        rows = (self.u > low) & (self.u < high)
        return bool(rows.any()) and float((self.weight[rows] > 0).mean()) > 0.5

    def longest_gap(self, low: float, high: float) -> float:
        """Strength of the strongest run of empty rows between ``low`` and ``high`` (u)."""
        best = total = 0.0
        for row in np.flatnonzero((self.u > low) & (self.u < high)):
            total = max(total, 0.0) + float(self.weight[row] * (0.5 - self.share[row]))
            best = max(best, total)
        return best


@dataclass(frozen=True)
class _Templates:
    """Empty tip, what liquid changes, and the discriminant: ``(rows, features)``.

    ``power``: squared distance of filled from empty in each row. ``precision``: inverse of the
    rows' covariance, ``(features, features)``.
    """

    dry: NDArray[np.float64]
    change: NDArray[np.float64]
    weights: NDArray[np.float64]
    power: NDArray[np.float64]
    precision: NDArray[np.float64]


class WetAndDry:
    """Empty and filled rows of one run's tips with one liquid.

    Rows are those of :class:`TipProfile`, the same for all tips of a class.
    """

    _noise = NOISE

    def __init__(self) -> None:
        self._dry: list[Array] = []
        self._wet: list[Array] = []
        self._templates: _Templates | None = None

    def learn(self, profile: TipProfile, top: float, margin: float) -> None:
        """Take a frame whose column ends at ``top`` (u; 1: an empty tip), give or take."""
        seen = signals(profile)
        u = profile.u
        above = (u < top - margin) if top < 1.0 else np.ones(len(u), dtype=bool)
        self._keep(seen, above, seen, u > top + margin)

    def _keep(
        self, dry: Array, are_dry: NDArray[np.bool_], wet: Array, are_wet: NDArray[np.bool_]
    ) -> None:
        for kept, seen, rows in ((self._dry, dry, are_dry), (self._wet, wet, are_wet)):
            if rows.any() and (not kept or kept[0].shape == seen.shape):
                kept.append(np.where(rows[:, None], seen, np.nan).astype(np.float32))
                del kept[:-_MEMORY]
        self._templates = None

    def prepare(self) -> None:
        """Do the costly part now, while the robot moves."""
        if self._templates is None and self._dry and self._wet:
            self._templates = self._make()

    def read(self, profile: TipProfile, low: float, high: float = 0.985) -> Wetness | None:
        """How wet each row between ``low`` and ``high`` (u) is; ``None`` before one was learned."""
        return self._compared(profile.u, signals(profile), low, high)

    def _compared(self, u: Array, signs: Array, low: float, high: float) -> Wetness | None:
        self.prepare()
        if self._templates is None or self._templates.dry.shape[0] != len(u):
            return None
        known = self._templates
        inside = (u > low) & (u < high) & np.isfinite(known.power)
        power = np.where(inside, known.power, 0.0)
        seen = signs - known.dry
        score = np.nan_to_num((known.weights * seen).sum(axis=1))
        share = np.where(power > 0, score / np.maximum(power, 0.5), 0.0)
        share = np.clip(share, -1.0, 2.0)
        rest = (seen - np.clip(share, 0.0, 1.0)[:, None] * known.change)[inside]
        off = np.einsum("ij,jk,ik->i", rest, known.precision, rest) / rest.shape[1]
        return Wetness(
            u,
            share,
            np.minimum(power, _POWER_MOST) / _CORRELATED,
            float(np.median(known.power[inside])) if inside.any() else 0.0,
            float(np.median(off)) if len(off) else 1.0,
        )

    def _make(self) -> _Templates | None:
        dry, spread = _median(self._dry)
        wet, _ = _median(self._wet)
        known = np.isfinite(dry).all(axis=1)
        if not (known & np.isfinite(wet).all(axis=1)).any():
            return None
        rest = (np.stack(self._dry) - dry)[:, known].reshape(-1, dry.shape[1])
        rest = rest[np.isfinite(rest).all(axis=1)].astype(np.float64)
        # A template made of few frames is itself uncertain.
        scatter = rest.T @ rest * (1.0 + 1.0 / max(spread, 1.0))
        prior = np.diag(self._noise**2) * _NOISE_ROWS
        scatter = (scatter + prior) / (len(rest) + _NOISE_ROWS)
        change = _smoothed(wet - dry)
        weights = np.linalg.solve(scatter, change.T).T
        # What liquid changes is smoothed over rows that no empty tip has shown.
        power = np.where(np.isfinite(dry).all(axis=1), (weights * change).sum(axis=1), np.nan)
        return _Templates(dry, change, weights, power, np.linalg.inv(scatter))


class Deliveries(WetAndDry):
    """What leaves the tip in this run's normal wells: a row that changes as theirs did is empty
    now, and one that does not change at all holds what it held.

    Both frames of a well are taken at one place, so that what stands behind the tip cancels.
    """

    _noise = NOISE * np.sqrt(2)

    def __init__(self) -> None:
        super().__init__()
        self._stayed: float | None = None

    def learn_pair(self, before: TipProfile, after: TipProfile, full: float, margin: float) -> None:
        """Take a well whose column ended at ``full`` (u), give or take, and left."""
        if len(after.u) == len(before.u):
            change = signals(after) - signals(before)
            everywhere = np.ones(len(change), dtype=bool)
            self._keep(change, before.u > full + margin, np.zeros_like(change), everywhere)

    def read_pair(
        self, before: TipProfile, after: TipProfile, full: float, high: float = 0.985
    ) -> Wetness | None:
        """How wet each row below ``full`` (u) still is; ``None`` while the wells learned do not
        agree about what leaves a tip."""
        if len(after.u) != len(before.u) or not self._agree():
            return None
        wet = self._compared(before.u, signals(after) - signals(before), full, high)
        return None if wet is None else replace(wet, paired=True)

    def _agree(self) -> bool:
        """Whether each well learned reads as emptied by the others: of a liquid that does not show
        all that they have in common is noise, and by that any tip reads as unchanged."""
        if len(self._dry) < _PAIRS:
            return False
        self.prepare()
        if self._templates is None:
            return False
        if self._stayed is None:
            stack = np.stack(self._dry).astype(np.float64)
            stack = stack[:, np.isfinite(stack).all(axis=(0, 2))]
            others = (stack.sum(axis=0) - stack) / (len(stack) - 1)
            weighed = others @ self._templates.precision
            left = (weighed * stack).sum(axis=(1, 2)) / np.maximum(
                (weighed * others).sum(axis=(1, 2)), 1e-9
            )
            self._stayed = 1.0 - float(np.median(left))
        return abs(self._stayed) <= _AGREEING

    def _keep(
        self, dry: Array, are_dry: NDArray[np.bool_], wet: Array, are_wet: NDArray[np.bool_]
    ) -> None:
        super()._keep(dry, are_dry, wet, are_wet)
        self._stayed = None


def _median(frames: Sequence[Array]) -> tuple[NDArray[np.float64], float]:
    """Median over frames and typical number of them; rows that none shows are NaN."""
    stack = np.stack(frames).astype(np.float64)
    count = np.isfinite(stack[:, :, 0]).sum(axis=0)
    middle = np.full(stack.shape[1:], np.nan)
    some = count > 0
    middle[some] = np.nanmedian(stack[:, some], axis=0)
    return middle, float(np.median(count[some])) if some.any() else 0.0


def _smoothed(change: NDArray[np.float64]) -> NDArray[np.float64]:
    """Smoothed along the tip; NaN where no row near by was ever full."""
    known = np.isfinite(change).all(axis=1)
    kernel = np.ones((_SMOOTH, 1))
    filled = np.where(known[:, None], change, 0.0)
    total = cv2.filter2D(filled, cv2.CV_64F, kernel, borderType=cv2.BORDER_CONSTANT)
    weight = cv2.filter2D(
        known.astype(np.float64)[:, None], cv2.CV_64F, kernel, borderType=cv2.BORDER_CONSTANT
    )
    smooth = total / np.maximum(weight, 1.0)
    return np.asarray(np.where(weight > 0.5, smooth, np.nan))
