"""The smallest retained volume that a live run would catch, from a lab's own normal wells.

A lab has normal wells in plenty and hardly any failed ones. So columns are planted into the frames
of normal ones (:mod:`.planting`), and judged as a live run judges them (:mod:`.cascade`), by a
model that never saw their plate.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import takewhile

import numpy as np

from ..progress import Progress
from ..vision.column import learn_tip
from ..vision.scorers.looks import looks
from ..vision.types import FREE, Scorer, TrajectorySample
from .cascade import run_cascade
from .leave_one_out import HeldOut, ScoredWell, hold_out
from .planting import with_retained
from .reach import Smallest

SHARES = (0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.65, 0.8, 1.0)
"""Shares of the commanded volume that are planted."""

CAUGHT = 0.9
"""Of the planted wells, how many must be caught."""

MOST = 12
"""Wells of a pipette and liquid in which columns are planted at most."""

OF_A_PLATE = 4
"""Of them from one plate at most."""

LEAD = 8
"""Normal wells with which a run begins at most before a column is planted: six calibrate it, and
from the eighth on a world model adapts no more."""

Liquid = tuple[str, str]
"""Pipette's class and reagent."""


def smallest_caught(
    normals: Sequence[TrajectorySample],
    make: Callable[[], Scorer],
    progress: Progress | None = None,
) -> list[Smallest]:
    """For each pipette and liquid with a plate of two wells to try it on, and another plate of
    that pipette to learn from.

    Args:
        normals: Normal trajectories with a tip in every frame.
        make: Makes an unfitted scorer that gives p-values.
        progress: Told how far it is.
    """
    plates = {(sample.tip_class, sample.plate) for sample in normals}
    known = [name for name, _ in plates]
    normals = [sample for sample in normals if known.count(sample.tip_class) > 1]
    if not normals:
        return []
    progress = progress or Progress()
    scales = _height_scales(normals)
    held = hold_out(normals, make, "p-value", progress)
    progress.begin("Judging the normal wells as a run does", 1)
    sound: dict[Liquid, list[bool]] = defaultdict(list)
    for well in run_cascade(held):
        if not well.calibration:
            sound[_liquid(well.sample)].append(well.flagged)
    progress.step()
    groups: dict[Liquid, list[TrajectorySample]] = defaultdict(list)
    for sample in normals:
        groups[_liquid(sample)].append(sample)
    found = []
    for liquid, samples in groups.items():
        tried = list(_to_plant(samples))
        progress.begin(f"Planting columns, {' '.join(filter(None, liquid))}", len(tried))
        least = []
        for lead, sample in tried:
            least.append(_least_caught(held, lead, sample, scales[sample.tip_class]))
            progress.step()
        if least:
            found.append(_summary(samples, least, sound[liquid]))
    return found


def _liquid(sample: TrajectorySample) -> Liquid:
    return sample.tip_class, sample.reagent


def _height_scales(normals: Sequence[TrajectorySample]) -> dict[str, float]:
    classes: dict[str, list[TrajectorySample]] = defaultdict(list)
    for sample in normals:
        classes[sample.tip_class].append(sample)
    return {
        name: learn_tip(
            [
                ({kind: look.profile for kind, look in looks(sample).items()}, sample.expected_ul)
                for sample in samples
            ],
            samples[0].tip,
        ).height_scale
        for name, samples in classes.items()
    }


def _to_plant(
    samples: Sequence[TrajectorySample],
) -> Iterator[tuple[list[TrajectorySample], TrajectorySample]]:
    """Wells to plant columns in, each with others of its plate with which its run begins."""
    plates: dict[str, list[TrajectorySample]] = defaultdict(list)
    for sample in samples:
        plates[sample.plate].append(sample)
    left = MOST
    for number, members in enumerate(plates.values()):
        share = -(-left // (len(plates) - number))  # what the plates to come leave to this one
        shown = [sample for sample in members[1:] if set(FREE) <= looks(sample).keys()]
        chosen = shown[: min(share, OF_A_PLATE)]
        left -= len(chosen)
        # Decoded once, as long as the plate is tried.
        whole = [_in_memory(sample) for sample in members[: LEAD + 1]] if chosen else []
        for sample in chosen:
            lead = [other for other in whole if other.id != sample.id]
            yield lead[:LEAD], _in_memory(sample)


def _in_memory(sample: TrajectorySample) -> TrajectorySample:
    return replace(sample, frames=dict(sample.frames))


def _least_caught(
    held: HeldOut, lead: Sequence[TrajectorySample], sample: TrajectorySample, scale: float
) -> float:
    """The smallest share planted in this well that a run catches; infinite if it misses all of it.

    Each well is planted in a run of its own, the largest column first. A run learns from what
    passes, so of what comes after a column that it missed nothing counts.
    """
    planted = [with_retained(sample, share, scale) for share in reversed(SHARES)]
    first, *wells = (ScoredWell(one, 0.0, 0.0, 0.0, False) for one in [*lead, *planted])
    judged = run_cascade(replace(held, anchors=[first], wells=wells))[len(lead) :]
    caught = list(takewhile(lambda well: well.flagged, judged))
    return caught[-1].sample.retained_fraction or 0.0 if caught else float("inf")


def _summary(
    samples: Sequence[TrajectorySample], least: Sequence[float], flagged: Sequence[bool]
) -> Smallest:
    caught = {share: float(np.mean([one <= share for one in least])) for share in SHARES}
    volume = float(np.median([sample.volume_ul for sample in samples]))
    tip = samples[0].tip
    lengths = [look.profile.length for sample in samples for look in looks(sample).values()]
    scale = float(np.median(lengths)) / tip.length_mm
    share = min((share for share in SHARES if caught[share] >= CAUGHT), default=None)
    smallest = closer = None
    if share is not None:
        smallest = share * volume
        closer = scale * tip.height_of(smallest) / tip.height_of(smallest / 2)
    return Smallest(
        *_liquid(samples[0]), volume, smallest,
        {f"{share:g}": round(value, 3) for share, value in caught.items()},
        len(least),
        scale, closer, sum(flagged), len(flagged),
    )  # fmt: skip
