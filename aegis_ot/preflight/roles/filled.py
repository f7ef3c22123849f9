"""Roles that follow from what a well holds: a reaction is what template goes into."""

from __future__ import annotations

from collections.abc import Mapping

from ...vocabulary import WellRef
from ..rules import RoleSpec
from ..trace import Trace, Usage, Well
from .roles import Roles
from .stages import Stage, stage_of


def derive_filled(
    roles: Roles, name: str, spec: RoleSpec, trace: Trace, usage: Mapping[WellRef, Usage]
) -> None:
    """Give the role ``name`` to the wells that receive a liquid of ``spec.receives``."""
    wanted = frozenset(spec.receives)
    stage = stage_of(roles, trace, name, frozenset(spec.receives_with))
    for well in trace.wells.values():
        used = usage.get(well.ref)
        if used is None or not used.received or used.first_drawn or used.drain:
            continue
        if used.feeds and not stage.holds(well.ref):
            continue
        assigned = roles.by_well.get(well.ref)
        unlike = assigned is not None and assigned.role not in roles.closure(name)
        if unlike and not _may_be_another(roles, well, trace):
            continue
        if _receives(roles, well, trace, stage, wanted):
            if assigned is not None and unlike:
                del roles.by_well[well.ref]
                if assigned.level is not None:
                    roles.told_levels.setdefault(well.ref, assigned.level)
            roles.derived.setdefault(well.ref, set()).update(roles.closure(name))


def derive_holding(roles: Roles, name: str, spec: RoleSpec) -> None:
    """Give the role ``name`` to wells of its parents that hold a liquid of ``spec.holds`` already.

    Their loaded liquid is called so. Not where wells of such a role are known: from those it comes.
    """
    if any(map(roles.known, spec.holds)):
        return
    for ref, named in roles.of_liquid.items():
        if not named.isdisjoint(spec.holds) and roles.of(ref) == frozenset(spec.parents):
            roles.derived.setdefault(ref, set()).update(roles.closure(name))


def _receives(roles: Roles, well: Well, trace: Trace, stage: Stage, wanted: frozenset[str]) -> bool:
    """Whether a liquid of these roles comes into a well, straight or by wells that make a mix."""
    return any(
        roles.has(origin.ref, wanted)
        for visit in trace.deliveries(well)
        for source, _, liquid, _ in visit.parts
        if source is None
        or roles.has(source.ref, wanted)
        or well.ref in stage.given
        or not stage.holds(source.ref)
        for origin in liquid
    )


def _may_be_another(roles: Roles, well: Well, trace: Trace) -> bool:
    """Whether only the plate's name says what a well is for, and the run gives it another use.

    On a "CSF plate" stand the calibrators as well.
    """
    if not roles.by_plate_only(well.ref):
        return False
    wanted = frozenset(roles.family.roles[roles.by_well[well.ref].role].receives)
    return bool(wanted) and not any(
        roles.has(origin.ref, wanted)
        for visit in trace.deliveries(well)
        for _, _, liquid, _ in visit.parts
        for origin in liquid
    )
