"""The default scorer: what a network says of the tip's two free frames, as a calibrated p-value."""

from __future__ import annotations

import weakref
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ModelError
from ..models import ModelFile
from ..types import TrajectorySample
from .column import ColumnReport, ColumnScorer
from .pair import PairScorer, surprise_of
from .surprise import NO_TIP

_LEAST_NATS, _LEAST_ODDS = 1.0, 0.35
"""Least scale of the tail of normals: of sums of surprises, nats, and of log odds."""

_TAIL = 0.25


@dataclass(frozen=True)
class EnsembleReport:
    """Why a trajectory has its score.

    Attributes:
        score: ``-log p``.
        column: Surprises of the column, nats.
        pair: Surprise of what the network says, nats; ``None`` where it has no pair to read.
    """

    score: float
    column: ColumnReport
    pair: float | None


class EnsembleScorer:
    """``-log p`` of what the network says of the pair; of the column where there is no pair.

    The column's signs say in words what is seen, but add nothing to the pair's rank: on path-traced
    cameras that neither had seen, both together ranked worse than the pair alone.

    The p-value of a value x among the normals' is ``(1 + #{normals > x}) / (n + 1)`` in the lower
    three quarters and follows an exponential tail above: a few dozen normals have no
    95th percentile of their own, and one of them may have been mislabelled. It assumes
    that this run's normals, seen in the light of its first ones, are exchangeable with the
    normals of the fit, seen in the light of others of their own plate. So a score over 3
    is a p-value under 0.05 in any run: one threshold serves all plates.
    """

    name = "ensemble"

    def __init__(self) -> None:
        self.column = ColumnScorer()
        self.pair = PairScorer()
        self.sums: dict[str, NDArray[np.float64]] = {}
        # The score is asked for first, then the signs that it is made of.
        self._last: tuple[weakref.ref[TrajectorySample], EnsembleReport] | None = None

    def fit(self, normals: Sequence[TrajectorySample]) -> None:
        """Fit both scorers, and the column's sums on the normals as they will be used.

        Raises:
            ValueError: On an empty sequence.
        """
        self.column.fit(normals)
        self.pair.fit(normals)
        plates: dict[tuple[str, str], list[TrajectorySample]] = defaultdict(list)
        for sample in normals:
            plates[sample.tip_class, sample.plate].append(sample)
        sums: dict[str, list[float]] = defaultdict(list)
        for (name, _), members in plates.items():
            for i, sample in enumerate(members):
                other = members[(i + 1) % len(members)]
                self.column.calibrate([other] if other is not sample else [])
                sums[name].append(self.column.report(sample).score)
        self.sums = {name: np.sort(values) for name, values in sums.items()}
        self.calibrate([])

    def calibrate(self, normals: Sequence[TrajectorySample]) -> None:
        """Adapt both scorers to a run or plate."""
        self._last = None
        self.column.calibrate(normals)
        self.pair.calibrate(normals)

    def score(self, sample: TrajectorySample) -> float:
        """``-log p`` of one trajectory, >= 0. Raises :class:`ValueError` if not fitted."""
        if sample.lacks_tip:
            return NO_TIP
        return self.report(sample).score

    @property
    def height_factors(self) -> Mapping[str, float]:
        """How high columns stood in the wells of the fit, over what the geometry says."""
        return {name: model.height_scale for name, model in self.column.models.items()}

    def signs(self, sample: TrajectorySample) -> dict[str, float]:
        """Surprises behind a score, by sign, nats."""
        report = self.report(sample)
        pair = {} if report.pair is None else {"pair": report.pair}
        return {**report.column.surprises, **pair}

    def score_of_seen(self, sample: TrajectorySample) -> float:
        """The same where a frame does not show the tip, though it is on: from the others."""
        return self.report(sample).score

    def look_ahead(self, sample: TrajectorySample) -> None:
        """Work out what the first frames of a trajectory tell, while the last is still to come."""
        self.column.report(sample)

    def report(self, sample: TrajectorySample) -> EnsembleReport:
        """Score and what stands behind it."""
        if self._last is None or self._last[0]() is not sample:
            self._last = weakref.ref(sample), self._read(sample)
        return self._last[1]

    def _read(self, sample: TrajectorySample) -> EnsembleReport:
        column, reading = self.column.report(sample), self.pair.read(sample)
        if reading is None:
            known, value = self.sums.get(sample.learned_as(self.sums)), column.score
            return EnsembleReport(_surprise(value, known, _LEAST_NATS), column, None)
        known, value = self.pair.normals_like(sample), reading.wrong
        score = _surprise(value, known, _LEAST_ODDS)
        return EnsembleReport(score, column, surprise_of(reading, known))

    def p_value(self, sample: TrajectorySample) -> float:
        """How often a normal trajectory scores this high."""
        return float(np.exp(-self.score(sample)))

    def to_arrays(self) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
        """Arrays and settings for a model file."""
        arrays: dict[str, NDArray[Any]] = {}
        settings: dict[str, Any] = {"pipettes": list(self.sums)}
        for part in (self.column, self.pair):
            inner, its = part.to_arrays()
            arrays.update({f"{part.name}/{key}": value for key, value in inner.items()})
            settings[part.name] = its
        arrays.update({f"sums/{name}": values for name, values in self.sums.items()})
        return arrays, settings

    @classmethod
    def from_model(cls, model: ModelFile) -> EnsembleScorer:
        """A scorer from a model file.

        Raises:
            ModelError: If arrays are missing or their shapes do not fit.
        """
        scorer = cls()
        if "patches" in model.settings:
            raise ModelError(
                f"the ensemble model was made by aegis_ot {model.package}, which judged by patches "
                "of the tip; this version reads pairs of frames: fit it anew"
            )
        try:
            scorer.column = ColumnScorer.from_model(_part(model, "column"))
            scorer.pair = PairScorer.from_model(_part(model, "pair"))
            scorer.sums = {
                str(name): np.sort(np.asarray(model.arrays[f"sums/{name}"], dtype=float).ravel())
                for name in model.settings["pipettes"]
            }
        except (KeyError, TypeError, ValueError) as error:
            raise ModelError(f"the ensemble model lacks or garbles {error}; fit it anew") from error
        scorer.calibrate([])
        return scorer


def _surprise(value: float, known: NDArray[np.float64] | None, least_scale: float) -> float:
    """``-log p`` of a value among those of normals (sorted)."""
    if known is None or len(known) == 0:
        return max(value, 0.0)
    n = len(known)
    start = float(np.quantile(known, 1 - _TAIL))
    if value <= start:
        # Linear between the normals, so that no two trajectories tie without need.
        low = min(float(known[0]), value) - 1.0
        places = np.concatenate(([low], known))
        nats = -np.log((n + 1 - np.arange(n + 1)) / (n + 1))
        return float(min(np.interp(value, places, nats), -np.log(_TAIL)))
    # The median excess of an exponential tail is log 2 times its scale, and does not mind
    # one normal of the fit that was none.
    over = known[known > start] - start
    middle = float(np.quantile(over, 0.5, method="lower")) if len(over) else 0.0
    scale = middle / np.log(2)
    return float(-np.log(_TAIL) + (value - start) / max(scale, least_scale))


def _part(model: ModelFile, name: str) -> ModelFile:
    settings: Mapping[str, Any] = model.settings[name]
    arrays = {
        key.removeprefix(f"{name}/"): value
        for key, value in model.arrays.items()
        if key.startswith(f"{name}/")
    }
    return ModelFile(name, arrays, dict(settings))
