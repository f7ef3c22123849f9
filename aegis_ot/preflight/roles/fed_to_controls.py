"""What goes into controls alone is not what its helper function or its rack is called after."""

from __future__ import annotations

from ...vocabulary import WellRef
from ..evidence import SAID_BY_FUNCTION
from ..layouts import MOST_TUBES
from ..trace import Trace
from .roles import Roles


def unsay_controls(roles: Roles, trace: Trace) -> None:
    """Forget what only a function's name says of a source that goes into controls alone.

    ``add_template(tube, ntc)`` gives the control what stands in the template's place. So does a
    tube in a rack of "drugs": the vehicle stands beside them. And a well of a plate of "drugs",
    where nothing says of any other well that it holds what these controls are to get, and they
    get nothing else of their own.
    """
    only = {
        ref
        for ref, assigned in roles.by_well.items()
        if (all(said.startswith(SAID_BY_FUNCTION) for said in assigned.evidence) or assigned.whole)
        and not roles.family.roles[assigned.role].one_liquid
    }
    fed: dict[WellRef, set[WellRef]] = {}
    given: dict[WellRef, set[WellRef]] = {}
    for_others: set[WellRef] = set()
    for source, well, _ in trace.feedings() if only else ():
        given.setdefault(well.ref, set()).add(source.ref)
        if not roles.is_set_apart(well.ref):
            for_others.add(source.ref)
        if source.ref in only:
            fed.setdefault(source.ref, set()).add(well.ref)
    awaited = _awaited(roles)
    for ref, wells in fed.items():
        of_tubes = not roles.by_well[ref].whole or _is_of_tubes(trace, ref)
        if all(
            roles.is_set_apart(well)
            and (
                of_tubes
                or (roles.by_well[well].role in awaited and given[well] - for_others <= {ref})
            )
            for well in wells
        ):
            del roles.by_well[ref]


def _awaited(roles: Roles) -> set[str]:
    """Roles of wells that have a liquid of their own, of which nothing says where it stands."""
    feeders = {name: spec.feeds for name, spec in roles.family.roles.items() if spec.one_liquid}
    return {role for name, feeds in feeders.items() if not roles.known(name) for role in feeds}


def _is_of_tubes(trace: Trace, ref: WellRef) -> bool:
    """Whether a well is one of few, in a rack or a reservoir, which hold various things."""
    info = trace.labware.get(ref.labware)
    return info is not None and (info.centers_channels or len(info.wells) <= MOST_TUBES)
