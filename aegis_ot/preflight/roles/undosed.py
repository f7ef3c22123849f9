"""Wells whose dose is 0, beside others of several doses: what they are instead."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import replace

from ...vocabulary import WellRef
from ..evidence import names_amounts
from ..rules import Common, RoleSpec
from ..text import Rank
from ..trace import Trace
from .roles import Roles

_FEWEST_DOSES = 2


def derive_undosed(roles: Roles, name: str, spec: RoleSpec, trace: Trace, common: Common) -> None:
    """Wells whose dose is 0, among others of this role, are of the role ``spec.undosed``.

    Not where the doses may be those of one drug of several: where a drug goes into wells of dose 0
    and of several others, or into those of dose 0 alone, or where wells get two. Nor where the
    numbers count something, from 0 on.
    """
    (undosed,) = spec.undosed
    kind = roles.closure(name)
    by_level: dict[float, set[WellRef]] = {}
    said = False
    for ref, assigned in roles.by_well.items():
        level = roles.level(ref)
        if assigned.role in kind and level is not None and not isinstance(level, Rank):
            by_level.setdefault(level, set()).add(ref)
            said = said or names_amounts(assigned.text, common)
    zero = by_level.pop(0, set())
    counted = by_level.keys() == set(range(1, len(by_level) + 1))
    if not zero or len(by_level) < _FEWEST_DOSES or counted or min(by_level) < 0:
        return
    served = trace.served(prefilled=True)
    if not said and _levels_in_common(roles, served, by_level) < _FEWEST_DOSES:
        return  # hours, say
    dosed = frozenset(spec.receives)
    drugs = {ref: wells for ref, wells in served.items() if roles.has(ref, dosed)}
    if _are_of_several(roles, drugs, zero, by_level):
        return
    for ref, wells in drugs.items():
        if wells <= zero and (roles.by_plate_only(ref) or roles.level(ref) == 0):
            del roles.by_well[ref]  # what takes their place stands in the rack of the doses
    for ref in zero:
        roles.by_well[ref] = replace(roles.by_well[ref].copied("dose 0"), role=undosed, whole=False)


def _are_of_several(
    roles: Roles,
    drugs: Mapping[WellRef, set[WellRef]],
    zero: set[WellRef],
    by_level: Mapping[float, set[WellRef]],
) -> bool:
    """Whether more than the one drug of these doses goes into the wells."""
    given = Counter(well for wells in drugs.values() for well in wells - zero)
    if any(count > 1 for count in given.values()):
        return True
    for ref, wells in drugs.items():
        levels = sum(not wells.isdisjoint(of_level) for of_level in by_level.values())
        known = roles.level(ref) in (*by_level, 0) or roles.by_plate_only(ref)
        if not wells.isdisjoint(zero) and (levels > 1 or (levels == 0 and not known)):
            return True
    return False


def _levels_in_common(
    roles: Roles,
    served: Mapping[WellRef, set[WellRef]],
    by_level: Mapping[float, set[WellRef]],
) -> int:
    """How many levels are those of a source as well as of the wells that it goes into."""
    return sum(
        any(
            roles.level(ref) == level and not of_level.isdisjoint(wells)
            for ref, wells in served.items()
        )
        for level, of_level in by_level.items()
    )
