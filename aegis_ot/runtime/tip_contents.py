"""What a tip holds, in layers: the last drawn is next to the orifice and leaves first."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from ..adapters.opentrons.instrumentation import expel
from ..vocabulary import WellRef

TRACE_UL = 1e-3
"""Less than this is rounding, not liquid, µL."""


class DrawnLayer(NamedTuple):
    """One draw.

    Attributes:
        volume: Per channel, µL.
        sources: Wells it was drawn from, each once; empty for air.
        liquid: ``False`` for air.
        found: What the pipette's sensors say of the well under each nozzle; empty if nothing.
    """

    volume: float
    sources: tuple[WellRef, ...] = ()
    liquid: bool = True
    found: tuple[bool | None, ...] = ()


class Contents:
    """The layers in the tips of one pipette (all its tips hold the same)."""

    def __init__(self) -> None:
        self._layers: list[DrawnLayer] = []

    @property
    def liquid(self) -> float:
        """Liquid without air, per channel, µL."""
        return liquid_of(self._layers)

    @property
    def holds_liquid(self) -> bool:
        """Whether there is more than a rounding error of liquid."""
        return self.liquid > TRACE_UL

    @property
    def sources(self) -> tuple[WellRef, ...]:
        """All wells whose liquid is in the tip, each once, oldest first."""
        return sources_of(self._layers)

    @property
    def found(self) -> tuple[bool | None, ...]:
        """Of which wells the sensors found liquid; empty if not all draws say the same."""
        said = {layer.found for layer in self._layers if layer.liquid}
        return said.pop() if len(said) == 1 else ()

    def draw(self, layer: DrawnLayer) -> None:
        """Take in one layer."""
        if layer.volume > 0:
            self._layers.append(layer)

    def peek(self, volume: float | None = None) -> tuple[DrawnLayer, ...]:
        """What would leave if ``volume`` µL were dispensed; everything for ``None``."""
        return tuple(expel(list(self._layers), math.inf if volume is None else volume))

    def expel(self, volume: float | None = None) -> tuple[DrawnLayer, ...]:
        """Let ``volume`` µL leave and say what it was; everything for ``None``."""
        leaving = expel(self._layers, math.inf if volume is None else volume)
        if not self.holds_liquid and any(layer.liquid for layer in self._layers):
            self._layers = [layer for layer in self._layers if not layer.liquid]
        return tuple(leaving)

    def clear(self) -> None:
        """The tip is gone, or a new one is there."""
        self._layers.clear()


def liquid_of(layers: Iterable[DrawnLayer]) -> float:
    """Liquid in these layers, µL."""
    return float(sum(layer.volume for layer in layers if layer.liquid))


def sources_of(layers: Iterable[DrawnLayer]) -> tuple[WellRef, ...]:
    """Wells whose liquid is in these layers, each once."""
    return tuple(dict.fromkeys(well for layer in layers for well in layer.sources))
