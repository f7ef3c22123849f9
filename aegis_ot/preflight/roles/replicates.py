"""Replicate plates share their layout: what is said of one holds for the others."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...instrumentation import LabwareInfo
from ...vocabulary import WellRef
from ..evidence import Strength, may_be_twins
from ..trace import Trace
from .roles import Roles


def spread_over_replicates(roles: Roles, trace: Trace) -> None:
    """Give the same wells of replicate plates the roles that the family says are replicated."""
    replicated = {name for name, spec in roles.family.roles.items() if spec.replicated}
    named = {
        ref: assigned
        for ref, assigned in roles.by_well.items()
        if assigned.role in replicated
        and assigned.strength >= Strength.COMMENT
        and not assigned.whole
    }
    if not named:
        return
    layouts: dict[str, dict[str, str]] = {}
    for ref, assigned in named.items():
        layouts.setdefault(ref.labware, {})[ref.name] = assigned.role
    for one, other in _replicates(trace, layouts):
        roles.replicates.setdefault(one.key, set()).add(other.key)
        for ref, assigned in named.items():
            if ref.labware != one.key:
                continue
            copy = WellRef(other.key, ref.name, other.label or other.display_name, other.slot)
            known = roles.by_well.get(copy)
            if known is None or (
                known.role in roles.closure(assigned.role) and known.role != assigned.role
            ):
                roles.by_well[copy] = assigned.copied("replicate plate")


def _replicates(
    trace: Trace, layouts: Mapping[str, Mapping[str, str]]
) -> Iterator[tuple[LabwareInfo, LabwareInfo]]:
    """Pairs of plates of one kind that are filled alike, and called or laid out alike.

    Those that are laid out alike have nothing to learn from each other; that they are replicates
    tells which plates a liquid was forgotten on.

    Args:
        layouts: For the key of a plate the roles that are said of its wells, by name.
    """
    given: dict[str, dict[str, set[WellRef]]] = {}
    for source, well, _ in trace.feedings():
        by_name = given.setdefault(well.ref.labware, {})
        by_name.setdefault(well.ref.name, set()).add(source.ref)
    plates = [info for key, info in trace.labware.items() if key in given]
    for one in plates:
        for other in plates:
            if one is other or one.load_name != other.load_name:
                continue
            mine, theirs = layouts.get(one.key, {}), layouts.get(other.key, {})
            laid_out_alike = mine == theirs and len({*mine.values()}) > 1
            if not (laid_out_alike or may_be_twins(one, other)) or _differ(mine, theirs):
                continue
            shared = given[one.key].keys() & given[other.key].keys()
            alike = sum(not given[one.key][n].isdisjoint(given[other.key][n]) for n in shared)
            # Plates without a label must not differ in what goes into any well of both.
            if not (one.label or alike == len(shared)):
                continue
            if alike * 2 > max(len(given[one.key]), len(given[other.key])):
                yield one, other


def _differ(one: Mapping[str, str], other: Mapping[str, str]) -> bool:
    """Whether two layouts both name wells of some role, and none of them in the same place."""
    return any(
        {name for name in one if one[name] == role}.isdisjoint(
            name for name in other if other[name] == role
        )
        for role in {*one.values()} & {*other.values()}
    )
