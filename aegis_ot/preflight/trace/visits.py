"""What one tip did at one well, and the volumes that do not add up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...instrumentation import OperationKind
from .tips import Layer, Tip
from .wells import Well


class Visit:
    """One thing that one tip did at one well.

    Attributes:
        kind: ``aspirate``, ``dispense``, ``blow_out`` or ``touch_tip``.
        tip: The tip.
        session: Which of the tip's sessions this was.
        well: The well.
        index: Position in the run; channels that act together share it.
        line: Source line.
        volume: µL of liquid drawn or given, air left out.
        parts: What was given: liquid by the well it was drawn from.
        below: Whether liquid or tip came below the well's top.
        touch: Whether the tip touched the well (never an empty one).
        empty_before: Whether the well held nothing just before.
        mixing: Whether it is part of a mix.
        carried: How many liquids the tip had met before (a prefix of ``tip.origins``).
        met: How many wells the tip had touched before (a prefix of ``tip.touched``).
    """

    __slots__ = (
        "below",
        "carried",
        "empty_before",
        "index",
        "kind",
        "line",
        "lines",
        "met",
        "mixing",
        "parts",
        "session",
        "tip",
        "touch",
        "volume",
        "well",
    )

    def __init__(
        self,
        kind: OperationKind,
        tip: Tip,
        well: Well,
        index: int,
        line: int | None,
        lines: tuple[int, ...],
        mixing: bool,
    ) -> None:
        self.kind = kind
        self.tip = tip
        self.session = tip.session
        self.well = well
        self.index = index
        self.line = line
        self.lines = lines
        self.mixing = mixing
        self.volume = 0.0
        self.parts: Sequence[Layer] = ()
        self.below = False
        self.touch = False
        self.empty_before = False
        self.carried = 0
        self.met = 0

    def __repr__(self) -> str:
        return f"<{self.kind.value} {self.well!r} tip {self.tip.number} line {self.line}>"


@dataclass(frozen=True)
class Imbalance:
    """A well that was filled beyond its capacity, or drawn below what it held.

    Attributes:
        overfilled: Which of the two.
        volume: What it would hold, or what was drawn, µL.
        limit: Its capacity, or what it held, µL.
    """

    well: Well
    index: int
    line: int | None
    overfilled: bool
    volume: float
    limit: float
