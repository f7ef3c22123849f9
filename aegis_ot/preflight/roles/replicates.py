"""Replicate plates share their layout: what is said of one holds for the others."""

from __future__ import annotations

from collections.abc import Iterator

from ...instrumentation import LabwareInfo
from ...vocabulary import WellRef
from ..text import tokens
from ..trace import Trace
from .clues import Strength
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
    for one, other in _replicates(trace):
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


def _replicates(trace: Trace) -> Iterator[tuple[LabwareInfo, LabwareInfo]]:
    """Pairs of plates of one kind, called the same but for a number, and filled alike."""
    given: dict[str, dict[str, set[WellRef]]] = {}
    for source, well, _ in trace.feedings():
        by_name = given.setdefault(well.ref.labware, {})
        by_name.setdefault(well.ref.name, set()).add(source.ref)
    plates = [info for key, info in trace.labware.items() if key in given]
    for one in plates:
        for other in plates:
            if one is other or not called_alike(one, other):
                continue
            shared = given[one.key].keys() & given[other.key].keys()
            alike = sum(not given[one.key][n].isdisjoint(given[other.key][n]) for n in shared)
            # Plates without a label must not differ in what goes into any well of both.
            if not (one.label or alike == len(shared)):
                continue
            if alike * 2 > max(len(given[one.key]), len(given[other.key])):
                yield one, other


def called_alike(one: LabwareInfo, other: LabwareInfo) -> bool:
    """Whether two labware are of one kind and have one name but for a number."""
    return one.load_name == other.load_name and _called(one) == _called(other)


def _called(info: LabwareInfo) -> tuple[str, ...]:
    return tuple(word for word in tokens(info.label) if len(word) > 1 and not word.isdigit())
