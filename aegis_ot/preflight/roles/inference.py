"""How well an assay family fits a protocol."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Inference:
    """How well one family fits.

    Attributes:
        family: Name of the family.
        score: Weight of everything that speaks for it.
        confidence: 0 to 1: its share among all families, damped for little evidence.
        reasons: What speaks for it, strongest first.
        applies: Whether its rules are judged.
        sure: Whether it is more than a guess.
        left_over: Whether it is judged only because no other family fits.
        in_prose: Whether it would be no more than a guess without comments and docstrings.
    """

    family: str
    score: float
    confidence: float
    reasons: tuple[str, ...]
    applies: bool
    sure: bool
    left_over: bool = False
    in_prose: bool = False
