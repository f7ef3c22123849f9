"""Roles that follow from the liquid's ways: what a well feeds, and what it receives."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

from ...vocabulary import WellRef
from ..rules import Common, RoleSpec
from ..trace import Trace, Usage
from .called_alike import derive_called_alike
from .diluted import derive_diluted
from .filled import derive_filled, derive_holding
from .in_place import Given, derive_common, derive_given_instead, derive_used_like, given_by
from .one_to_one import derive_called_apart, derive_one_to_one
from .roles import Roles
from .stages import is_shared_out
from .undosed import derive_undosed


def derive(roles: Roles, trace: Trace, usage: Mapping[WellRef, Usage], common: Common) -> None:
    """Roles that follow from what a well receives: a reaction is what template goes into.

    Wells that only pass liquid on (a dilution plate) are left out.
    """
    for name, spec in roles.family.roles.items():
        if spec.undosed:
            derive_undosed(roles, name, spec, trace, common)
    for name, spec in roles.family.roles.items():
        if spec.called_alike_beside:
            derive_called_alike(roles, name, spec, trace, common)
        if spec.feeds:
            _derive_source(roles, name, spec, trace)
        if spec.single_with:
            _derive_single(roles, name, spec, trace)
        if spec.one_to_one:
            derive_one_to_one(roles, name, trace)
            derive_called_apart(roles, name, trace, common)
        if spec.loaded:
            _derive_loaded(roles, name, spec.loaded, trace)
    given = given_by(trace)
    for name, spec in roles.family.roles.items():
        if spec.used_like:
            derive_used_like(roles, name, spec, trace, given, usage)
    for name, spec in roles.family.roles.items():
        if spec.passed_on:
            _pass_on(roles, name, trace, given)
        if spec.receives:
            derive_filled(roles, name, spec, trace, usage)
        if spec.holds:
            derive_holding(roles, name, spec)
        if spec.in_place_of:
            derive_given_instead(roles, name, spec, given)
    for name, spec in roles.family.roles.items():
        if spec.common_to:
            derive_common(roles, name, spec, given)
    for name, spec in roles.family.roles.items():
        if spec.feeds and (spec.dosed or spec.feeds_beside):
            _derive_levels(roles, name, spec, trace)
            derive_diluted(roles, name, trace)


def _derive_source(roles: Roles, name: str, spec: RoleSpec, trace: Trace) -> None:
    """A source without a name that goes into named wells of ``spec.feeds``, mostly."""
    wanted, beside = frozenset(spec.feeds), frozenset(spec.feeds_beside)
    given = {
        well
        for ref, wells in (trace.served() if beside else {}).items()
        if roles.has(ref, beside)
        for well in wells
    }
    specs, none_named = roles.family.roles, not roles.known(name)
    for ref, wells in trace.served(prefilled=True).items():
        used_as = none_named and any(name in specs[role].may_be for role in roles.of(ref))
        if (roles.of(ref) and not used_as) or (beside and not wells <= given):
            continue
        right = [well for well in wells if _is_telling(roles, well, wanted)]
        if len(right) * 2 > len(wells) and not _is_for_all(roles, wells, wanted):
            if all(map(roles.by_comment_only, right)) and ref not in roles.by_well:
                # It rests on no more than theirs does.
                roles.by_well[ref] = replace(
                    roles.by_well[right[0]].copied("what it is given to"), role=name, level=None
                )
            else:
                roles.derived.setdefault(ref, set()).update(roles.closure(name))


def _is_telling(roles: Roles, ref: WellRef, wanted: frozenset[str]) -> bool:
    """Whether a well has one of these roles; a blank alone does not tell what its liquid is."""
    assigned = roles.by_well.get(ref)
    blank = assigned is not None and roles.family.roles[assigned.role].level is not None
    return roles.has(ref, wanted) and not blank


def _is_for_all(roles: Roles, wells: Collection[WellRef], wanted: frozenset[str]) -> bool:
    """Whether a source also goes into most wells of another role: it is a reagent for them all."""
    by_role: dict[str, set[WellRef]] = {}
    plates = {ref.labware for ref in wells}
    for ref, assigned in roles.by_well.items():
        if ref.labware in plates and assigned.role not in wanted and not roles.has(ref, wanted):
            by_role.setdefault(assigned.role, set()).add(ref)
    others = {well for well in wells if not roles.has(well, wanted)}
    return any(2 * len(others & alike) > len(alike) for alike in by_role.values())


def _derive_levels(roles: Roles, name: str, spec: RoleSpec, trace: Trace) -> None:
    """Sources of which no level is said have that of the wells that each goes into."""
    wanted, likes = frozenset(spec.feeds), frozenset({name})
    served = {
        ref: wells for ref, wells in trace.served(prefilled=True).items() if roles.has(ref, likes)
    }
    if any(roles.level(ref) is not None for ref in served):
        return  # on another scale perhaps
    levels = {
        ref: {roles.level(well) for well in wells if roles.has(well, wanted)}
        for ref, wells in served.items()
    }
    if all(len(told) == 1 and None not in told for told in levels.values()):
        roles.derived_levels = {
            ref: level for ref, told in levels.items() for level in told if level is not None
        }


_FEWEST_SINGLES = 3
"""One or two sources may be anything, unless they stand beside samples."""


def _derive_single(roles: Roles, name: str, spec: RoleSpec, trace: Trace) -> None:
    """Unnamed sources that each go into wells of their own, beside a liquid common to all."""
    common, beside = frozenset(spec.single_with), frozenset(spec.single_beside)
    likes = frozenset({name})
    known = {ref.labware for ref in roles.by_well if roles.has(ref, likes)}
    served = trace.served()
    sources: dict[WellRef, set[WellRef]] = {}
    for ref, wells in served.items():
        for well in wells:
            sources.setdefault(well, set()).add(ref)
    fed = {ref for refs in served.values() for ref in refs}
    single = {
        ref: wells
        for ref, wells in served.items()
        if not roles.of(ref)
        and ref not in fed
        and ref not in roles.denied.get(name, ())
        and all(
            not any(roles.has(source, likes) for source in sources[well])
            and sum(not roles.of(source) for source in sources[well]) == 1
            and len(served.get(well, ())) < _SHARED  # no mix that is made in the run
            for well in wells
        )
        and _is_for_others_than_controls(roles, name, wells, among_such=ref.labware in known)
    }
    own = {
        ref: wells
        for ref, wells in single.items()
        if all(any(roles.has(source, common) for source in sources[well]) for well in wells)
    }
    if beside:
        own = _in_racks_of_their_own(roles, single, own, beside)
    for ref in own:
        if len(own) >= _FEWEST_SINGLES or ref.labware in known:
            roles.derived.setdefault(ref, set()).update(roles.closure(name))


def _in_racks_of_their_own(
    roles: Roles,
    single: Mapping[WellRef, set[WellRef]],
    own: Mapping[WellRef, set[WellRef]],
    beside: frozenset[str],
) -> dict[WellRef, set[WellRef]]:
    """Sources in labware of which nothing is said, where another one holds ``beside``.

    Where most of such a rack go into wells with the common liquid, the others are none the less
    of that kind: that liquid may have been forgotten there.
    """
    found: dict[WellRef, set[WellRef]] = {}
    if not any(roles.has(ref, beside) for ref in roles.by_well):
        return found
    for rack in {ref.labware for ref in own} - {ref.labware for ref in roles.by_well}:
        of_rack = {ref: wells for ref, wells in single.items() if ref.labware == rack}
        if _MOST * len(of_rack) <= sum(ref.labware == rack for ref in own):
            found |= of_rack
    return found


_MOST = 0.75


def _is_for_others_than_controls(
    roles: Roles, name: str, wells: Collection[WellRef], among_such: bool
) -> bool:
    """Whether a source serves mostly other wells than controls, or, ``among_such`` sources, one at
    least that is called so itself.

    Where it serves controls at all, what these should get must be known: it may be their water.
    Or else the others are not called so by their plate alone.

    Some controls are of that kind, too: a positive control is a template.
    """
    specs = roles.family.roles
    of_its_kind = {
        fed for role, spec in specs.items() if name in roles.closure(role) for fed in spec.feeds
    }
    controls = {
        well
        for well in wells
        if well in roles.by_well
        and specs[(role := roles.by_well[well].role)].parents
        and role not in of_its_kind
    }
    outright = any(well not in controls and roles.is_named(well) for well in wells)
    mostly = 2 * len(controls) < len(wells)
    return not controls or (
        ((mostly or among_such) and outright) or (mostly and all(map(roles.has_its_own, controls)))
    )


_SHARED = 3
"""A liquid that serves as many wells is a reagent for all rather than something of its own."""


def _derive_loaded(roles: Roles, name: str, kind: str, trace: Trace) -> None:
    """A loaded liquid has a use even if its name is none of the known words."""
    served = trace.served()
    topped_up = {well for wells in served.values() for well in wells}
    # In the order of the trace: a set's own order differs from process to process.
    for ref in [well.ref for well in trace.wells.values() if well.ref in roles.unnamed]:
        if not roles.of(ref) <= roles.closure(name):
            continue  # something else, or more than "destination", is said of it
        if ref not in served:
            use = "kept" if ref in topped_up else ""
        elif any(len(served.get(well, ())) >= _SHARED for well in served[ref]):
            use = "part"  # of a mix that is made in the run
        else:
            use = "shared" if len(served[ref]) >= _SHARED else "single"
        if use == kind:
            roles.derived.setdefault(ref, set()).update(roles.closure(name))


_MOST_FILLED = 3
"""So few wells are not topped up where each gets as much: they are what the tube is for."""


def _pass_on(roles: Roles, name: str, trace: Trace, volumes: Given) -> None:
    """What is drawn from a tube called NTC makes an NTC, beside reagents that others get too.

    Not where many wells have each a liquid of their own besides: that tube only tops them up.
    """
    served = trace.served()
    made = {well for wells in served.values() for well in wells}
    givers = {  # a reaction that is made here and given on makes no other one
        ref: assigned
        for ref, assigned in roles.by_well.items()
        if assigned.role == name and ref in served
        if ref not in made or is_shared_out(served[ref])
    }
    given = {well for ref in givers for well in served[ref]}
    own = {
        well
        for ref, wells in served.items()
        if ref not in givers and wells <= given
        for well in wells
    }
    for ref, assigned in givers.items():
        most = max(volumes[ref].values())
        few = len(served[ref]) <= _MOST_FILLED
        filled = {w for w in served[ref] if w not in own or (few and volumes[ref][w] >= most)}
        for well in filled - served.keys():
            before = roles.by_well.get(well)
            if before is None or before.role in roles.closure(name) - {name}:
                roles.by_well[well] = assigned.copied("drawn from there")
