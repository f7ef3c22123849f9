"""What a liquid does to light, and which liquid a reagent's name means."""

from __future__ import annotations

import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

REFERENCE_PATH_MM = 3.6
"""Path of light at which a dye's transmission is stated, mm.

A p1000 column at 300 µL is 4 mm wide; light that the tip's front wall scatters never enters the
liquid, so the measured transmissions belong to a shorter path. With this one, finished frames
show them.
"""


@dataclass(frozen=True)
class Dye:
    """A liquid's colour.

    Attributes:
        name: ``"green"``, ``"water"``...
        transmission: Fraction of light that passes :data:`REFERENCE_PATH_MM` of it, (B, G, R),
            in grey levels of the frame, as measured on real frames (spec: "What real frames
            look like"). Other paths follow Beer-Lambert: ``transmission ** (path / reference)``.
    """

    name: str
    transmission: tuple[float, float, float]

    @property
    def is_clear(self) -> bool:
        """Whether it has no colour: seen by edges and glints only."""
        return min(self.transmission) > 0.98


WATER = Dye("water", (1.0, 1.0, 1.0))
GREEN = Dye("green", (0.87, 0.86, 0.48))
"""The one dye whose transmission was measured on real frames."""

DYES: Mapping[str, Dye] = MappingProxyType(
    {
        dye.name: dye
        for dye in (
            WATER,
            GREEN,
            Dye("red", (0.36, 0.34, 0.90)),
            Dye("yellow", (0.34, 0.86, 0.91)),
            Dye("blue", (0.90, 0.66, 0.32)),
            Dye("orange", (0.32, 0.62, 0.92)),
            Dye("purple", (0.76, 0.36, 0.62)),
            Dye("pink", (0.72, 0.48, 0.93)),
            Dye("brown", (0.34, 0.50, 0.68)),
        )
    }
)
"""Liquids by name. All but green and water are plausible food dyes, not measured ones."""

_WORDS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("red", ("red", "crimson", "scarlet", "blood", "amaranth", "safranin", "phenol")),
    ("yellow", ("yellow", "tartrazine", "amber", "fluorescein")),
    ("green", ("green", "malachite")),
    ("blue", ("blue", "bradford", "coomassie", "trypan", "methylene", "cyan", "bcp")),
    ("orange", ("orange", "iodine")),
    ("purple", ("purple", "violet", "permanganate", "magenta", "bca")),
    ("pink", ("pink", "rhodamine", "medium", "dmem", "rpmi")),
    ("brown", ("brown", "black", "coffee")),
    (
        "water",
        (
            *("water", "h2o", "ddh2o", "buffer", "clear", "pbs", "tris", "te", "saline"),
            *("ethanol", "etoh", "dmso", "diluent", "vehicle", "mastermix", "master"),
            *("primer", "primers", "template", "dna", "ntc", "blank"),
        ),
    ),
)

_PALETTE = ("green", "red", "yellow", "blue", "orange", "purple")


def dye_for(reagent: str | None, colours: Mapping[str, Dye] | None = None) -> Dye:
    """The liquid that a reagent's name means.

    In this order: an entry of ``colours`` under that name (case ignored); the first word of the
    name that names a colour or a liquid of known look ("Blue dye", "nuclease-free water"); for
    any other name a dye of a fixed palette, always the same one for the same name. Without a
    name: green, the one dye measured on real frames.
    """
    if not reagent or not reagent.strip():
        return GREEN
    name = reagent.strip().lower()
    for key, dye in (colours or {}).items():
        if key.strip().lower() == name:
            return dye
    words = "".join(c if c.isalnum() else " " for c in name).split()
    for word in words:
        for dye_name, known in _WORDS:
            if word in known:
                return DYES[dye_name]
    return DYES[_PALETTE[zlib.crc32(name.encode()) % len(_PALETTE)]]
