"""What a carry-over check cannot decide: tips that meet wells of which nothing says what they hold.

A rule counts as decided only if every well that could break it has a role, or is shown to be
harmless. An unnamed trough that a tip enters with template on it may well be the water.
"""

from __future__ import annotations

from collections.abc import Set

from ..trace import Well
from .case import Case, RoleSet, carried_liquids
from .check import Doubt, at, place


def unnamed_contact(case: Case, carriers: Set[Well], into: RoleSet) -> Doubt | None:
    """The first contact that would break a rule if an unnamed source were what it may be.

    Either the tip carries one of the ``carriers`` into an unnamed source that serves several wells,
    or what it drew from an unnamed source into a well of ``into``.

    Args:
        case: The protocol.
        carriers: Wells whose liquid must not be carried.
        into: Roles of the wells that it must not be carried into.
    """
    unnamed = [well for well in case.trace.wells.values() if not case.of(well)]
    drawn = {well for well in unnamed if case.is_drawn_first(well)}
    stocks: set[Well] = set()
    if any(case.family.roles[role].side != "destination" for role in into):
        stocks = {well for well in unnamed if len(case.destinations.get(well, ())) > 1}
    for visit in case.trace.visits if drawn or stocks else ():
        well = visit.well
        if not visit.contact or not visit.carried or well.ref in case.waste:
            continue
        is_stock = well in stocks
        if not is_stock and not case.has(well, into):
            continue
        for origin, met in carried_liquids(visit):
            if origin not in (carriers if is_stock else drawn):
                continue
            if origin in case.meant.get(well, {}) or case.same_liquid(origin, well):
                continue
            if is_stock:
                return Doubt(
                    f"nothing says what {place(well)} holds, and the tip that met "
                    f"{case.title(origin)} {at(met.line)} enters it {at(visit.line)}"
                )
            return Doubt(
                f"nothing says what {place(origin)} holds, and its tip enters the "
                f"{case.title(well)} {place(well)} {at(visit.line)}"
            )
    return None
