"""The liquid column as a scorer: what the tip holds against what the protocol expects."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ModelError
from ...vocabulary import KeyframeKind
from ..column import (
    Deliveries,
    EmptyColour,
    RunReference,
    Signs,
    TipLook,
    TipModel,
    at_one_place,
    learn_run,
    learn_tip,
    place,
    weigh,
)
from ..column.trajectory import LOADED, NEAR
from ..models import ModelFile
from ..types import FREE, TrajectorySample
from .looks import looks
from .surprise import NO_TIP, Tail, fit_tail

_MOST_MISFILL = 7.0
"""Standard deviations beyond which a meniscus elsewhere is no surer a sign: it may be another
edge."""

_SHARED = 0.7
"""Share of what many of a run's normals show that is put down to the run; the rest is chance."""

PRIORS: Mapping[str, Tail] = {
    "retained": Tail(3.0, 1.0),
    "undelivered": Tail(0.5, 1.0),
    "gap_lit": Tail(1.0, 0.8),
    "gap_aspirate": Tail(2.5, 1.0),
    "gap_transit": Tail(3.0, 2.0),
    "overfull": Tail(1.2, 1.0),
    "underfull": Tail(1.2, 1.0),
    "absent": Tail(-1.0, 1.5),
}
"""Tails before any normal is known, by sign; a fit moves their scale by half at most.

``retained`` is a log-likelihood ratio, whose tail under the null falls as exp(-x) beyond the
logarithm of the number of independent places that were searched, some twenty.
"""


@dataclass(frozen=True)
class ColumnReport:
    """Why a trajectory has its score.

    Attributes:
        score: Sum of the surprises, nats.
        surprises: By sign, nats.
        signs: The measurements behind them.
    """

    score: float
    surprises: Mapping[str, float]
    signs: Signs


class ColumnScorer:
    """Surprise of the measured column, in nats; near 0 for most normals.

    Its signs, each judged by the normals' own tail: a column left after the dispense (both frames
    together), a break in the loaded column (ASPIRATE, lit or not, and TRANSIT), a column that ends
    higher or lower than its volume says (both together), and a dye that should be there and is not.
    """

    name = "column"

    def __init__(self) -> None:
        self.models: dict[str, TipModel] = {}
        self.tails: dict[str, dict[str, Tail]] = {}
        self.run = RunReference()
        self._own: dict[str, float] = {}
        self._shared = _SHARED

    def fit(self, normals: Sequence[TrajectorySample]) -> None:
        """Learn tip model and tails for each tip class.

        Tails are learned as the scorer is used: each plate's normals are scored in the light
        of one other normal of the same plate, wherever a plate has two.

        Raises:
            ValueError: On an empty sequence.
        """
        if not normals:
            raise ValueError("no normal trajectories to learn from")
        self.run, self._own = RunReference(), {}
        self.models, self.tails = {}, {}
        classes: dict[str, list[TrajectorySample]] = defaultdict(list)
        for sample in normals:
            classes[sample.tip_class].append(sample)
        for name, samples in classes.items():
            tip = samples[0].tip
            pairs = [(_profiles(sample), sample.expected_ul) for sample in samples]
            model = learn_tip(pairs, tip)
            self.models[name] = model
            values: dict[str, list[float]] = defaultdict(list)
            for sample, run in _as_in_use(samples, model):
                for sign, value in _values(_weigh(sample, model, run), model).items():
                    if value is not None:
                        values[sign].append(value)
            self.tails[name] = {
                sign: fit_tail(values[sign], prior) for sign, prior in PRIORS.items()
            }
            # Where the dye is always plain to see, seeing it less plainly is no sign yet.
            absent = self.tails[name]["absent"]
            start = max(absent.start, PRIORS["absent"].start)
            self.tails[name]["absent"] = Tail(start, absent.scale)

    def calibrate(self, normals: Sequence[TrajectorySample]) -> None:
        """Take the reagent's colour and the menisci's places from a run's own normal wells.

        Also how far they themselves stick out: labware of a strong colour, or its edges behind
        a clear tip, look a little like a column in every well of the run.
        """
        self.run, self._own = RunReference(), {}
        if not normals:
            return
        model = self._model(normals[0])
        taught = learn_run([_weigh(sample, model, RunReference()) for sample in normals])
        self.run = replace(taught, deliveries=_deliveries(normals, model, taught))
        seen: dict[str, list[float]] = defaultdict(list)
        for sample in normals:
            for sign, value in _values(_weigh(sample, model, self.run), model).items():
                if value is not None:
                    seen[sign].append(value)
        self._own = {sign: float(np.median(values)) for sign, values in seen.items()}
        # What one well alone shows may be that well's own: an air bubble, say.
        self._shared = _SHARED * len(normals) / (len(normals) + 1)

    def score(self, sample: TrajectorySample) -> float:
        """Surprise of one trajectory, nats, >= 0."""
        if sample.lacks_tip:
            return NO_TIP
        return self.report(sample).score

    def report(self, sample: TrajectorySample) -> ColumnReport:
        """Score and everything behind it, from as many frames as there are."""
        model = self._model(sample)
        signs = _weigh(sample, model, self.run)
        tails = self.tails.get(sample.learned_as(self.tails), PRIORS)
        surprises = {
            sign: tails[sign].surprise(None if value is None else value - self._usual(sign, tails))
            for sign, value in _values(signs, model).items()
        }
        return ColumnReport(float(sum(surprises.values())), surprises, signs)

    def _usual(self, sign: str, tails: Mapping[str, Tail]) -> float:
        """How much of a sign this run's wells show, where they clearly stick out."""
        clear = tails[sign].start + 2 * tails[sign].scale
        return self._shared * max(self._own.get(sign, -np.inf) - clear, 0.0)

    def _model(self, sample: TrajectorySample) -> TipModel:
        return self.models.get(sample.learned_as(self.models), TipModel())

    def to_arrays(self) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
        """Arrays and settings for a model file."""
        arrays: dict[str, NDArray[Any]] = {}
        for name, model in self.models.items():
            arrays[f"{name}/model"] = np.array(
                [
                    model.height_scale,
                    model.empty.red,
                    model.empty.blue,
                    model.empty.red_sd,
                    model.empty.blue_sd,
                    *(model.offset[kind] for kind in KeyframeKind),
                    *(model.spread[kind] for kind in KeyframeKind),
                ]
            )
            tails = self.tails[name]
            arrays[f"{name}/tails"] = np.array(
                [(tails[sign].start, tails[sign].scale) for sign in PRIORS]
            )
        return arrays, {"signs": list(PRIORS), "pipettes": list(self.models)}

    @classmethod
    def from_model(cls, model: ModelFile) -> ColumnScorer:
        """A scorer from a model file.

        Raises:
            ModelError: If arrays are missing or their shapes do not fit.
        """
        scorer = cls()
        kinds = list(KeyframeKind)
        try:
            signs = [str(sign) for sign in model.settings["signs"]]
            for name in model.settings["pipettes"]:
                row = np.asarray(model.arrays[f"{name}/model"], dtype=float)
                tails = np.asarray(model.arrays[f"{name}/tails"], dtype=float)
                if row.shape != (5 + 2 * len(kinds),) or tails.shape != (len(signs), 2):
                    raise ValueError(f"the shape of {name}'s arrays")
                scorer.models[name] = TipModel(
                    float(row[0]),
                    dict(zip(kinds, row[5 : 5 + len(kinds)].tolist(), strict=True)),
                    dict(zip(kinds, row[5 + len(kinds) :].tolist(), strict=True)),
                    EmptyColour(*map(float, row[1:5])),
                )
                found = {s: Tail(*map(float, t)) for s, t in zip(signs, tails, strict=True)}
                scorer.tails[name] = {**PRIORS, **found}
        except (KeyError, TypeError, ValueError) as error:
            raise ModelError(f"the column model lacks or garbles {error}; fit it anew") from error
        return scorer


def _profiles(sample: TrajectorySample) -> dict[KeyframeKind, Any]:
    return {kind: look.profile for kind, look in looks(sample).items()}


def _weigh(sample: TrajectorySample, model: TipModel, run: RunReference) -> Signs:
    still = _pair(sample) is not None
    return weigh(_profiles(sample), sample.tip, sample.expected_ul, model, run, still)


def _pair(sample: TrajectorySample) -> tuple[TipLook, TipLook] | None:
    """TRANSIT and POST_DISPENSE, where the tip hangs at one place in both."""
    before, after = (looks(sample).get(kind) for kind in FREE)
    if before is None or after is None:
        return None
    still = at_one_place((before.collar, before.orifice), (after.collar, after.orifice))
    return (before, after) if still else None


def _deliveries(
    normals: Sequence[TrajectorySample], model: TipModel, run: RunReference
) -> Deliveries:
    """What leaves the tip in a run's normal wells."""
    deliveries = Deliveries()
    for sample in normals:
        pair, (drawn, kept) = _pair(sample), (sample.expected_ul.get(kind, 0.0) for kind in FREE)
        if pair is not None and drawn > 0 and kept <= 0:
            full = place(FREE[0], drawn, sample.tip, model, run)
            deliveries.learn_pair(pair[0].profile, pair[1].profile, full, NEAR)
    return deliveries


def _as_in_use(
    samples: Sequence[TrajectorySample], model: TipModel
) -> list[tuple[TrajectorySample, RunReference]]:
    """Each normal with a run reference from another normal of its plate."""
    plates: dict[str, list[TrajectorySample]] = defaultdict(list)
    for sample in samples:
        plates[sample.plate].append(sample)
    used: list[tuple[TrajectorySample, RunReference]] = []
    for members in plates.values():
        for i, sample in enumerate(members):
            if len(members) > 1:
                other = members[(i + 1) % len(members)]
                used.append((sample, learn_run([_weigh(other, model, RunReference())])))
    return used or [(sample, RunReference()) for sample in samples]


def _values(signs: Signs, model: TipModel) -> dict[str, float | None]:
    """One number per sign of :data:`PRIORS`; larger is worse."""
    values: dict[str, float | None] = {
        "retained": signs.retained,
        "undelivered": signs.undelivered,
        "absent": signs.absent,
    }
    for kind in LOADED:
        where = "lit" if kind in signs.lit else kind.value
        values[f"gap_{where}"] = signs.gap.get(kind)
    off = _misfill(signs, model)
    values["overfull"] = None if off is None else max(-off, 0.0)
    values["underfull"] = None if off is None else max(off, 0.0)
    return values


def _misfill(signs: Signs, model: TipModel) -> float | None:
    """How far below its place the loaded column ends, sd; the loaded frames together.

    The tip holds as much in the one frame as in the other, so what they agree about counts. A lit
    column proves it alone; an ASPIRATE that is not lit shows the labware's edges as well.
    """
    off = {
        kind: float(np.clip(miss / model.spread.get(kind, 0.03), -_MOST_MISFILL, _MOST_MISFILL))
        for kind, miss in signs.misfill.items()
    }
    first, second = (off.get(kind) for kind in LOADED)
    if first is None or second is None:
        alone = [kind for kind in off if kind is not KeyframeKind.ASPIRATE or kind in signs.lit]
        return off[alone[0]] if alone else None
    agree = first * second > 0
    if KeyframeKind.ASPIRATE in signs.lit:
        both = (first + second) / 2**0.5
        return both if agree and abs(both) > abs(first) else first
    return 2**0.5 * min(first, second, key=abs) if agree else 0.0
