"""How the run uses each well, and so on which side of its transfers it stands."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...instrumentation import OperationKind
from ...vocabulary import WellRef
from .trace import Trace


@dataclass
class Usage:
    """How the run uses a well: which came first, and whether it feeds others.

    What is emptied into the waste, a ``drain``, feeds nothing, and a well that is emptied first
    and filled then is none to draw from.
    """

    first_drawn: bool = False
    received: bool = False
    feeds: bool = False
    prefilled: bool = False
    drain: bool = False


def in_trough(trace: Trace, *keys: str) -> bool:
    """Whether one of these labware is a reservoir, where reagents stand rather than samples."""
    found = (trace.labware.get(key) for key in keys)
    return any(info is not None and info.centers_channels for info in found)


def usage_of(trace: Trace) -> dict[WellRef, Usage]:
    """How each well is used, generations of a plate taken together."""
    usages: dict[WellRef, Usage] = {}
    begun: set[WellRef] = set()
    for well in sorted(trace.wells.values(), key=lambda well: well.generation):
        usage = usages.setdefault(well.ref, Usage())
        usage.prefilled = usage.prefilled or well.prefilled
        if well.visits and well.ref not in begun:
            # A plate that comes back from the cycler is drawn from, and was filled before.
            begun.add(well.ref)
            usage.first_drawn = well.visits[0].kind is OperationKind.ASPIRATE
    served: dict[WellRef, set[WellRef]] = {}
    at_first: dict[WellRef, set[WellRef]] = {}
    for one in trace.transfers:
        source, into = one.source.ref, one.well.ref
        usages[into].received = True
        served.setdefault(source, set()).add(into)
        if not usages[source].received:
            at_first.setdefault(source, set()).add(into)
    drains = _drains(usages, served, trace)
    for ref, wells in served.items():
        usages[ref].feeds = not wells <= drains
    for ref in drains:
        usages[ref].drain = True
    taken = {visit.well.ref for visit in trace.visits if not visit.mixing}
    for ref, used in usages.items():
        # Not what is emptied into the trash, and filled then; nor what is only mixed.
        if ref in served or used.received or ref not in taken:
            used.first_drawn = used.first_drawn and used.feeds
        if used.received and at_first.get(ref, set()) <= drains:
            used.first_drawn = False  # emptied, filled again, and harvested in the end
    return usages


_FEWEST_EMPTIED = 2
"""One well that is tested before it is filled is not emptied."""


def _drains(
    usages: Mapping[WellRef, Usage], served: Mapping[WellRef, set[WellRef]], trace: Trace
) -> set[WellRef]:
    """Where old medium goes, and what stands over beads: what several wells are emptied into that
    are filled again, or a trough for what several wells got in the run.
    """
    emptied: dict[WellRef, int] = {}
    for ref, wells in served.items():
        for well in wells if usages[ref].received else ():
            if usages[ref].first_drawn or in_trough(trace, well.labware):
                emptied[well] = emptied.get(well, 0) + 1
    drawn = {visit.well.ref for visit in trace.visits if visit.kind is OperationKind.ASPIRATE}
    return {ref for ref, count in emptied.items() if count >= _FEWEST_EMPTIED and ref not in drawn}


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
