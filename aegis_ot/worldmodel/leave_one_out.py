"""Leave one plate out: every plate is scored by a model that never saw it (paper, Methods, Data).

The model is fitted on the normals of all other plates, or of the plates of all other kinds of
camera. The held-out plate's own first normal well sets its threshold, or calibrates the scorer, and
is not scored.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ..errors import ConfigurationError, DatasetError
from ..progress import Progress
from ..vision.dataset import first_normals
from ..vision.scorers import Calibrating
from ..vision.types import Scorer, TrajectorySample

ALPHA = 0.05
"""Rate of false alarms asked of a threshold from other plates' normals."""


@dataclass(frozen=True)
class ScoredWell:
    """One well of a held-out plate.

    Attributes:
        sample: The trajectory.
        score: In the scorer's unit.
        anchor: Score of the plate's calibration well.
        standing: Score made comparable between plates; more than 0 is flagged.
        tips_missing: Whether no tip was found in a frame in which it hangs free.
        limit: Score at which the standing is 0, in the scorer's unit.
    """

    sample: TrajectorySample
    score: float
    anchor: float
    standing: float
    tips_missing: bool
    limit: float = float("nan")

    @property
    def failed(self) -> bool:
        return self.sample.label == "failure"

    @property
    def without_tip(self) -> bool:
        """Labelled as having no tip: counted apart, as in the paper."""
        return self.sample.failure_type == "no_tip"

    @property
    def flagged(self) -> bool:
        return self.standing > 0 or self.tips_missing


@dataclass(frozen=True)
class HeldOut:
    """Every plate scored by a model that never saw it.

    Attributes:
        scorer: Name of the scorer.
        gives_p_values: Whether a score is ``-log p``.
        anchors: Each plate's calibration well; it has no standing.
        wells: All other wells, plate by plate.
        models: What scored each plate; without one, nothing but its columns is judged.
    """

    scorer: str
    gives_p_values: bool
    anchors: Sequence[ScoredWell]
    wells: Sequence[ScoredWell]
    models: Mapping[str, Scorer] = field(default_factory=dict, repr=False)

    def plates(self) -> Iterator[tuple[ScoredWell, list[ScoredWell]]]:
        """Each plate's calibration well and its other wells."""
        for anchor in self.anchors:
            plate = anchor.sample.plate
            yield anchor, [well for well in self.wells if well.sample.plate == plate]


def hold_out(
    samples: Sequence[TrajectorySample],
    make: Callable[[], Scorer],
    threshold: str,
    progress: Progress | None = None,
    choose: Callable[[list[TrajectorySample]], list[TrajectorySample]] | None = None,
    kinds: Mapping[str, str] | None = None,
) -> HeldOut:
    """Score every well but the calibration wells, plate by plate.

    Args:
        samples: All trajectories of the set.
        make: Makes an unfitted scorer.
        threshold: ``"first-normal"``: a well is flagged if it scores more than the plate's
            first normal (the paper's; half of exchangeable normals do). ``"pooled"``: if it
            scores more than all but a fraction :data:`ALPHA` of other plates' normals would
            (see :func:`_pooled`). ``"p-value"``: if the scorer's own p-value, learned from the
            other plates' normals, is below :data:`ALPHA` (its score is ``-log p``).
        progress: Told of each plate.
        choose: Chooses those of the other plates' normals that are learned from; all if left
            out.
        kinds: Plates of one kind are left out together; each plate by itself if left out.

    Raises:
        ConfigurationError: If the scorer gives no p-values and they are asked for.
        DatasetError: If there are fewer than two plates, or too few normals to learn from.
    """

    def kind_of(plate: str) -> str:
        return plate if kinds is None else kinds[plate]

    like = make()
    if threshold == "p-value" and not hasattr(like, "p_value"):
        raise ConfigurationError(
            f"scorer {like.name!r} gives no p-values; use the threshold 'pooled'"
        )
    first = first_normals(samples)
    if len(first) < 2:
        raise DatasetError(
            "leaving one plate out needs at least two plates, each with a normal well; this set "
            f"has {len(first)}: record more plates, or put the recordings into one set, each "
            "under a plate name of its own"
        )
    progress = progress or Progress()
    progress.begin(f"Leaving one plate out, {like.name}", len(first))
    anchors: list[ScoredWell] = []
    wells: list[ScoredWell] = []
    models: dict[str, Scorer] = {}
    for plate, anchor_well in first.items():
        scorer = models[plate] = make()
        normals = [s for s in samples if kind_of(s.plate) != kind_of(plate) and s.label == "normal"]
        if choose is not None:
            normals = choose(normals)
        try:
            scorer.fit(normals)
        except ValueError as error:
            raise DatasetError(
                f"plate {plate!r} held out: scorer {like.name!r} cannot learn from the other "
                f"plates' {len(normals)} normal wells ({error}); record more of them"
            ) from error
        own = [sample for sample in samples if sample.plate == plate]
        first_well, *others = score_plate(scorer, anchor_well, own)
        anchors.append(first_well)
        wells += others
        progress.step()
    placed = _place(wells, like, threshold)
    return HeldOut(like.name, hasattr(like, "p_value"), anchors, placed, models)


def score_plate(
    scorer: Scorer, anchor_well: TrajectorySample, samples: Sequence[TrajectorySample]
) -> list[ScoredWell]:
    """Scores of one plate by a fitted scorer, its calibration well first; without standing."""
    if isinstance(scorer, Calibrating):
        scorer.calibrate([anchor_well])
    anchor = scorer.score(anchor_well)
    wells = []
    for sample in [anchor_well, *(sample for sample in samples if sample is not anchor_well)]:
        score = anchor if sample is anchor_well else scorer.score(sample)
        wells.append(ScoredWell(sample, score, anchor, 0.0, sample.lacks_tip))
    return wells


def score_with(
    samples: Sequence[TrajectorySample], fitted: Scorer, progress: Progress | None = None
) -> HeldOut:
    """Score every plate by one model that was fitted elsewhere.

    The threshold is the scorer's own p-value if it gives one, else each plate's first normal.
    """
    progress = progress or Progress()
    first = first_normals(samples)
    progress.begin(f"Scoring, {fitted.name}", len(first))
    anchors, wells = [], []
    for plate, anchor_well in first.items():
        own = [sample for sample in samples if sample.plate == plate]
        first_well, *others = score_plate(fitted, anchor_well, own)
        anchors.append(first_well)
        wells += others
        progress.step()
    gives = hasattr(fitted, "p_value")
    placed = _place(wells, fitted, "p-value" if gives else "first-normal")
    return HeldOut(fitted.name, gives, anchors, placed, dict.fromkeys(first, fitted))


def _place(wells: Sequence[ScoredWell], like: Scorer, threshold: str) -> list[ScoredWell]:
    if threshold == "p-value":
        limit = -float(np.log(ALPHA))
        return [replace(well, standing=well.score - limit, limit=limit) for well in wells]
    if threshold == "first-normal":
        return _first_normal(wells)
    return _pooled(wells, isinstance(like, Calibrating))


def _first_normal(wells: Sequence[ScoredWell]) -> list[ScoredWell]:
    """Standing: log of score over the calibration well's score."""
    tiny = float(np.finfo(np.float64).tiny)
    return [
        replace(
            well,
            standing=float(np.log(max(well.score, tiny)) - np.log(max(well.anchor, tiny))),
            limit=well.anchor,
        )
        for well in wells
    ]


def _pooled(wells: Sequence[ScoredWell], calibrated: bool) -> list[ScoredWell]:
    """Standing: excess over what other plates' held-out normals reach.

    A scorer that calibrates itself on the plate's first normal is taken at its word; the score
    of any other is divided by that well's. The limit for a plate comes from the normals of the
    other plates, each scored while its own plate was held out, by an exponential upper tail
    (a few dozen normals have no 95th percentile of their own). It assumes that calibrated scores
    of normals are exchangeable between plates.
    """
    values = [
        well.score if calibrated else float(np.log((well.score + 1e-9) / (well.anchor + 1e-9)))
        for well in wells
    ]
    placed = []
    for well, value in zip(wells, values, strict=True):
        others = [
            other_value
            for other, other_value in zip(wells, values, strict=True)
            if not other.failed and other.sample.plate != well.sample.plate
        ]
        most = _tail_limit(others)
        limit = most if calibrated else float(np.exp(most) * (well.anchor + 1e-9) - 1e-9)
        placed.append(replace(well, standing=value - most, limit=limit))
    return placed


def _tail_limit(values: Sequence[float]) -> float:
    if not values:
        return 0.0
    known = np.asarray(values, dtype=np.float64)
    start = float(np.quantile(known, 0.75))
    over = known[known > start] - start
    scale = float(over.mean()) if len(over) else 0.0
    return max(start + scale * float(np.log(0.25 / ALPHA)), float(np.quantile(known, 1 - ALPHA)))
