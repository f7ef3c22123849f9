"""Path-traced frames that show a tip and what is close around it: all that a strip is cut from."""

from __future__ import annotations

from typing import Any

import numpy as np

from aegis_ot.simulation.exposure import encode, expose, frame_gain
from aegis_ot.simulation.optics import Pinhole
from aegis_ot.simulation.scene import SceneState
from aegis_ot.simulation.session import SessionParameters
from aegis_ot.simulation.truth import FrameTruth
from scripts.path_traced.tracer import PathTracer, Quality, covering, levels

_QUALITY = Quality(tip=16)
_AROUND = 0.07
"""Of the frame's height: how far around the tip is rendered; beyond it the frame is grey."""


class TipTracer(PathTracer):
    """Of one session; a fifth of a whole frame's time."""

    _stage: dict[str, Any] | None = None

    def __call__(
        self, state: SceneState, session: SessionParameters, rng: np.random.Generator
    ) -> tuple[bytes, FrameTruth]:
        """As :class:`PathTracer`."""
        jitter = rng.normal(0.0, session.axis_jitter_px, 2) / session.px_per_mm
        shapes, outlines, (tips, front) = self._moving(state, session, Pinhole(session), jitter)
        width, height = session.size
        light = np.full((height, width, 3), 0.2, np.float32)
        box = covering(outlines[-1][0], session.size, round(_AROUND * height / 3))
        if box is not None:
            x0, y0, x1, y1 = box
            self._stage = self._stage or self._standing(session)
            scene = self._scene(self._stage | shapes)
            seed = int(rng.integers(2**31))
            light[y0:y1, x0:x1] = self._trace(scene, session, box, _QUALITY.tip, seed)
        gain = frame_gain(session, rng)
        image = expose(levels(light, session) * np.float32(gain), session, rng)
        over = gain == session.overexposed_gain
        truth = FrameTruth(state.kind, tips, front, state.dye.name, over)
        return encode(image, session.jpeg_quality), truth
