"""An endless supply of simulated frames with their truth, for training a detector."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from aegis_ot.simulation.dyes import DYES, Dye
from aegis_ot.simulation.exposure import decode
from aegis_ot.simulation.render import render_jpeg
from aegis_ot.simulation.scene import SceneState, place_tip
from aegis_ot.simulation.session import SessionParameters
from aegis_ot.simulation.truth import FrameTruth
from aegis_ot.vision.tips import TIPS, TipGeometry, tip_for
from aegis_ot.vision.types import Image
from aegis_ot.vocabulary import KeyframeKind
from aegis_ot.vocabulary.pipette_names import channels_of

from .plans import FAILURES, contents_of
from .random_sessions import random_session

_PIPETTES = ("p1000", "p300", "p20", "p10", "flex_1channel_50", "flex_1channel_1000")
_SIZES = ((640, 480), (640, 480), (960, 540), (1280, 720))


def random_frames(
    seed: int,
    *,
    pipettes: tuple[str, ...] = _PIPETTES,
    sizes: tuple[tuple[int, int], ...] = _SIZES,
    frames_per_session: int = 6,
    measured: float = 0.0,
    without_tip: float = 0.125,
) -> Iterator[tuple[Image, FrameTruth]]:
    """Frames with their truth, without end, for training a detector.

    A new session (camera, light, deck, pipette, tip) is drawn every ``frames_per_session``
    frames; reagent, volume, fault, well and height change with each frame. Synthetic,
    deterministic in ``seed``.

    Args:
        seed: Fixes the sequence.
        pipettes: Pipettes to draw from, Opentrons names or classes.
        sizes: Frame sizes to draw from, px.
        frames_per_session: Frames that share a session.
        measured: Share of sessions that stand where the measured webcam and the recommended one
            do, whatever the pipette; their frame sizes are their own.
        without_tip: Share of frames without a tip.
    """
    rng = np.random.default_rng((seed, 21))
    while True:
        pipette = pipettes[int(rng.integers(len(pipettes)))]
        channels = channels_of(pipette)
        if measured and rng.random() < measured:
            views = (SessionParameters.webcam, SessionParameters.webcam, SessionParameters.bench)
            fixed = views[int(rng.integers(3))] if channels == 1 else SessionParameters.corner
            session = fixed(int(rng.integers(2**31)))
        else:
            size = sizes[int(rng.integers(len(sizes)))]
            session = random_session(rng, pipette=pipette, size=size)
        tip = _any_tip(rng, pipette)
        for _ in range(frames_per_session):
            state = _random_state(rng, session, tip, without_tip, channels)
            jpeg, truth = render_jpeg(state, session, rng)
            yield decode(jpeg), truth


def _any_tip(rng: np.random.Generator, pipette: str) -> TipGeometry:
    """The pipette's tip, now and then a smaller one that fits it too."""
    tip = tip_for(pipette)
    smaller = [
        t for t in TIPS.values()
        if t.name[:4] == tip.name[:4] and abs(t.nozzle_radius_mm - tip.nozzle_radius_mm) < 0.5
    ]  # fmt: skip
    return smaller[int(rng.integers(len(smaller)))] if smaller else tip


def _random_state(
    rng: np.random.Generator,
    session: SessionParameters,
    tip: TipGeometry,
    without_tip: float,
    channels: int,
) -> SceneState:
    kind = tuple(KeyframeKind)[int(rng.integers(4))]
    volume = tip.nominal_ul * float(rng.uniform(0.05, 1.0))
    failure = "no_tip" if rng.random() < without_tip else _random_failure(rng)
    content = contents_of(failure, volume, rng, session.film)[0][kind]
    if content.present and rng.random() < 0.1:
        content = replace(content, drop_ul=float(rng.uniform(0.1, 4.0)))
    names = tuple(DYES)
    dye: Dye = DYES["water" if rng.random() < 0.3 else names[int(rng.integers(len(names)))]]
    wells = [f"{'ABCDEFGH'[rng.integers(8)]}{rng.integers(1, 13)}" for _ in range(2)]
    state = place_tip(
        session, kind, tip, (content,) * channels, dye, source=wells[0], destination=wells[1],
    )  # fmt: skip
    x, y, z = state.orifice
    lift = 0.0 if state.rim_z is not None else float(rng.uniform(-20.0, 15.0))
    return replace(state, orifice=(x + rng.uniform(-4, 4), y + rng.uniform(-20, 20), z + lift))


def _random_failure(rng: np.random.Generator) -> str:
    kinds = ("", "", *FAILURES, "no_aspirate")
    return kinds[int(rng.integers(len(kinds)))]
