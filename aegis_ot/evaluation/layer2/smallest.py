"""The smallest retained volume that a camera would let be caught, from a lab's own normal wells.

A lab has normal wells in plenty and hardly any failed ones. But each of its cycles shows the tip
full and empty before this camera: where the rows of the full tip are put into the frames after the
dispense, up to the height of a smaller column, a retained column is planted. What is planted is
judged as any other well is, its plate held out.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from ...vision.column import Reference, TipLook, expected_top, learn_tip
from ...vision.column.strip import Array
from ...vision.column.trajectory import DELIVERED
from ...vision.crops import remember
from ...vision.reach import Smallest
from ...vision.scorers.aims import AIMS, aimed, read_as
from ...vision.scorers.looks import looks
from ...vision.types import Scorer, TrajectorySample
from ...vocabulary import KeyframeKind
from .lopo import HeldOut, hold_out

SHARES = (0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.65, 0.8, 1.0)
"""Shares of the commanded volume that are planted."""

CAUGHT = 0.9
"""Of the planted wells, how many must be caught."""

WELLS = 4
"""Wells of a plate in which columns are planted at most."""

PLATES = 12
"""Plates in which columns are planted at most."""

_MENISCUS_ROWS = 5


def smallest_caught(
    normals: Sequence[TrajectorySample], make: Callable[[], Scorer]
) -> list[Smallest]:
    """For each pipette and liquid of these normal wells; empty if they are of one plate only.

    Args:
        normals: Normal trajectories with a tip in every frame, of two plates or more.
        make: Makes an unfitted scorer that gives p-values.
    """
    plates: dict[str, list[TrajectorySample]] = defaultdict(list)
    for sample in normals:
        plates[sample.plate].append(sample)
    if len(plates) < 2:
        return []
    scales = _height_scales(normals)
    planted = []
    for members in list(plates.values())[:PLATES]:
        for sample in (members[1:] or members)[:WELLS]:
            scale = scales[sample.tip_class]
            planted += [with_retained(sample, share, scale) for share in SHARES]
    held = hold_out([*normals, *planted], make, "p-value")
    groups: dict[tuple[str, str], list[TrajectorySample]] = defaultdict(list)
    for sample in normals:
        groups[sample.tip_class, sample.reagent].append(sample)
    return [
        _summary(pipette, reagent, samples, held) for (pipette, reagent), samples in groups.items()
    ]


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


def _summary(
    pipette: str, reagent: str, samples: Sequence[TrajectorySample], held: HeldOut
) -> Smallest:
    wells = [
        well
        for well in held.wells
        if (well.sample.tip_class, well.sample.reagent) == (pipette, reagent)
    ]
    normal = [well.flagged for well in wells if not well.failed]
    caught: dict[float, float] = {}
    for share in SHARES:
        flags = [well.flagged for well in wells if well.sample.retained_fraction == share]
        if flags:
            caught[share] = float(np.mean(flags))
    volume = float(np.median([sample.volume_ul for sample in samples]))
    tip = samples[0].tip
    lengths = [look.profile.length for sample in samples for look in looks(sample).values()]
    scale = float(np.median(lengths)) / tip.length_mm
    smallest = None
    for share in reversed(SHARES):
        if caught.get(share, 0.0) < CAUGHT:
            break
        smallest = share * volume
    closer = None
    if smallest is not None:
        closer = scale * tip.height_of(smallest) / tip.height_of(smallest / 2)
    return Smallest(
        pipette, reagent, volume, smallest,
        {f"{share:g}": round(value, 3) for share, value in caught.items()},
        sum(well.sample.retained_fraction == SHARES[0] for well in wells),
        96.0 * float(np.mean(normal)) if normal else float("nan"),
        scale, closer,
    )  # fmt: skip


def with_retained(
    sample: TrajectorySample, share: float, height_scale: float = 1.0
) -> TrajectorySample:
    """A normal trajectory as if ``share`` of its volume had stayed in the tip.

    ``height_scale``: how high columns stand before this camera, over what the geometry says.
    """
    failed = replace(
        sample,
        id=f"{sample.id}, {share:.0%} planted",
        label="failure",
        failure_type="partial_single",
        retained_fraction=share,
    )
    remember(failed, "looks", lambda _: _planted(sample, share, height_scale))
    for px in filter(None, AIMS):
        read_as(failed, px, _planted(aimed(sample, px), share, height_scale))
    return failed


def _planted(
    sample: TrajectorySample, share: float, height_scale: float
) -> dict[KeyframeKind, TipLook]:
    seen = dict(looks(sample))
    full, empty = seen.get(KeyframeKind.TRANSIT), seen.get(KeyframeKind.POST_DISPENSE)
    if full is None or empty is None:
        return seen
    tip, scale = sample.tip, Reference(height_scale=height_scale)
    tops = (expected_top(tip, part * sample.volume_ul, scale) for part in (1.0, share))
    was, now = (int(np.argmax(full.profile.u > top)) for top in tops)
    for kind in DELIVERED:
        if kind in seen:
            seen[kind] = _with_column(seen[kind], full, empty, was, now)
    return seen


def _with_column(look: TipLook, full: TipLook, empty: TipLook, was: int, now: int) -> TipLook:
    """``look`` with what liquid changes between ``empty`` and ``full`` from row ``now`` down.

    The meniscus of the full column, at row ``was``, comes to stand at its end.
    """
    wet, dry = full.profile, empty.profile

    def put(values: Array, filled: Array, emptied: Array) -> Array:
        changed = values.copy()
        changed[now:] += filled[now:] - emptied[now:]
        return changed

    bar = look.profile.bar.copy()
    for row in range(-_MENISCUS_ROWS, _MENISCUS_ROWS + 1):
        if 0 <= now + row < len(bar) and 0 <= was + row < len(bar):
            bar[now + row] = max(bar[now + row], wet.bar[was + row])
    profile = replace(
        look.profile,
        colour=put(look.profile.colour, wet.colour, dry.colour),
        brightness=put(look.profile.brightness, wet.brightness, dry.brightness),
        section=put(look.profile.section, wet.section, dry.section),
        bar=bar,
        known={},
    )
    return replace(look, profile=profile, cone=put(look.cone, full.cone, empty.cone))
