"""What a carry-over check cannot decide: tips that meet wells of which nothing says what they hold.

A rule counts as decided only if every well that could break it has a role, or is shown to be
harmless. An unnamed trough that a tip enters with template on it may well be the water.
"""

from __future__ import annotations

from collections.abc import Set

from ..trace import Visit, Well
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
    if not drawn and not stocks:
        return None
    for visit in case.trace.visits:
        if not visit.contact or not visit.carried or visit.well.ref in case.waste:
            continue
        if visit.well in stocks:
            for origin, met in carried_liquids(visit):
                if origin in carriers and not _is_meant(case, visit.well, origin):
                    return Doubt(
                        f"nothing says what {place(visit.well)} holds, and the tip that met "
                        f"{case.title(origin)} {at(met.line)} enters it {at(visit.line)}"
                    )
        elif drawn and case.has(visit.well, into):
            found = _unnamed_on_tip(case, visit, drawn)
            if found is not None:
                return Doubt(
                    f"nothing says what {place(found)} holds, and its tip enters the "
                    f"{case.title(visit.well)} {place(visit.well)} {at(visit.line)}"
                )
    return None


def _unnamed_on_tip(case: Case, visit: Visit, drawn: Set[Well]) -> Well | None:
    """An unnamed source whose liquid is on the tip, and none of it is meant for this well."""
    for origin, _ in carried_liquids(visit):
        if origin in drawn and not _is_meant(case, visit.well, origin):
            return origin
    return None


def _is_meant(case: Case, well: Well, origin: Well) -> bool:
    """Whether a measured volume of a liquid is brought to a well, or both hold the same."""
    return origin is well or origin in case.meant.get(well, {}) or case.same_liquid(origin, well)
