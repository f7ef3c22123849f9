"""A laboratory's own limit: how its readings weigh, learned from failures that it planted itself.

The shipped limits hold before any camera, so they are wide. A laboratory that has seen its own
camera's normal wells and failures may draw its own: a weight for each reading of a well, and a
limit for their sum, by kind of tip and liquid (:mod:`aegis_ot.worldmodel.limits` fits them). What
was left in the tip and what was drawn wrongly show in different readings: each has its own limit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ModelError
from ..vocabulary import KeyframeKind
from .delivery import Shown
from .models import ModelFile
from .types import TrajectorySample
from .usual import LEFT

if TYPE_CHECKING:
    from .gates import GateInput

Array = NDArray[np.float64]

_SIGNS = (
    "retained", "undelivered", "gap_lit", "gap_aspirate", "gap_transit", "overfull", "underfull",
    "absent", "pair",
)  # fmt: skip

READINGS = (
    "left", "excess", "broken", "more", "less", "empty", "unshown", *_SIGNS,
    *(f"dry below {100 * height:g} %" for height in LEFT),
    *(f"wet below {100 * height:g} %" for height in LEFT),
)  # fmt: skip
"""What is weighed. Of the column: left after the dispense, more, less or nothing in transit,
as shares of the volume; how far rows speak for liquid left; how far a stretch of it does not
change as it leaves; whether it is seen to leave. Then the scorer's signs, and how dry the rows are
in transit and how wet after the dispense, below heights of the full column. More is worse."""

_EITHER = ("unshown", "pair")
AFTER = (
    "left", "excess", "retained", "undelivered", *_EITHER,
    *(name for name in READINGS if name.startswith("wet")),
)  # fmt: skip
"""Those that speak of liquid left in the tip."""

LOADED = tuple(name for name in READINGS if name not in AFTER or name in _EITHER)
"""Those that speak of what was drawn."""

_MOST = 4.0
"""Spreads from the usual beyond which a reading says no more."""


@dataclass(frozen=True)
class LabLimit:
    """Of one kind of tip and liquid.

    Attributes:
        weights: ``(readings,)`` Log odds per spread, at least 0.
        usual, spread: ``(readings,)`` Of the laboratory's wells.
        bias: Log odds of a well whose readings are all usual.
        limit: Log odds from which a well is beyond it.
    """

    weights: Array
    usual: Array
    spread: Array
    bias: float
    limit: float

    def log_odds(self, readings: Array) -> Array:
        """Of wells ``(wells, readings)``; a reading that could not be told (``nan``) is usual."""
        known = np.where(np.isnan(readings), self.usual, readings)
        strayed = np.clip((known - self.usual) / self.spread, -_MOST, _MOST)
        return np.asarray(strayed @ self.weights + self.bias, dtype=np.float64)


class LabLimits:
    """All limits of a laboratory, by class of tip and liquid."""

    def __init__(self, limits: Mapping[tuple[str, str], Sequence[LabLimit]]) -> None:
        self.limits = dict(limits)

    def beyond(self, case: GateInput, wet: Mapping[KeyframeKind, tuple[float, ...]]) -> float:
        """How far a well is beyond any of its liquid's limits, log odds; 0 or less: it is not, or
        there is no limit for this liquid."""
        limits = self.limits.get(limit_key(case.sample))
        if not limits:
            return 0.0
        told = readings_of(case, wet)[None]
        return max(float(limit.log_odds(told)[0]) - limit.limit for limit in limits)

    def to_arrays(self) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
        """Arrays and settings for a model file."""
        arrays: dict[str, NDArray[Any]] = {}
        several = [(key, limit) for key, limits in self.limits.items() for limit in limits]
        for number, (_, limit) in enumerate(several):
            rows = np.stack([limit.weights, limit.usual, limit.spread], axis=1)
            arrays[f"lab/{number}"] = np.vstack([rows, [limit.bias, limit.limit, 0.0]])
        if not arrays:
            return {}, {}
        return arrays, {"lab": {"readings": READINGS, "of": [list(key) for key, _ in several]}}

    @classmethod
    def from_model(cls, model: ModelFile) -> LabLimits:
        """From a model file; none of a file that has none.

        Raises:
            ModelError: They weigh readings that this version does not take, or are garbled.
        """
        told = model.settings.get("lab")
        if told is None:
            return cls({})
        try:
            same = list(told["readings"]) == list(READINGS)
            limits: dict[tuple[str, str], list[LabLimit]] = {}
            for number, (tip, liquid) in enumerate(told["of"]):
                table = np.asarray(model.arrays[f"lab/{number}"], dtype=np.float64)
                if same and table.shape != (len(READINGS) + 1, 3):
                    raise ValueError("the shape of its arrays")
                rows, (bias, limit, _) = table[:-1].T, table[-1]
                weights, usual, spread = rows
                known = LabLimit(weights, usual, spread, float(bias), float(limit))
                limits.setdefault((str(tip), str(liquid)), []).append(known)
        except (KeyError, TypeError, ValueError) as error:
            raise ModelError(f"the model's limits lack or garble {error}; fit it anew") from error
        if not same:
            raise ModelError(
                f"the model's limits weigh other readings than this version takes (it was made by "
                f"aegis_ot {model.package}); fit it anew"
            )
        return cls(limits)


def limit_key(sample: TrajectorySample) -> tuple[str, str]:
    """Class of tip and liquid, for which a limit holds."""
    return sample.tip_class, sample.reagent


def readings_of(case: GateInput, wet: Mapping[KeyframeKind, tuple[float, ...]]) -> Array:
    """``(readings,)`` of one well, as :data:`READINGS` names them; ``nan`` where not told.

    Args:
        case: The well.
        wet: How wet the rows of a frame are, see :meth:`.column_reader.MeasuredColumns.wetness`.
    """
    volume = case.sample.volume_ul
    expected = case.sample.expected_ul
    drawn, kept = (
        expected.get(kind, 0.0) for kind in (KeyframeKind.TRANSIT, KeyframeKind.POST_DISPENSE)
    )
    full = case.readings.get(KeyframeKind.TRANSIT)
    after = case.readings.get(KeyframeKind.POST_DISPENSE)
    shown, nan = case.delivery, np.nan
    told: list[float] = []
    told.append(nan if after is None or after.vague else max(after.volume_ul - kept, 0.0) / volume)
    told.append(nan if after is None else after.excess**0.5)
    told.append(nan if shown is None or shown.unbroken is None else 1.0 - shown.unbroken)
    off = nan if full is None or full.seen is None else (full.seen.volume_ul - drawn) / volume
    told += [np.fmax(off, 0.0) if off == off else nan, np.fmax(-off, 0.0) if off == off else nan]
    vague = full is None or full.vague
    told.append(nan if full is None or vague else max(drawn - full.volume_ul, 0.0) / volume)
    told.append(nan if shown is None else _unshown(shown.shown))
    told += [case.signs[sign] ** 0.5 if sign in case.signs else nan for sign in _SIGNS]
    missing = (nan,) * len(LEFT)
    told += [1.0 - share for share in wet.get(KeyframeKind.TRANSIT, missing)]
    told += wet.get(KeyframeKind.POST_DISPENSE, missing)
    return np.array(told, dtype=np.float64)


def _unshown(shown: Shown) -> float:
    return {Shown.EMPTIED: 0.0, Shown.UNKNOWN: 0.5, Shown.FAINT: 0.5}.get(shown, 1.0)
