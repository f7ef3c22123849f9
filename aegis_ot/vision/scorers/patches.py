"""Local patches along the tip, each compared with the nearest normals at its own place.

The column scorer knows what a column is; this one knows nothing, and so sees what no model of
a column expects: drops at the orifice, bubbles at the wall, debris. A patch is described by
contrasts against the tip around it, not by grey levels: those belong to the plate's light.
"""

from __future__ import annotations

import warnings
from collections import defaultdict
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from ...errors import ModelError
from ...vocabulary import KeyframeKind
from ..column import Reference, TipLook, expected_top
from ..column.profile import LANES
from ..models import ModelFile
from ..types import TrajectorySample
from .looks import looks
from .surprise import NO_TIP, Tail, fit_tail

ABOVE, BELOW = 8, 16
"""Patches along the tip above the expected meniscus, and below it down to the orifice."""

_SIDES = ((0.0, 0.45), (0.45, 0.95))
"""Patches across the tip: core and wall, in outer radii. Left and right count as one: the
light comes from either."""

_FEATURES = 5
_ROWS = 8
_NEIGHBOURS = 3
_WORST = 3

Array = NDArray[np.float32]


class PatchesScorer:
    """Surprise of the worst patches among normals at the same place, nats.

    Fitted bank: one descriptor per normal trajectory, keyframe and place. The distance of a
    patch is its mean distance to the three nearest normals, the plate's own normals among them
    once calibrated, over what normals show of each other there.
    """

    name = "patches"

    def __init__(self) -> None:
        self.banks: dict[str, Array] = {}
        self.scales: dict[str, Array] = {}
        self.usual: dict[str, Array] = {}
        self.tails: dict[str, Tail] = {}
        self._own: list[Array] = []
        self._left_out: dict[str, float] = {}

    def fit(self, normals: Sequence[TrajectorySample]) -> None:
        """Learn the bank, and how far normals of one plate are from those of the others.

        Raises:
            ValueError: On an empty sequence.
        """
        if not normals:
            raise ValueError("no normal trajectories to learn from")
        self.banks, self.scales, self.usual, self.tails, self._own = {}, {}, {}, {}, []
        self._left_out = {}
        classes: dict[str, list[TrajectorySample]] = defaultdict(list)
        for sample in normals:
            classes[sample.tip_class].append(sample)
        for name, samples in classes.items():
            bank = np.stack([describe(sample) for sample in samples])
            plates = np.array([sample.plate for sample in samples])
            spread = (_quantile(bank, 0.84) - _quantile(bank, 0.16))[0]
            # Places differ in what they show; a place that never shows anything is not infinitely
            # sensitive.
            typical = _quantile(spread, 0.5, (1, 2))
            self.scales[name] = np.maximum(0.5 * spread, 0.25 * typical + 1e-3).astype(np.float32)
            self.banks[name] = bank
            distances = np.stack(
                [
                    self._distances(name, bank[i], bank[_others(plates, i)], bank[:0])
                    for i in range(len(bank))
                ]
            )
            self.usual[name] = (_quantile(distances, 0.5)[0] + 0.5).astype(np.float32)
            worst = [_worst(d / self.usual[name]) for d in distances]
            self.tails[name] = fit_tail(worst, Tail(2.0, 0.4))
            self._left_out.update(
                {sample.id: value for sample, value in zip(samples, worst, strict=True)}
            )

    def calibrate(self, normals: Sequence[TrajectorySample]) -> None:
        """Let a run's own normal wells count as neighbours too."""
        self._own = [describe(sample) for sample in normals]

    def score(self, sample: TrajectorySample) -> float:
        """Surprise of one trajectory, nats, >= 0. Raises :class:`ValueError` if not fitted."""
        if sample.lacks_tip:
            return NO_TIP
        return self.score_of_seen(sample)

    def score_of_seen(self, sample: TrajectorySample) -> float:
        """The same where a frame does not show the tip, though it is on: from the others."""
        name = sample.learned_as(self.banks)
        if name not in self.banks:
            if self.banks:
                return 0.0  # a tip class that no normal showed: nothing can be said
            raise ValueError("the patches scorer was not fitted")
        own = np.stack(self._own) if self._own else self.banks[name][:0]
        distances = self._distances(name, describe(sample), self.banks[name], own)
        return self.tails[name].surprise(_worst(distances / self.usual[name]))

    def left_out(self, sample: TrajectorySample) -> float:
        """Surprise of a trajectory of the fit as if it had not been in the bank, nats."""
        name = sample.learned_as(self.banks)
        return self.tails[name].surprise(self._left_out[sample.id])

    def _distances(self, name: str, one: Array, bank: Array, own: Array) -> Array:
        """Distance of each patch to its nearest normals, ``(keyframes, places, sides)``."""
        everything = np.concatenate([bank, own]) if len(own) else bank
        if len(everything) == 0:
            return np.full(one.shape[:3], np.nan, dtype=np.float32)
        difference = (everything - one[None]) / self.scales[name][None]
        distance = np.sqrt((np.clip(difference, -6, 6) ** 2).mean(axis=-1))
        nearest = np.sort(np.where(np.isnan(distance), np.inf, distance), axis=0)
        mean = nearest[: min(_NEIGHBOURS, len(nearest))].mean(axis=0)
        return np.where(np.isfinite(mean), mean, np.nan).astype(np.float32)

    def to_arrays(self) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
        """Arrays and settings for a model file."""
        arrays: dict[str, NDArray[Any]] = {}
        for name, bank in self.banks.items():
            arrays[f"{name}/bank"] = bank.astype(np.float32)
            arrays[f"{name}/scales"] = self.scales[name]
            arrays[f"{name}/usual"] = self.usual[name]
            arrays[f"{name}/tail"] = np.array([self.tails[name].start, self.tails[name].scale])
        return arrays, {"pipettes": list(self.banks)}

    @classmethod
    def from_model(cls, model: ModelFile) -> PatchesScorer:
        """A scorer from a model file.

        Raises:
            ModelError: If arrays are missing or their shapes do not fit.
        """
        scorer = cls()
        shape = (len(KeyframeKind), ABOVE + BELOW, len(_SIDES))
        try:
            for name in model.settings["pipettes"]:
                bank = np.asarray(model.arrays[f"{name}/bank"], dtype=np.float32)
                scales = np.asarray(model.arrays[f"{name}/scales"], dtype=np.float32)
                usual = np.asarray(model.arrays[f"{name}/usual"], dtype=np.float32)
                start, scale = np.asarray(model.arrays[f"{name}/tail"], dtype=float)
                if bank.shape[1:] != (*shape, _FEATURES) or scales.shape != bank.shape[1:]:
                    raise ValueError(f"the shape of {name}'s bank")
                if usual.shape != shape:
                    raise ValueError(f"the shape of {name}'s distances")
                scorer.banks[name], scorer.scales[name] = bank, scales
                scorer.usual[name], scorer.tails[name] = usual, Tail(float(start), float(scale))
        except (KeyError, TypeError, ValueError) as error:
            raise ModelError(f"the patches model lacks or garbles {error}; fit it anew") from error
        return scorer


def describe(sample: TrajectorySample) -> Array:
    """Descriptors of a trajectory, ``(keyframes, places, sides, features)``; NaN without a tip.

    Features: brightness against the places next to it, its spread within the patch, both
    colour differences against the tip as a whole, steepness along the tip. Brightness is log.
    """
    return sample.once("patches", lambda: _describe(sample))


def _describe(sample: TrajectorySample) -> Array:
    seen: Mapping[KeyframeKind, TipLook] = looks(sample)
    tip = sample.tip
    full = max(sample.expected_ul.values(), default=sample.volume_ul)
    # Above and below the full column's meniscus in every frame: after the dispense too, that
    # is where a normal tip is empty and a failed one is not.
    middle = float(np.clip(expected_top(tip, full, Reference()), 0.25, 0.85))
    parts = []
    for kind in KeyframeKind:
        if kind in seen:
            one = seen[kind]
            parts.append(one.profile.once(("patches", middle), partial(_patches, one, middle)))
        else:
            shape = (ABOVE + BELOW, len(_SIDES), _FEATURES)
            parts.append(np.full(shape, np.nan, dtype=np.float32))
    return np.stack(parts)


def _patches(look: TipLook, middle: float) -> Array:
    u, cone = look.profile.u, look.cone
    start = max(0.2, middle - 0.35)
    edges = np.concatenate(
        [np.linspace(start, middle, ABOVE + 1)[:-1], np.linspace(middle, 0.99, BELOW + 1)]
    )
    # The same number of rows for every patch, so that all are reckoned in one go.
    inner = (np.arange(_ROWS) + 0.5) / _ROWS
    at = edges[:-1, None] + np.diff(edges)[:, None] * inner[None, :]
    rows = np.clip(np.rint((at - u[0]) / (u[1] - u[0])).astype(np.intp), 0, len(u) - 1)
    grey = np.log(np.maximum(cone.mean(axis=2), 2.0))
    steep = np.abs(cv2.Sobel(grey, cv2.CV_32F, 0, 1, ksize=3)) / 8.0
    total = np.maximum(cone.sum(axis=2), 6.0)
    planes = np.stack([grey, cone[..., 2] / total, cone[..., 0] / total, steep])[:, rows]
    out = np.zeros((len(rows), len(_SIDES), _FEATURES), dtype=np.float32)
    for side, (low, high) in enumerate(_SIDES):
        lanes = (np.abs(LANES) >= low) & (np.abs(LANES) < high)
        cells = np.sort(planes[..., lanes].reshape(len(planes), len(rows), -1), axis=2)
        n = cells.shape[2]
        brightness, red, blue, slope = cells[:, :, n // 2]
        spread = cells[0, :, int(0.84 * n)] - cells[0, :, int(0.16 * n)]
        around = cv2.blur(brightness[:, None], (1, 5), borderType=cv2.BORDER_REFLECT)[:, 0]
        features = (brightness - around, spread, red - np.median(red), blue - np.median(blue))
        out[:, side] = np.stack([*features, slope], axis=1)
    return out


def _others(plates: NDArray[Any], i: int) -> NDArray[Any]:
    """Indices of the bank that stand for other plates, and the plate's own other wells."""
    return np.flatnonzero(np.arange(len(plates)) != i)


def _quantile(values: Array, share: float, axes: int | tuple[int, ...] = 0) -> Array:
    """Quantile along axes that are kept; NaN where no normal shows anything, without a warning:
    a place that labware always hides is no trouble."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "All-NaN slice", RuntimeWarning)
        found = np.nanquantile(values, share, axis=axes, keepdims=True)
    return np.asarray(found, dtype=np.float32)


def _worst(ratios: Array) -> float:
    known = np.sort(ratios[np.isfinite(ratios)])
    return float(known[-_WORST:].mean()) if len(known) else 0.0
