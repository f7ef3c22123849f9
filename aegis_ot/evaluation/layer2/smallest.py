"""The smallest retained volume that a live run would catch, from a lab's own normal wells.

A lab has normal wells in plenty and hardly any failed ones. But each of its cycles shows the tip
full and empty before this camera: what liquid changes between the two is drawn into the frames
after the dispense, from where a smaller column would end. These frames are then judged as a live
run judges them (:mod:`.cascade`), by a model that never saw their plate.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import takewhile

import cv2
import numpy as np

from ...vision.column import Reference, TipLook, expected_top, learn_tip
from ...vision.column.strip import Array
from ...vision.column.trajectory import DELIVERED
from ...vision.reach import Smallest
from ...vision.scorers.looks import looks
from ...vision.types import FREE, Image, Scorer, TrajectorySample
from ...vocabulary import KeyframeKind
from .cascade import JudgedWell, run_cascade
from .lopo import HeldOut, ScoredWell, hold_out
from .progress import Progress

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

_MENISCUS_PX = 4.0
"""Half the length over which a meniscus shows, px."""

_SMEARED_PX = 3.0
_BESIDE_PX = (2.0, 8.0)
"""How far blur carries the colour of a column beyond the tip, px, and where its background is seen,
px outside of that."""

Liquid = tuple[str, str]
"""Pipette's class and reagent."""


@dataclass(frozen=True)
class Seen:
    """What a live run would make of one pipette and liquid.

    Attributes:
        smallest: The smallest volume that it would catch.
        sound: Normal wells that were judged, beyond those that calibrate a run.
        flagged: Of them, how many were failed or left to the operator.
    """

    smallest: Smallest
    sound: int
    flagged: int


def smallest_caught(
    normals: Sequence[TrajectorySample],
    make: Callable[[], Scorer],
    progress: Progress | None = None,
) -> list[Seen]:
    """For each pipette and liquid of these wells with two wells on a plate to try it on; empty if
    there is one plate only.

    Args:
        normals: Normal trajectories with a tip in every frame, of two plates or more.
        make: Makes an unfitted scorer that gives p-values.
        progress: Told how far it is.
    """
    if len({sample.plate for sample in normals}) < 2:
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
            smallest = _summary(samples, least, sound[liquid])
            found.append(Seen(smallest, len(sound[liquid]), sum(sound[liquid])))
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
        96.0 * float(np.mean(flagged)) if flagged else float("nan"),
        scale, closer,
    )  # fmt: skip


def with_retained(
    sample: TrajectorySample, share: float, height_scale: float = 1.0
) -> TrajectorySample:
    """A normal trajectory as if ``share`` of its volume had stayed in the tip.

    Args:
        sample: The trajectory; a tip is seen in transit and after the dispense.
        share: From 0 to 1.
        height_scale: How high columns stand before this camera, over what the geometry says.
    """
    reference = Reference(height_scale=height_scale)
    was, now = (
        expected_top(sample.tip, part * sample.volume_ul, reference) for part in (1.0, share)
    )
    seen = looks(sample)
    frames = dict(sample.frames)
    frames |= {kind: _planted(sample, kind, was, now) for kind in DELIVERED if kind in seen}
    return replace(
        sample,
        id=f"{sample.id}, {share:.0%} planted",
        label="failure",
        failure_type="partial_single",
        retained_fraction=share,
        frames=frames,
        tip_used="",  # a column that the run reports must not explain the next one
    )


def _planted(sample: TrajectorySample, kind: KeyframeKind, was: float, now: float) -> Image:
    """A frame after the dispense with what liquid adds to the empty tip, from ``now`` (u) down.

    The meniscus of the full column, at ``was``, comes to stand at its end.
    """
    here, image = looks(sample)[kind], sample.frames[kind]
    px = 1.0 / here.profile.length
    rows, columns, u, v = _places(here, image)
    radius = here.shape.radius
    added = _added(sample, here, u, v)
    moved = u + (was - now)
    meniscus = _added(sample, here, moved, v * radius(moved) / radius(u))
    added = np.where((np.abs(u - now) < _MENISCUS_PX * px)[..., None], meniscus, added)
    half = 1.1 * radius(u) + _SMEARED_PX * px
    inside = np.clip((half - np.abs(v)) / px + 0.5, 0.0, 1.0)
    inside *= (u > now - _MENISCUS_PX * px) & (u < 1.0 + _SMEARED_PX * px)
    image = image.copy()
    filled = image[rows, columns] + inside[..., None] * added
    image[rows, columns] = np.clip(np.rint(filled), 0, 255).astype(np.uint8)
    return image


def _places(look: TipLook, image: Image) -> tuple[slice, slice, Array, Array]:
    """The part of a frame around its tip, and where its pixels are: along (u), and aside (v)."""
    collar, orifice = np.array(look.collar), np.array(look.orifice)
    along, reach = orifice - collar, look.shape.half_width * look.profile.length + 12.0
    low = np.maximum(np.minimum(collar, orifice) - reach, 0.0).astype(int)
    high = (np.maximum(collar, orifice) + reach).astype(int)
    rows, columns = slice(low[1], high[1]), slice(low[0], high[0])
    height, width = image[rows, columns].shape[:2]
    y, x = np.mgrid[0:height, 0:width] + 0.5
    dx, dy = x + low[0] - collar[0], y + low[1] - collar[1]
    square = float(along @ along)
    u = ((dx * along[0] + dy * along[1]) / square).astype(np.float32)
    v = ((dx * along[1] - dy * along[0]) / square).astype(np.float32)
    return rows, columns, u, v


def _added(sample: TrajectorySample, here: TipLook, u: Array, v: Array) -> Array:
    """What the full tip shows more than the empty one at these places, in the light of ``here``.

    Both hung elsewhere: what their backgrounds differ by is taken out, row by row.
    """
    white = _white(here)
    full, empty = (
        _sampled(sample.frames[kind], look, u, v) * (white / _white(look))
        for kind in FREE
        for look in (looks(sample)[kind],)
    )
    added = full - empty
    px = 1.0 / here.profile.length
    out = (np.abs(v) - here.shape.radius(u)) / px - _SMEARED_PX
    beside = ((out > _BESIDE_PX[0]) & (out < _BESIDE_PX[1])).ravel()
    row = np.clip(np.rint((u + 1.0) / px), 0, 3.0 / px).astype(int)
    least = int(row.max()) + 1
    count = np.maximum(np.bincount(row.ravel()[beside], minlength=least), 1)
    for colour in range(3):
        behind = np.bincount(row.ravel()[beside], added[..., colour].ravel()[beside], least)
        added[..., colour] -= (behind / count)[row]
    return added


def _sampled(image: Image, look: TipLook, u: Array, v: Array) -> Array:
    (x0, y0), (x1, y1) = look.collar, look.orifice
    # cv2 puts pixel centres on integers, this project on halves.
    x = x0 + u * (x1 - x0) + v * (y1 - y0) - 0.5
    y = y0 + u * (y1 - y0) - v * (x1 - x0) - 0.5
    found = cv2.remap(image, x, y, cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(found, dtype=np.float32)


def _white(look: TipLook) -> Array:
    """Colour of the nozzle, which is lit as the tip is; ``(3,)``, BGR."""
    u, end = look.profile.u, look.shape.nozzle_end
    lanes = look.cone.shape[1]
    nozzle = look.cone[(u > 0.1 * end) & (u < 0.85 * end), lanes // 3 : -lanes // 3]
    return np.maximum(np.median(nozzle, axis=(0, 1)), 8.0).astype(np.float32)
