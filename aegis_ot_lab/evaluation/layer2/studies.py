"""Studies around an evaluation: how many components, and how many plates to learn from."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from aegis_ot.progress import Progress
from aegis_ot.vision.scorers.pca import PcaScorer, matrix
from aegis_ot.vision.types import Scorer, TrajectorySample
from aegis_ot.worldmodel.leave_one_out import ScoredWell, hold_out

from .metrics import auroc, f1, precision, recall

SWEEP = (2, 5, 8, 10, 12, 15, 18, 20, 25)
"""The paper's numbers of components (SI C)."""

SIZES = (2, 4, 8, 12)
"""Numbers of plates to learn from, beside all of them."""


@dataclass(frozen=True)
class SweepPoint:
    """The paper's scorer with another number of components.

    Attributes:
        components: How many.
        f1, precision, recall: At the paper's threshold.
        threshold: Median over the plates, squared reconstruction error.
    """

    components: int
    f1: float
    precision: float
    recall: float
    threshold: float


@dataclass(frozen=True)
class SizePoint:
    """AUROC of a scorer that learned from fewer plates; one value a draw of plates."""

    plates: int
    aurocs: tuple[float, ...]


def explained_variance(samples: Sequence[TrajectorySample]) -> NDArray[np.float64]:
    """Share of the normals' variance that the first 1, 2, ... components explain."""
    normals = [sample for sample in samples if sample.label == "normal"]
    pca = PcaScorer(len(normals))
    pca.fit_vectors(matrix(normals))
    return np.asarray(pca.explained, dtype=np.float64)


def component_sweep(
    samples: Sequence[TrajectorySample], progress: Progress | None = None
) -> list[SweepPoint]:
    """The paper's scorer, leave-one-plate-out, with each number of components of :data:`SWEEP`."""
    progress = progress or Progress()
    progress.begin("Component sweep, pca", len(SWEEP))
    points = []
    for components in SWEEP:
        wells = _with_tip(hold_out(samples, partial(PcaScorer, components), "first-normal").wells)
        failed, standing = _arrays(wells)
        flagged = np.array([well.flagged for well in wells], dtype=bool)
        judged = failed, standing, flagged
        anchor = float(np.median([well.anchor for well in wells]))
        points.append(
            SweepPoint(components, f1(*judged), precision(*judged), recall(*judged), anchor)
        )
        progress.step()
    return points


def sample_complexity(
    samples: Sequence[TrajectorySample],
    make: Callable[[], Scorer],
    threshold: str,
    draws: int = 3,
    progress: Progress | None = None,
) -> list[SizePoint]:
    """AUROC when the scorer learns from fewer of the other plates.

    Args:
        samples: All trajectories of the set.
        make: Makes an unfitted scorer.
        threshold: As for :func:`~.lopo.hold_out`.
        draws: Random choices of plates for each number of them.
        progress: Told of each draw.
    """
    progress = progress or Progress()
    others = len({sample.plate for sample in samples}) - 1
    sizes = [*(size for size in SIZES if size < others), others]
    progress.begin(f"Sample complexity, {make().name}", (len(sizes) - 1) * draws + 1)
    points = []
    for size in sizes:
        values = []
        for seed in range(draws if size < others else 1):
            rng = np.random.default_rng(seed)
            choose = partial(_some_plates, plates=size, rng=rng)
            held = hold_out(samples, make, threshold, choose=choose)
            failed, standing = _arrays(_with_tip(held.wells))
            values.append(auroc(failed, standing, failed))
            progress.step()
        points.append(SizePoint(size, tuple(values)))
    return points


def _with_tip(wells: Sequence[ScoredWell]) -> list[ScoredWell]:
    return [well for well in wells if not well.without_tip]


def _arrays(wells: Sequence[ScoredWell]) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    failed = np.array([well.failed for well in wells], dtype=bool)
    return failed, np.array([well.standing for well in wells], dtype=np.float64)


def _some_plates(
    normals: Sequence[TrajectorySample], plates: int, rng: np.random.Generator
) -> list[TrajectorySample]:
    names = sorted({sample.plate for sample in normals})
    chosen = set(rng.permutation(names)[:plates].tolist())
    return [sample for sample in normals if sample.plate in chosen]
