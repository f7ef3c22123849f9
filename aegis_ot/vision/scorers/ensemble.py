"""The default scorer: column and patches together, as one calibrated p-value."""

from __future__ import annotations

import copy
import weakref
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import ModelError
from ..models import ModelFile
from ..types import TrajectorySample
from .aims import AIMS, aimed
from .column import ColumnReport, ColumnScorer
from .patches import PatchesScorer, describe
from .surprise import NO_TIP

_LEAST_SCALE = 1.0

_TAIL = 0.25

_OVERLAP = 0.5
"""Weight of the patches: part of what they see, the column scorer has counted already."""


@dataclass(frozen=True)
class EnsembleReport:
    """Why a trajectory has its score, as the mean of three readings.

    Attributes:
        score: ``-log p``.
        column: Surprises of the column, nats; the measurements are of the first reading, where the
            detector saw the tip's end.
        patches: Surprise of the patches, nats.
    """

    score: float
    column: ColumnReport
    patches: float


class EnsembleReading(NamedTuple):
    """What both scorers find where the tip's end is put in one place."""

    column: ColumnReport
    patches: float

    @property
    def total(self) -> float:
        """Both surprises, nats."""
        return self.column.score + _OVERLAP * self.patches


class EnsembleScorer:
    """``-log p`` of column and patches together: surprises add up, as in Fisher's method.

    The p-value of a sum x among the normals' sums is ``(1 + #{normals > x}) / (n + 1)`` in the
    lower three quarters and follows an exponential tail above: a few dozen normals have no
    95th percentile of their own, and one of them may have been mislabelled. It assumes
    that this run's normals, seen in the light of its first ones, are exchangeable with the
    normals of the fit, seen in the light of another normal of their own plate. So a score over 3
    is a p-value under 0.05 in any run: one threshold serves all plates.

    Each trajectory is read three times, with the tip's end a pixel apart (:data:`~.aims.AIMS`), and
    the mean counts: what one reading owes to the detector's error does not stand in all of them. A
    mean scatters less than one, so that a normal well passes 3 a little more seldom than said.

    Attributes:
        aims: The readings; ``(0.0,)`` for wells whose frames are gone.
    """

    name = "ensemble"

    def __init__(self) -> None:
        self.column = ColumnScorer()
        self.patches = PatchesScorer()
        self.sums: dict[str, NDArray[np.float64]] = {}
        self.aims: tuple[float, ...] = AIMS
        self._by_aim = {0.0: (self.column, self.patches)}
        # The score is asked for first, then the signs that it is made of.
        self._last: tuple[weakref.ref[TrajectorySample], EnsembleReport] | None = None

    def fit(self, normals: Sequence[TrajectorySample]) -> None:
        """Fit both scorers, then their sum on the normals as they will be used.

        Raises:
            ValueError: On an empty sequence.
        """
        self.column.fit(normals)
        self.patches.fit(normals)
        plates: dict[tuple[str, str], list[TrajectorySample]] = defaultdict(list)
        for sample in normals:
            plates[sample.tip_class, sample.plate].append(sample)
        sums: dict[str, list[float]] = defaultdict(list)
        for (name, _), members in plates.items():
            for i, sample in enumerate(members):
                other = members[(i + 1) % len(members)]
                self.column.calibrate([other] if other is not sample else [])
                column = self.column.report(sample).score
                sums[name].append(column + _OVERLAP * self.patches.left_out(sample))
        self.sums = {name: np.sort(values) for name, values in sums.items()}
        self.calibrate([])

    def calibrate(self, normals: Sequence[TrajectorySample]) -> None:
        """Adapt both scorers to a run or plate, for each reading by its own."""
        self._last = None
        # What a fit has learned is shared; what they take from the run is not.
        self._by_aim = {
            px: (copy.copy(self.column), copy.copy(self.patches))
            if px
            else (self.column, self.patches)
            for px in self.aims
        }
        for px, scorers in self._by_aim.items():
            for scorer in scorers:
                scorer.calibrate([aimed(sample, px) for sample in normals])

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
        return {**report.column.surprises, "patches": report.patches}

    def score_of_seen(self, sample: TrajectorySample) -> float:
        """The same where a frame does not show the tip, though it is on: from the others."""
        return self.report(sample).score

    def look_ahead(self, sample: TrajectorySample) -> None:
        """Work out what the first frames of a trajectory tell, while the last is still to come."""
        for px in self.aims:
            self.column.report(aimed(sample, px))
            describe(aimed(sample, px))

    def report(self, sample: TrajectorySample) -> EnsembleReport:
        """Score and what stands behind it."""
        if self._last is None or self._last[0]() is not sample:
            self._last = weakref.ref(sample), self._read(sample)
        return self._last[1]

    def _read(self, sample: TrajectorySample) -> EnsembleReport:
        name = sample.learned_as(self.sums)
        readings = [self.read(sample, px) for px in self._by_aim]
        score = float(np.mean([self._surprise(one.total, name) for one in readings]))
        column = _mean([one.column for one in readings])
        return EnsembleReport(score, column, float(np.mean([one.patches for one in readings])))

    def read(self, sample: TrajectorySample, px: float = 0.0) -> EnsembleReading:
        """One reading, without its ``-log p``."""
        column, patches = self._by_aim[px]
        moved = aimed(sample, px)
        return EnsembleReading(column.report(moved), patches.score_of_seen(moved))

    def p_value(self, sample: TrajectorySample) -> float:
        """How often a normal trajectory scores this high."""
        return float(np.exp(-self.score(sample)))

    def _surprise(self, total: float, name: str) -> float:
        known = self.sums.get(name)
        if known is None or len(known) == 0:
            return total
        n = len(known)
        start = float(np.quantile(known, 1 - _TAIL))
        if total <= start:
            # Linear between the normals, so that no two trajectories tie without need.
            places = np.concatenate(([0.0], known))
            nats = -np.log((n + 1 - np.arange(n + 1)) / (n + 1))
            return float(min(np.interp(total, places, nats), -np.log(_TAIL)))
        # The median excess of an exponential tail is log 2 times its scale, and does not mind
        # one normal of the fit that was none.
        over = known[known > start] - start
        middle = float(np.quantile(over, 0.5, method="lower")) if len(over) else 0.0
        scale = middle / np.log(2)
        return float(-np.log(_TAIL) + (total - start) / max(scale, _LEAST_SCALE))

    def to_arrays(self) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
        """Arrays and settings for a model file."""
        arrays: dict[str, NDArray[Any]] = {}
        settings: dict[str, Any] = {"pipettes": list(self.sums)}
        for part in (self.column, self.patches):
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
        try:
            scorer.column = ColumnScorer.from_model(_part(model, "column"))
            scorer.patches = PatchesScorer.from_model(_part(model, "patches"))
            scorer.sums = {
                str(name): np.sort(np.asarray(model.arrays[f"sums/{name}"], dtype=float).ravel())
                for name in model.settings["pipettes"]
            }
        except (KeyError, TypeError, ValueError) as error:
            raise ModelError(f"the ensemble model lacks or garbles {error}; fit it anew") from error
        scorer.calibrate([])
        return scorer


def _mean(columns: Sequence[ColumnReport]) -> ColumnReport:
    """What several readings say together. A column may glow in one alone, so signs differ."""
    names = {name: None for one in columns for name in one.surprises}
    surprises = {
        name: float(np.mean([one.surprises.get(name, 0.0) for one in columns])) for name in names
    }
    return replace(columns[0], score=sum(surprises.values()), surprises=surprises)


def _part(model: ModelFile, name: str) -> ModelFile:
    settings: Mapping[str, Any] = model.settings[name]
    arrays = {
        key.removeprefix(f"{name}/"): value
        for key, value in model.arrays.items()
        if key.startswith(f"{name}/")
    }
    return ModelFile(name, arrays, dict(settings))
