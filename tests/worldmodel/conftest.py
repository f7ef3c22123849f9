"""Small data sets and a store, drawn by the simulated camera."""

from __future__ import annotations

from tests.worldmodel.fixtures import drawn, store

__all__ = ["drawn", "store"]
