"""How the run uses each well, and so on which side of its transfers it stands."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...instrumentation import OperationKind
from ...vocabulary import WellRef
from ..trace import Trace


@dataclass
class Usage:
    """How the run uses a well: which came first, and whether it feeds others."""

    first_drawn: bool = False
    received: bool = False
    feeds: bool = False
    prefilled: bool = False


def usage_of(trace: Trace) -> dict[WellRef, Usage]:
    """How each well is used, generations of a plate taken together."""
    usages: dict[WellRef, Usage] = {}
    for well in trace.wells.values():
        usage = usages.setdefault(well.ref, Usage())
        usage.prefilled = usage.prefilled or well.prefilled
        if well.visits and well.visits[0].kind is OperationKind.ASPIRATE:
            usage.first_drawn = True
    for visit in trace.visits:
        for source, volume, _, _ in visit.parts:
            if source is not None and source is not visit.well and volume > 0:
                usages[source.ref].feeds = True
                usages[visit.well.ref].received = True
    return usages


class Sides:
    """On which side of the run's transfers a well stands.

    A well that the run never uses stands where the others of its labware stand.
    """

    def __init__(self, usage: Mapping[WellRef, Usage]) -> None:
        self._usage = usage
        self._labware: dict[str, set[str]] = {}
        for ref, used in usage.items():
            side = _side(used)
            if side:
                self._labware.setdefault(ref.labware, set()).add(side)

    def __call__(self, ref: WellRef) -> tuple[str, bool]:
        """``source``, ``destination`` or ``""``, and whether it passes liquid on as well."""
        used = self._usage.get(ref)
        side = _side(used) if used else ""
        if not side:
            others = self._labware.get(ref.labware, set())
            if len(others) == 1:
                side = next(iter(others))
            elif used and used.prefilled:
                side = "source"
        return side, bool(used and used.feeds and used.received)


def _side(used: Usage) -> str:
    if used.first_drawn:
        return "source"
    return "destination" if used.received else ""
