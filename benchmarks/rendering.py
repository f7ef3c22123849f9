"""What draws the frames of a benchmark: the simulated camera, or the path tracer."""

from __future__ import annotations

from typing import Any


def renderer(rendered: bool) -> Any:
    """``render`` of a simulated camera; path-traced frames need ``pip install mitsuba pyoidn``."""
    if rendered:
        from scripts.path_traced.tracer import PathTracer

        return PathTracer()
    from aegis_ot.simulation.render import render_jpeg

    return render_jpeg
