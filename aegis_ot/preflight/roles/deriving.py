"""Roles that follow from the liquid's ways: what a well feeds, and what it receives."""

from __future__ import annotations

from ...vocabulary import WellRef
from ..rules import RoleSpec
from ..trace import Trace, Well
from .roles import Roles

_FEWEST_PAIRS = 3
_SMALLEST_PLATE = 24
_MOST_TUBES = 24
"""Labware of no more wells is a rack or a reservoir, in which various things stand."""
_SHARED = 3
"""A liquid that serves as many wells is a reagent for all rather than something of its own."""


def derive(roles: Roles, trace: Trace) -> None:
    """Give wells the roles that follow from what they give and receive.

    A reaction is what template goes into; wells that only pass liquid on (a dilution plate) are
    none. A source without a name is what the wells that it feeds are named for.
    """
    _unsay_by_use(roles, trace)
    for name, spec in roles.family.roles.items():
        if spec.feeds:
            _derive_source(roles, name, spec, trace)
        if spec.one_to_one:
            _derive_one_to_one(roles, name, trace)
        if spec.loaded:
            _derive_loaded(roles, name, spec.loaded, trace)
    for name, spec in roles.family.roles.items():
        if spec.receives:
            _derive_receiving(roles, name, spec, trace)


def _unsay_by_use(roles: Roles, trace: Trace) -> None:
    """Forget what only the name of a labware says of a source, where its use speaks against it.

    In a rack of "inhibitors" the vehicle stands beside them, and goes into controls alone; and so
    does a stain, which goes into all wells.
    """
    specs = roles.family.roles
    served = trace.served(prefilled=True)
    named = {
        ref
        for ref, assigned in roles.by_well.items()
        if assigned.whole and not specs[assigned.role].one_liquid and ref in served
    }
    fed = {well for ref in named for well in served[ref]}
    controls = {well for well in fed if _is_control(roles, well)}
    for ref in named:
        into = served[ref]
        # Of a plate that is stamped, each well serves one: that says nothing.
        various = len(trace.labware[ref.labware].wells) <= _MOST_TUBES
        alone = various and into <= controls
        for_all = 2 * len(into - controls) > len(fed - controls)
        if not controls.isdisjoint(into) and (alone or for_all):
            del roles.by_well[ref]


def _is_control(roles: Roles, ref: WellRef) -> bool:
    assigned = roles.by_well.get(ref)
    return assigned is not None and roles.is_declared(assigned.role)


def _derive_source(roles: Roles, name: str, spec: RoleSpec, trace: Trace) -> None:
    """A source without a name that mostly goes into named wells of ``spec.feeds``."""
    wanted = frozenset(spec.feeds)
    for ref, wells in trace.served(prefilled=True).items():
        if roles.of(ref):
            continue
        if any(_is_control(roles, well) for well in wells):
            continue  # a stain, a read-out: a reagent for all
        right = [well for well in wells if roles.has(well, wanted)]
        if len(right) * 2 > len(wells) and not all(map(roles.is_doubtful, right)):
            roles.derive(ref, name)


def _derive_one_to_one(roles: Roles, name: str, trace: Trace) -> None:
    """Wells of a plate that each serve one well of their own hold each something of its own.

    A liquid that stands in several wells (a strip of master mix) serves several wells each.
    """
    served = trace.served(prefilled=True)
    by_labware: dict[str, list[WellRef]] = {}
    for ref in served:
        info = trace.labware.get(ref.labware)
        if info is not None and not info.centers_channels:
            by_labware.setdefault(ref.labware, []).append(ref)
    for key, refs in by_labware.items():
        if len(trace.labware[key].wells) < _SMALLEST_PLATE or len(refs) < _FEWEST_PAIRS:
            continue
        into = {well for ref in refs for well in served[ref]}
        if all(len(served[ref]) == 1 and not roles.of(ref) for ref in refs) and (
            len(into) == len(refs)
        ):
            roles.apart.update(refs)
            for ref in refs:
                roles.derive(ref, name)


def _derive_loaded(roles: Roles, name: str, kind: str, trace: Trace) -> None:
    """A loaded liquid has a use even if its name is none of the known words."""
    served = trace.served()
    topped_up = {well for wells in served.values() for well in wells}
    # In the order of the trace: a set's own order differs from process to process.
    for ref in [well.ref for well in trace.wells.values() if well.ref in roles.unnamed]:
        if not roles.of(ref) <= roles.family.closure(name):
            continue  # something else, or more than "destination", is said of it
        if ref not in served:
            use = "kept" if ref in topped_up else ""
        elif any(len(served.get(well, ())) >= _SHARED for well in served[ref]):
            use = ""  # part of a mix that is made in the run
        else:
            use = "shared" if len(served[ref]) >= _SHARED else "single"
        if use == kind:
            roles.derive(ref, name)


def _derive_receiving(roles: Roles, name: str, spec: RoleSpec, trace: Trace) -> None:
    """Wells that receive a liquid of ``spec.receives`` and pass nothing on."""
    wanted = frozenset(spec.receives)
    for well in trace.wells.values():
        used = trace.usage[well.ref]
        if not used.received or used.first_drawn or used.drain or used.feeds:
            continue
        assigned = roles.by_well.get(well.ref)
        unlike = assigned is not None and assigned.role not in roles.family.closure(name)
        if assigned is not None and unlike and not assigned.whole:
            continue
        if unlike and _receives_what_it_is_named_for(roles, well):
            continue
        if _receives(roles, well, wanted, frozenset({name})):
            if unlike:
                del roles.by_well[well.ref]  # calibrators stand on the "CSF plate" as well
            roles.derive(well.ref, name)


def _receives_what_it_is_named_for(roles: Roles, well: Well) -> bool:
    wanted = frozenset(roles.family.roles[roles.by_well[well.ref].role].receives)
    return not wanted or _receives(roles, well, wanted, frozenset())


def _receives(roles: Roles, well: Well, wanted: frozenset[str], made: frozenset[str]) -> bool:
    """Whether a liquid of these roles comes into a well, and not from one that it made already: a
    product that goes on to a gel makes no reaction there.
    """
    return any(
        roles.has(origin.ref, wanted)
        for one in well.received
        if not roles.has(one.source.ref, made)
        for origin in one.liquid
    )
