"""The code that decides what a seed gives, as one digest."""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Collection
from pathlib import Path

SOURCES = {
    "aegis_ot_lab/training": (
        *("axes", "examples", "fitting", "frame_pool", "network", "photometry", "pipettes"),
        *("recorded", "rooms", "scenes", "simulated", "strokes", "transplant"),
    ),
    "aegis_ot_lab/drawing": ("plans", "random_frames", "random_sessions"),
    "aegis_ot/simulation": (
        *("backdrop", "dyes", "exposure", "optics", "reflections"),
        *("render", "scene", "session", "shading", "truth"),
    ),
    "aegis_ot/vision": ("detection/decode", "detection/views", "tips"),
    "aegis_ot/vocabulary": ("pipette_names",),
}
"""Modules, by room: what makes the frames, cuts and paints the examples, and fits the network."""


def sources_digest(without: Collection[str] = ()) -> str:
    """SHA-256 of what the modules of :data:`SOURCES` do, wherever they stand.

    Args:
        without: Modules to leave out (``"aegis_ot/vision/tips"``): those that were changed on
            purpose since weights were made, as their description's ``changed_since`` says.

    Weights whose description has another digest were made by other code: the same command gives
    weights of the same kind today, not the same weights.
    """
    top = Path(__file__).parents[2]
    digest = hashlib.sha256()
    modules = {
        name.rpartition("/")[2]: f"{room}/{name}"
        for room, names in SOURCES.items()
        for name in names
    }
    for name, module in sorted(modules.items()):
        if module not in without:
            digest.update(f"{name}\0".encode())
            digest.update(_decisive((top / f"{module}.py").read_text(encoding="utf-8")).encode())
    return digest.hexdigest()


def _decisive(text: str) -> str:
    """A module without its imports and blank lines: where another one stands decides nothing."""
    lines = text.split("\n")
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            for number in range(node.lineno - 1, node.end_lineno or node.lineno):
                lines[number] = ""
    return "\n".join(line for line in lines if line.strip())
