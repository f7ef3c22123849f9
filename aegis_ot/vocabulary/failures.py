"""What can go wrong with a delivery: one table of all that other rooms say or do by kind.

A new kind is a member, a row of the table, and the code that plants it
(:mod:`aegis_ot.simulation.fault_plan`) and that recognises it (a gate).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum


class FailureType(str, Enum):
    """What went wrong physically, as far as a verdict can name it."""

    PARTIAL_DISPENSE = "partial_dispense"
    NO_DISPENSE = "no_dispense"
    NO_ASPIRATE = "no_aspirate"
    AIR_BUBBLE = "air_bubble"
    NO_TIP = "no_tip"
    OTHER = "other"

    @property
    def words(self) -> str:
        """As people say it: "partial dispense"."""
        return self.value.replace("_", " ")


@dataclass(frozen=True)
class FailureKind:
    """What is known of one kind.

    Attributes:
        label: What data sets call it; empty where they know no such kind.
        recovery: What the robot can do about it by itself; empty where too little is known.
        stays: Whether liquid that should have left is still in the tip.
    """

    label: str = ""
    recovery: str = ""
    stays: bool = False


FAILURES: Mapping[FailureType, FailureKind] = {
    FailureType.PARTIAL_DISPENSE: FailureKind("partial_single", "top_up", stays=True),
    FailureType.NO_DISPENSE: FailureKind("no_dispense", "retry", stays=True),
    FailureType.NO_ASPIRATE: FailureKind("no_aspirate", "retry"),
    FailureType.AIR_BUBBLE: FailureKind("air_bubble"),
    FailureType.NO_TIP: FailureKind("no_tip"),
    FailureType.OTHER: FailureKind(),
}
