"""The signs that speak against a well: what each says, and which frames show it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..vocabulary import KeyframeKind
from .column.trajectory import DELIVERED, LOADED
from .types import FREE


@dataclass(frozen=True)
class Sign:
    """One kind of surprise.

    Attributes:
        name: As the scorers call it.
        words: What it says, for people and models.
        frames: The keyframes that it is read in; empty: it may stand in any.
    """

    name: str
    words: str
    frames: tuple[KeyframeKind, ...] = ()


SIGNS: Mapping[str, Sign] = {
    sign.name: sign
    for sign in (
        Sign("retained", "a column that is left after the dispense", DELIVERED),
        Sign("undelivered", "a tip that the dispense did not change", DELIVERED[-1:]),
        Sign("gap_lit", "a break in the glowing column", (KeyframeKind.ASPIRATE,)),
        Sign("gap_aspirate", "a break in the column", (KeyframeKind.ASPIRATE,)),
        Sign("gap_transit", "a break in the column", (KeyframeKind.TRANSIT,)),
        Sign("overfull", "a column that ends higher than it should", LOADED),
        Sign("underfull", "a column that ends lower than it should", LOADED),
        Sign("absent", "no colour where the full column should be", (KeyframeKind.TRANSIT,)),
        Sign("pair", "a tip unlike normal ones before and after the dispense", FREE),
    )
}
"""By name."""
