"""The code that decides what a seed gives, as one digest."""

from __future__ import annotations

import hashlib
from collections.abc import Collection
from pathlib import Path

SOURCES = {
    "training": (
        *("axes", "examples", "fitting", "frame_pool", "network", "photometry", "pipettes"),
        *("recorded", "rooms", "scenes", "simulated", "strokes", "transplant"),
    ),
    "simulation": (
        *("backdrop", "dyes", "exposure", "optics", "plans", "random_frames", "reflections"),
        *("render", "scene", "session", "shading", "truth"),
    ),
    "vision": ("detection/decode", "detection/views", "tips"),
    "vocabulary": ("pipette_names",),
}
"""Modules, by room: what makes the frames, cuts and paints the examples, and fits the network."""


def sources_digest(without: Collection[str] = ()) -> str:
    """SHA-256 of the modules of :data:`SOURCES`.

    Args:
        without: Modules to leave out (``"vision/tips"``): those that were changed on purpose
            since weights were made, as their description's ``changed_since`` says.

    Weights whose description has another digest were made by other code: the same command gives
    weights of the same kind today, not the same weights.
    """
    package = Path(__file__).parents[1]
    digest = hashlib.sha256()
    for room, names in SOURCES.items():
        for name in names:
            if f"{room}/{name}" in without:
                continue
            digest.update(f"{room}/{name}\0".encode())
            digest.update((package / room / f"{name}.py").read_bytes())
    return digest.hexdigest()
