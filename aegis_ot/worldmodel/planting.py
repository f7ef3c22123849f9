"""A retained column drawn into the frames of a normal well.

Each cycle shows the tip full and empty before its camera: what liquid changes between the two is
drawn into the frames after the dispense, down from where a smaller column would end.
"""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np

from ..vision.column import Reference, TipLook, expected_top
from ..vision.column.profile import SMEARED_PX, WHITE_LEAST
from ..vision.column.strip import Array
from ..vision.column.trajectory import DELIVERED
from ..vision.scorers.looks import looks
from ..vision.types import FREE, Image, TrajectorySample
from ..vocabulary import KeyframeKind

_MENISCUS_PX = 4.0
"""Half the length over which a meniscus shows, px."""

_BESIDE_PX = (2.0, 8.0)
"""Where the background of a column is seen, px outside of what blur carries its colour over."""

_CLEAR, _UNTOLD = 0.8, 0.1
"""Share of the background's light that comes through a tip where two frames do not tell, and how
much they have to differ to tell: squares of brightness against the nozzle's, summed over rows."""


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
    frames = dict(sample.frames)
    for kind in DELIVERED:
        if kind in looks(sample):
            frames[kind] = _planted(sample, kind, was, now)
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
    here, image = looks(sample)[kind], sample.frames[kind].copy()
    px = 1.0 / here.profile.length
    rows, columns, u, v = _places(here, image)
    radius = here.shape.radius
    moved = u + (was - now)
    finer = radius(u) / radius(moved)
    # A finer bore has a smaller meniscus, of which blur leaves less still.
    meniscus = _added(sample, here, moved, v / finer) * (finer**2)[..., None]
    at_end = np.abs(u - now) < _MENISCUS_PX * px
    added = np.where(at_end[..., None], meniscus, _added(sample, here, u, v))
    half = 1.1 * radius(u) + SMEARED_PX * px
    inside = np.clip((half - np.abs(v)) / px + 0.5, 0.0, 1.0)
    inside *= (u > now - _MENISCUS_PX * px) & (u < 1.0 + SMEARED_PX * px)
    free = looks(sample)[KeyframeKind.POST_DISPENSE]
    inside *= np.interp(u, here.profile.u, _visible(here, free))
    filled = image[rows, columns] + inside[..., None] * added
    image[rows, columns] = np.clip(np.rint(filled), 0, 255).astype(np.uint8)
    return image


def _through(sample: TrajectorySample) -> float:
    """Share of the background's light that comes through the tip, from its two empty frames."""
    first, second = (looks(sample).get(kind) for kind in DELIVERED)
    if first is None or second is None or len(first.profile.u) != len(second.profile.u):
        return _CLEAR
    one, other = first.profile, second.profile
    bore = (one.u > first.shape.nozzle_end + 0.06) & (one.u < 0.97)
    inside = (np.exp(one.brightness) - np.exp(other.brightness))[bore]
    behind = (np.exp(one.background) - np.exp(other.background))[bore]
    # Where both backgrounds are alike nothing tells.
    told = float(inside @ behind) + _CLEAR * _UNTOLD
    return float(np.clip(told / (float(behind @ behind) + _UNTOLD), 0.0, 1.0))


def _visible(here: TipLook, free: TipLook) -> Array:
    """How much of the tip is seen in a frame where labware may hide it, row by row, 0 to 1.

    Measured by its own walls: as far as the pattern across it is that of the tip that hangs free.
    """
    seen, whole = (look.cone - look.cone.mean(axis=1, keepdims=True) for look in (here, free))
    if len(seen) != len(whole):
        return np.ones(len(seen), np.float32)
    rows = 2 * (len(seen) // 30) + 1

    def along(values: Array) -> Array:
        return np.asarray(cv2.blur(values.sum(axis=(1, 2))[:, None], (1, rows))[:, 0], np.float32)

    share = along(seen * whole) / np.maximum(along(whole * whole), 1e-6)
    return np.asarray(np.clip(share, 0.0, 1.0), np.float32)


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

    Each hung before a background of its own: what comes through of it is taken out, row by row.
    """
    white, seen = _white(here), looks(sample)
    wet, dry = (
        _sampled(sample.frames[kind], seen[kind], u, v) * (white / _white(seen[kind]))
        for kind in FREE
    )
    added = wet - dry
    px = 1.0 / here.profile.length
    out = (np.abs(v) - here.shape.radius(u)) / px - SMEARED_PX
    beside = ((out > _BESIDE_PX[0]) & (out < _BESIDE_PX[1])).ravel()
    row = np.clip(np.rint((u + 1.0) / px), 0, 3.0 / px).astype(int)
    least = int(row.max()) + 1
    through = _through(sample)
    count = np.maximum(np.bincount(row.ravel()[beside], minlength=least), 1)
    for colour in range(3):
        behind = np.bincount(row.ravel()[beside], added[..., colour].ravel()[beside], least)
        added[..., colour] -= through * (behind / count)[row]
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
    return np.asarray(np.maximum(np.median(nozzle, axis=(0, 1)), WHITE_LEAST), np.float32)
