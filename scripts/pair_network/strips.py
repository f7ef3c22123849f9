"""Tips of one size, cut out of frames, and what they truly hold: what the network learns from.

A strip has :data:`ROWS` rows from above the collar to below the orifice and :data:`COLUMNS` lanes
across, as much background as tip. Plates are drawn before cameras of any kind; a pair's two frames
are at one place, as a guarded robot holds them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from aegis_ot.simulation.dyes import DYES
from aegis_ot.simulation.exposure import decode
from aegis_ot.simulation.render import render_jpeg
from aegis_ot.simulation.scene import TipContent, place_tip
from aegis_ot.simulation.session import SessionParameters
from aegis_ot.simulation.truth import TipTruth
from aegis_ot.vision.column.strip import MARGIN, resample
from aegis_ot.vision.tips import TipGeometry, tip_for
from aegis_ot.vision.types import FREE, Image
from aegis_ot_lab.drawing.dataset import typical_volume
from aegis_ot_lab.drawing.plans import FAILURES, contents_of
from aegis_ot_lab.drawing.random_sessions import random_session
from scripts.path_traced.kinds import any_kind, draw_session

ROWS, COLUMNS = 112, 24
_FINE = 200
"""Rows between collar and orifice before two become one."""

U = ((np.arange(2 * ROWS) + 0.5 - round(MARGIN * _FINE)) / _FINE).reshape(ROWS, 2).mean(axis=1)
"""Where each row is: 0 collar, 1 orifice."""

_NORMALS = 3
_KINDS = ("", "", "", *FAILURES, "no_aspirate")
_OF_PLATE = np.array((0.012, 0.03, 0.012, 0.012))
_OF_WELL = np.array((0.004, 0.006, 0.004, 0.004))
_OF_FRAME = np.full(4, 0.003)
"""How far the ends of an axis are off, tip lengths: orifice across and along, collar likewise."""

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class Pair:
    """A delivery's two free frames.

    Attributes:
        plate: Which; its first normal pairs are the others' references.
        frames: ``(2, ROWS, COLUMNS, 3)`` uint8, BGR: TRANSIT, POST_DISPENSE.
        wet: ``(2, ROWS)``: 1 where liquid stands.
        tip: ``(2, ROWS)``: where liquid should stand in TRANSIT, and the tip's half width.
        failure: ``""`` if normal.
        kept: Share of the volume that stayed in the tip.
        reagent: Name of the liquid.
    """

    plate: int
    frames: NDArray[np.uint8]
    wet: Floats
    tip: Floats
    failure: str
    kept: float
    reagent: str


def strip_of(
    image: Image, collar: ArrayLike, orifice: ArrayLike, tip: TipGeometry
) -> NDArray[np.uint8]:
    """``(ROWS, COLUMNS, 3)`` of a frame along an axis, px."""
    half = 2.0 * float(tip.outer_radius(tip.length_mm)) / tip.length_mm
    pixels, _, _ = resample(
        image, np.asarray(collar, float), np.asarray(orifice, float), _FINE, half
    )
    small = cv2.resize(pixels, (COLUMNS, ROWS), interpolation=cv2.INTER_AREA)
    strip: NDArray[np.uint8] = np.clip(small, 0, 255).astype(np.uint8)
    return strip


def wet_rows(tip: TipGeometry, slugs: tuple[tuple[float, float], ...]) -> Floats:
    """1 in the rows in which liquid stands that reaches from µL to µL."""
    here = tip.volume_of(np.clip((1 - U) * tip.length_mm, 0, tip.length_mm))
    wet = np.zeros(ROWS, np.float32)
    for low, high in slugs:
        wet += (here >= low) & (here < high) & (U > 0) & (U < 1)
    return wet


def of_tip(tip: TipGeometry, volume_ul: float) -> Floats:
    """What is known of a tip before a frame is seen; see :class:`Pair`."""
    width = tip.outer_radius(np.clip(1 - U, 0, 1) * tip.length_mm)
    half = 0.5 * width / float(tip.outer_radius(tip.length_mm))
    known: Floats = np.stack([wet_rows(tip, ((0.0, volume_ul),)), half]).astype(np.float32)
    return known


def draw_pairs(seed: int, plates: int, wells: int = 10) -> Iterator[Pair]:
    """Pairs of plates, each before a camera of its own; tips above the frame are left out."""
    rng = np.random.default_rng((seed, 77))
    for plate in range(plates):
        kind = any_kind(rng)
        if rng.random() < 0.4:
            kind = replace(kind, clutter=(0.2, 0.9))
        pipette = kind.pipettes[0]
        drawn = rng.random() < 0.3
        session = (
            random_session(rng, pipette=pipette, size=kind.size)
            if drawn
            else draw_session(kind, pipette, rng)[0]
        )
        tip = tip_for(pipette)
        reagent = "water" if rng.random() < 0.3 else str(rng.choice(list(DYES)))
        volume = typical_volume(rng, tip, of_any_tip=rng.random() < 0.6)
        off = rng.normal(0, 1, 4) * _OF_PLATE
        for well in range(wells):
            failure = "" if well < _NORMALS else _KINDS[int(rng.integers(len(_KINDS)))]
            contents, kept = contents_of(failure, volume, rng, session.film)
            found = _pair(rng, session, tip, reagent, [contents[kind] for kind in FREE], off)
            if found is not None:
                yield Pair(
                    plate + 10_000 * seed,
                    *found,
                    of_tip(tip, volume),
                    failure,
                    kept or 0.0,
                    reagent,
                )


def _pair(
    rng: np.random.Generator,
    session: SessionParameters,
    tip: TipGeometry,
    reagent: str,
    contents: list[TipContent],
    off: NDArray[np.float64],
) -> tuple[NDArray[np.uint8], Floats] | None:
    name = f"{'ABCDEFGH'[rng.integers(8)]}{rng.integers(1, 13)}"
    if rng.random() < session.drop_chance:
        contents[1] = replace(contents[1], drop_ul=min(4.0, 0.02 * tip.nominal_ul))
    scene = place_tip(session, FREE[1], tip, (contents[1],), DYES[reagent], destination=name)
    x, y, z = scene.orifice
    place = (x, y, z + float(rng.uniform(-15, 10)))
    off = off + rng.normal(0, 1, 4) * _OF_WELL
    strips, wet = [], []
    for content in contents:
        jpeg, truth = render_jpeg(replace(scene, contents=(content,), orifice=place), session, rng)
        shown = truth.tips[truth.front]
        collar, orifice = _axis(shown, off + rng.normal(0, 1, 4) * _OF_FRAME)
        if shown.collar[1] < -0.1 * float(np.hypot(*(orifice - collar))):
            return None
        strips.append(strip_of(decode(jpeg), collar, orifice, tip))
        full = shown.liquid_ul / content.liquid_ul if content.liquid_ul else 1.0
        wet.append(wet_rows(tip, tuple((a * full, b * full) for a, b in content.slugs)))
    return np.stack(strips), np.stack(wet)


def _axis(tip: TipTruth, off: NDArray[np.float64]) -> tuple[Floats, Floats]:
    """Collar and orifice as a detector or a registration has them, px."""
    collar, orifice = np.array(tip.collar), np.array(tip.orifice)
    along = orifice - collar
    across = np.array([along[1], -along[0]])
    return collar + off[2] * across + off[3] * along, orifice + off[0] * across + off[1] * along


def save(path: Path, pairs: list[Pair]) -> None:
    """As one ``.npz``."""
    np.savez_compressed(
        path,
        frames=np.stack([one.frames for one in pairs]),
        wet=np.stack([one.wet for one in pairs]),
        tip=np.stack([one.tip for one in pairs]),
        plate=np.array([one.plate for one in pairs]),
        failure=np.array([one.failure for one in pairs]),
        kept=np.array([one.kept for one in pairs], np.float32),
        reagent=np.array([one.reagent for one in pairs]),
    )
