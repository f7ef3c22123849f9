"""Roles that follow from whose place a liquid takes: the volume and the company tell.

What goes into wells of its own, in the volume in which the vehicle goes into the others, is a
drug. A well that gets water, in the volume in which the others get template, is a no-template
control (PCR-6: the NTC gets water in the template's place).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping

from ...vocabulary import WellRef
from ..rules import RoleSpec
from ..trace import Trace, Usage, in_trough
from .roles import Roles

Given = Mapping[WellRef, Mapping[WellRef, float]]
"""µL that each source gives to each well, in the whole run."""

_FEWEST_SHARING = 4
_FEWEST_SERVED = 3
_NEARLY_ALL = 0.8
"""One of five may have been forgotten."""

_MOSTLY = 0.5

_ALIKE = 0.02
"""Volumes that differ by less, as a share of the smaller, are one."""


def derive_used_like(
    roles: Roles,
    name: str,
    spec: RoleSpec,
    trace: Trace,
    given: Given,
    usage: Mapping[WellRef, Usage],
) -> None:
    """Unnamed sources that go, each into wells of its own, where one of ``spec.used_like`` goes
    into the others: onto the same labware, in the same volume.

    Where some are named, only a drug in the same rack as these is one more. Not those that go
    into most of the others' wells as well (a reagent for all), nor into controls; what stands in
    a trough is a drug, but no sample.
    """
    models = {ref: into for ref, into in given.items() if roles.has(ref, frozenset(spec.used_like))}
    others = {well for into in models.values() for well in into}
    volumes = {volume for into in models.values() for volume in into.values()}
    plates = {well.labware for well in others}
    named = {ref: into for ref, into in given.items() if roles.has(ref, frozenset({name}))}
    racks = {ref.labware for ref in named} if spec.dosed else set()
    taken = {well for into in named.values() for well in into}
    unnamed = {ref: into for ref, into in given.items() if not roles.of(ref)}
    fed = Counter(well for into in unnamed.values() for well in into)
    # What shares a tip with liquids that differ, as standards do, may be one of them.
    differing = frozenset(
        like for like in spec.used_like if not roles.family.roles[like].one_liquid
    )
    in_series = _in_one_tip_with(trace, {ref for ref in models if roles.has(ref, differing)})
    for ref, into in unnamed.items():
        if named and ref.labware not in racks:
            continue
        if ref in in_series or ref in roles.denied.get(name, ()):
            continue
        if not spec.dosed and in_trough(trace, ref.labware):
            continue
        own = into.keys() - others
        controls = [well for well in own if roles.is_set_apart(well)]
        mostly_own = len(own) >= _MOSTLY * len(into) and len(controls) < _MOSTLY * len(own)
        for_all = len(others & into.keys()) >= _MOSTLY * len(others)
        alone = own.isdisjoint(taken) and all(fed[well] == 1 for well in own)
        as_much = all(_is_one_of(volume, volumes) for volume in into.values())
        there = all(well.labware in plates and not _feeds(usage, well) for well in own)
        told = any(well not in controls and roles.is_named(well) for well in own)
        if not (told or spec.dosed or all(map(roles.has_its_own, controls))):
            continue  # what controls get beside wells of which nothing is said may be water
        if own and mostly_own and not for_all and alone and as_much and there:
            roles.derived.setdefault(ref, set()).update(roles.closure(name))


def _feeds(usage: Mapping[WellRef, Usage], ref: WellRef) -> bool:
    return ref in usage and usage[ref].feeds


def derive_given_instead(roles: Roles, name: str, spec: RoleSpec, given: Given) -> None:
    """Wells that get ``spec.gets`` in the volume in which more wells get ``spec.in_place_of``.

    Only where no well is named for this role, where nothing that has no name goes into them, and
    where another liquid goes into all of these wells.
    """
    if roles.known(name):
        return
    taken = _given_of(roles, given, spec.in_place_of)
    instead = _given_of(roles, given, spec.gets)
    volumes, plates = set(taken.values()), {well.labware for well in taken}
    unknown = {well for ref, wells in given.items() if not roles.of(ref) for well in wells}
    either = frozenset((*spec.gets, *spec.in_place_of))
    shared = {
        well
        for ref, wells in given.items()
        if not roles.has(ref, either) and not taken.keys().isdisjoint(wells)
        for well in wells
    }
    found = {
        well
        for well, volume in instead.items()
        if well not in taken
        and well not in unknown
        and well in shared
        and well not in given
        and well.labware in plates
        and _is_one_of(volume, volumes)
        and roles.of(well) <= roles.closure(name)
    }
    if len(found) < len(taken):
        for well in found:
            roles.derived.setdefault(well, set()).update(roles.closure(name))


def derive_common(roles: Roles, name: str, spec: RoleSpec, given: Given) -> None:
    """Unnamed sources of which nearly all wells of ``spec.common_to`` get one, and as much of it.

    Only where no well is named for this role.
    """
    wanted = frozenset(spec.common_to)
    if roles.known(name):
        return
    filled = {well for wells in given.values() for well in wells} - given.keys()
    wells = {well for well in filled if roles.has(well, wanted)}
    unnamed = {
        ref: into for ref, into in given.items() if into.keys() & wells and not roles.of(ref)
    }
    fed = Counter(well for into in unnamed.values() for well in into)
    usual = sum(_usual(into) for into in unnamed.values())
    if (
        len(wells) >= _FEWEST_SHARING
        and all(fed[well] <= 1 for well in wells)
        and all(len(into) >= _FEWEST_SERVED for into in unnamed.values())
        and _NEARLY_ALL * len(wells) <= sum(fed[well] for well in wells)
        and _NEARLY_ALL * fed.total() <= usual
    ):
        for ref in unnamed:
            roles.derived.setdefault(ref, set()).update(roles.closure(name))


def _usual(wells: Mapping[WellRef, float]) -> int:
    """How many of these wells get the volume that most of them get."""
    return max(Counter(wells.values()).values(), default=0)


def given_by(trace: Trace) -> dict[WellRef, dict[WellRef, float]]:
    """µL that each well that is drawn from gives to each other one, rounded."""
    found: dict[WellRef, dict[WellRef, float]] = {}
    for visit in trace.visits:
        for source, volume, _, _ in visit.parts:
            if source is not None and source is not visit.well and volume > 0:
                given = found.setdefault(source.ref, {})
                given[visit.well.ref] = round(given.get(visit.well.ref, 0.0) + volume, 3)
    return found


def _given_of(roles: Roles, given: Given, wanted: Collection[str]) -> dict[WellRef, float]:
    """µL that each well gets from the sources of these roles."""
    found: dict[WellRef, float] = {}
    for ref, wells in given.items():
        if roles.has(ref, frozenset(wanted)):
            for well, volume in wells.items():
                found[well] = found.get(well, 0.0) + volume
    return found


def _is_one_of(volume: float, volumes: Collection[float]) -> bool:
    return any(abs(volume - other) <= _ALIKE * min(volume, other) for other in volumes)


def _in_one_tip_with(trace: Trace, refs: Collection[WellRef]) -> set[WellRef]:
    """Wells that a tip touched which touched one of these as well."""
    found: set[WellRef] = set()
    for tip in trace.tips if refs else ():
        touched = {well.ref for well in tip.touched}
        if not touched.isdisjoint(refs):
            found |= touched
    return found
