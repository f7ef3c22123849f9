"""What a tip holds, in layers: the last drawn is next to the orifice and leaves first.

The rehearsed trace and the running monitor know different things of a layer; how it leaves is the
same.
"""

from __future__ import annotations

import math
from typing import Protocol, TypeVar

ROUNDING_UL = 1e-6
"""A difference that is none, µL."""


class TipLayer(Protocol):
    """A named tuple with a volume, µL."""

    @property
    def volume(self) -> float: ...

    def _replace(self: AnyLayer, *, volume: float) -> AnyLayer: ...


AnyLayer = TypeVar("AnyLayer", bound=TipLayer)


def expel(layers: list[AnyLayer], volume: float = math.inf) -> list[AnyLayer]:
    """Take ``volume`` µL, of liquid and air, off the end of ``layers``: what leaves, in order."""
    leaving: list[AnyLayer] = []
    while layers and volume > ROUNDING_UL:
        last = layers.pop()
        out = last.volume if last.volume <= volume + ROUNDING_UL else volume
        if last.volume - out > ROUNDING_UL:
            layers.append(last._replace(volume=last.volume - out))
        leaving.append(last if out == last.volume else last._replace(volume=out))
        volume -= out
    return leaving
