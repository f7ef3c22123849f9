"""What goes into the wells of all drugs and into further ones is no drug for its rack's name.

A stain, a substrate or a fixative in the rack called "compounds" is given to treated wells and to
controls alike: it tells nothing apart.
"""

from __future__ import annotations

from collections.abc import Set

from ...vocabulary import WellRef
from ..trace import Trace
from .in_place import given_by
from .roles import Roles

_SEVERAL = 2
"""So many liquids that are known by their rack only have it in common."""


def unsay_for_all(roles: Roles, trace: Trace) -> None:
    """Forget that such a well is dosed, where no more than its labware says so."""
    specs = roles.family.roles
    dosed = {
        ref: assigned.whole
        for ref, assigned in roles.by_well.items()
        if specs[assigned.role].dosed and specs[assigned.role].side == "source"
    }
    if True not in dosed.values():
        return
    given = {ref: wells.keys() for ref, wells in given_by(trace).items() if ref in dosed}
    for ref, wells in given.items():
        beside = [other for other in given if not wells.isdisjoint(given[other])]
        within = [other for other in beside if given[other] < wells]
        theirs = {well for other in within for well in given[other]}
        known = len(within) >= _SEVERAL or any(not dosed[other] for other in within)
        for_all = theirs < wells and all(given[other] <= wells for other in beside)
        if dosed[ref] and known and for_all and _controls_on_plates_of(wells, roles) <= wells:
            del roles.by_well[ref]


def _controls_on_plates_of(wells: Set[WellRef], roles: Roles) -> Set[WellRef]:
    """The wells that are named as controls, as far as any are, on the plates of these."""
    specs = roles.family.roles
    plates = {well.labware for well in wells}
    return {
        ref
        for ref, assigned in roles.by_well.items()
        if ref.labware in plates
        and specs[assigned.role].replicated
        and not specs[assigned.role].dosed
    }
