"""Path-traced frames stand where the simulated camera's do; skipped where Mitsuba is missing."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest

from aegis_ot.simulation.dyes import DYES
from aegis_ot.simulation.scene import TipContent, place_tip
from aegis_ot.simulation.session import SessionParameters
from aegis_ot.vision.tips import TIPS
from aegis_ot.vocabulary import KeyframeKind

pytest.importorskip("mitsuba", reason="path-traced frames need it: pip install mitsuba pyoidn")
pytest.importorskip("pyoidn", reason="path-traced frames need it: pip install mitsuba pyoidn")

from scripts.path_traced.stage import Lamps
from scripts.path_traced.tracer import PathTracer, Quality

SESSION = replace(
    SessionParameters.webcam(3), size=(320, 240), focal_px=450.0, noise=0.5, frost=0.1,
    overexposed_chance=0.0, wall=(150.0, 150.0, 150.0), axis_jitter_px=0.0,
)  # fmt: skip


def frame(content: TipContent) -> tuple[np.ndarray, object]:
    tracer = PathTracer({SESSION.seed: Lamps()}, Quality(4, 4, 16, 12))
    state = place_tip(SESSION, KeyframeKind.TRANSIT, TIPS["ot2_1000"], (content,), DYES["red"])
    jpeg, truth = tracer(state, SESSION, np.random.default_rng(1))
    return cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR).astype(float), truth.tip


def test_red_liquid_is_red_where_the_truth_says_it_is() -> None:
    full, tip = frame(TipContent(liquid_ul=500.0))
    empty, _ = frame(TipContent())
    x = int(tip.orifice[0])
    bottom, top = int(tip.column_bottom[1]), int(tip.column_top[1])
    middle = slice(top + 8, bottom - 20)
    redness = (full - empty)[middle, x - 1 : x + 2]
    assert (redness[..., 2] - redness[..., 0]).mean() > 15, "red passes, blue does not"
    above = np.abs(full - empty)[top - 22 : top - 8, x - 1 : x + 2]
    assert above.mean() < 12, "above the meniscus the two tips look alike"
