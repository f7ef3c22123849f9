"""How concentrated wells are that the run itself dilutes from one stock, one out of the other."""

from __future__ import annotations

from collections.abc import Mapping

from ..trace import Trace, Well
from .roles import Roles


def derive_diluted(roles: Roles, name: str, trace: Trace) -> None:
    """Wells of a role that are made of one stock of that role and of other liquids.

    Not where levels of some of them are said, or something stood in one before the run.
    """
    alike = frozenset({name})
    shares: dict[Well, float] = {}
    stocks: set[Well] = set()
    for well in trace.wells.values():
        received = _received(well, trace) if roles.has(well.ref, alike) else {}
        ours = {origin for origin in received if roles.has(origin.ref, alike)}
        if not ours:
            continue
        if well.prefilled or roles.level(well.ref) is not None:
            return
        stocks |= ours
        shares[well] = sum(received[origin] for origin in ours) / sum(received.values())
    undiluted = [well for well, share in shares.items() if share >= 1]
    if len(stocks) != 1 or len(undiluted) > 1:
        return
    (stock,) = stocks
    level = roles.level(stock.ref)
    if level == 0:
        return
    if level is None:
        level = roles.derived_levels[stock.ref] = 1.0
    on_its_scale = type(level)
    for well, share in shares.items():
        roles.derived_levels[well.ref] = on_its_scale(level * share)


def _received(well: Well, trace: Trace) -> Mapping[Well, float]:
    """How much of each liquid came into a well, in µL by the well in which it stood at first."""
    found: dict[Well, float] = {}
    for visit in trace.deliveries(well):
        for source, volume, liquid, _ in visit.parts:
            if source is not None and source is not well:
                for origin, share in liquid.items():
                    found[origin] = found.get(origin, 0.0) + volume * share
    return {origin: volume for origin, volume in found.items() if volume > 0}
