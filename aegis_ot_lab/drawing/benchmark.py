"""What a simulated frame costs: ``python -m aegis_ot_lab.drawing.benchmark`` prints it."""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass

import cv2
import numpy as np

from aegis_ot.simulation.render import render
from aegis_ot.simulation.scene import TipContent, place_tip
from aegis_ot.simulation.session import SessionParameters
from aegis_ot.vision.tips import tip_for
from aegis_ot.vocabulary import KeyframeKind

from .random_sessions import random_session


@dataclass(frozen=True)
class FrameCost:
    """Cost of one simulated frame, rendering and JPEG included.

    Attributes:
        what: What was rendered.
        cpu_ms: Median processor time of one core, ms.
        first_ms: The same for a session's first frame, which draws the still scene, ms.
    """

    what: str
    cpu_ms: float
    first_ms: float


def measure(frames: int = 40) -> list[FrameCost]:
    """Measure single- and multi-channel frames on one core of this machine.

    Args:
        frames: Frames per case.
    """
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    try:
        return [
            _case("640x480, one tip", SessionParameters.webcam(101), 1, frames),
            _case("640x480, eight tips", SessionParameters.corner(102), 8, frames),
            _case(
                "960x540, one tip",
                random_session(np.random.default_rng(103), size=(960, 540)),
                1,
                frames,
            ),
        ]
    finally:
        cv2.setNumThreads(threads)


def _case(what: str, session: SessionParameters, channels: int, frames: int) -> FrameCost:
    pipette = "p1000" if channels == 1 else "p300_multi_gen2"
    contents = (TipContent(liquid_ul=150.0),) * channels
    rng = np.random.default_rng(0)
    costs = []
    for number in range(frames + 1):
        kind = tuple(KeyframeKind)[number % 4]
        state = place_tip(session, kind, tip_for(pipette), contents)
        begun = time.thread_time()
        render(state, session, rng)
        costs.append((time.thread_time() - begun) * 1e3)
    return FrameCost(what, float(np.median(costs[1:])), costs[0])


def main() -> None:
    """Print :func:`measure`."""
    for cost in measure():
        sys.stdout.write(
            f"simulated frame, {cost.what}: {cost.cpu_ms:.1f} ms on one core "
            f"(first of a session {cost.first_ms:.0f} ms)\n"
        )


if __name__ == "__main__":
    main()
