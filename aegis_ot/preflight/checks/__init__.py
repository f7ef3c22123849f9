"""The vocabulary of checks: predicates over trace and roles that rules are made of.

A rule file names a check and gives its parameters; no rule has code of its own.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...errors import RuleError
from ..rules import read_dataclass
from .carry import Carry
from .check import Check, Doubt, Violation
from .dilution import SeriesDirection, SeriesMixed, SeriesTip
from .dose_order import DoseOrder
from .drawn_off import DrawnOffBefore, WasteStays
from .emptied import DrawsReachLiquid, NothingFromNothing, StockSuffices
from .filling import SeriesFilledFirst, SeriesFilledFrom
from .handling import TipAboveBottom, TipsOverWells
from .order import MixedAfter, ReceivedBefore, RisingOrder
from .range import VolumeInRange
from .receiving import NeverReceives, Receives
from .retaken import TipsInPlace
from .rule_context import RuleContext
from .uniform_volume import UniformVolume
from .volumes import VolumeBookkeeping
from .written import WrittenIsMoved

CHECKS: dict[str, type[Check]] = {
    "carry": Carry,
    "dose_order": DoseOrder,
    "receives": Receives,
    "never_receives": NeverReceives,
    "uniform_volume": UniformVolume,
    "mixed_after": MixedAfter,
    "received_before": ReceivedBefore,
    "drawn_off_before": DrawnOffBefore,
    "waste_stays": WasteStays,
    "rising_order": RisingOrder,
    "series_mixed": SeriesMixed,
    "series_direction": SeriesDirection,
    "series_filled_first": SeriesFilledFirst,
    "series_filled_from": SeriesFilledFrom,
    "series_tip": SeriesTip,
    "volume_bookkeeping": VolumeBookkeeping,
    "tips_over_wells": TipsOverWells,
    "tips_in_place": TipsInPlace,
    "tip_above_bottom": TipAboveBottom,
    "volume_in_range": VolumeInRange,
    "written_is_moved": WrittenIsMoved,
    "nothing_from_nothing": NothingFromNothing,
    "draws_reach_liquid": DrawsReachLiquid,
    "stock_suffices": StockSuffices,
}


def make_check(data: Mapping[str, Any], where: str) -> Check:
    """Build a check from its description in a rule file.

    Raises:
        RuleError: If there is no such check, or its parameters are wrong.
    """
    parameters = dict(data)
    name = parameters.pop("check", None)
    if not isinstance(name, str) or name not in CHECKS:
        called = repr(name) if isinstance(name, str) else "without a name"
        raise RuleError(
            f"{where}: check: there is no check {called}; known are {', '.join(CHECKS)}"
        )
    return read_dataclass(CHECKS[name], parameters, where)


__all__ = ["CHECKS", "Check", "Doubt", "RuleContext", "Violation", "make_check"]
