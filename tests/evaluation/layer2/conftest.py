"""Small data sets and a store, drawn by the simulated camera."""

from __future__ import annotations

from tests.evaluation.layer2.fixtures import drawn, store

__all__ = ["drawn", "store"]
