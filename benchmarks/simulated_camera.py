"""What a simulated frame costs."""

from __future__ import annotations

from collections.abc import Iterator

from aegis_ot_lab.drawing.benchmark import measure

from .figure import Figure

TARGET_MS = 30.0


def figures() -> Iterator[Figure]:
    """Median processor time of a frame, JPEG included, on one core."""
    for cost in measure(frames=24):
        target = TARGET_MS if cost.what.startswith("640x480, one") else None
        yield Figure(
            "simulated camera, one frame", f"{cost.what}, one core", "simulated", cost.cpu_ms,
            "ms", target, note=f"first frame of a session {cost.first_ms:.0f} ms",
        )  # fmt: skip
