"""A name for the well that a multi-channel pipette is aimed at names its whole column."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...vocabulary import WellRef
from ..evidence import Strength
from ..trace import Trace
from .choosing import Candidate
from .roles import Roles


def spread_over_channels(
    roles: Roles, trace: Trace, candidates: Mapping[WellRef, Sequence[Candidate]]
) -> None:
    """Give the other wells of a column the role of the one that is named.

    Only where the named well is never used alone, and the others have no better evidence.
    """
    fed = _fed_by(roles, trace)
    for first, group in trace.groups.items():
        assigned = roles.by_well.get(first)
        if assigned is None or first in trace.singles:
            continue
        for ref in group:
            if ref == first or ref in trace.singles:
                continue
            one, own = fed.get(first, set()), fed.get(ref, set())
            if one - own and own - one:
                continue  # water in the first channel, samples in the others
            other = roles.by_well.get(ref)
            if other is not None and other.role == assigned.role:
                if other.whole and not assigned.whole:
                    roles.by_well[ref] = assigned.copied("same channel group")
                elif other.level is None:
                    other.level = assigned.level
            elif other is None or (
                other.strength <= assigned.strength
                and assigned.role != other.role
                and assigned.role not in roles.closure(other.role)
                and not _has_its_own(candidates.get(ref, ()), first, assigned.role)
                and not assigned.whole
            ):
                roles.by_well[ref] = assigned.copied("same channel group")


def _has_its_own(found: Sequence[Candidate], first: WellRef, role: str) -> bool:
    """Whether another role is named for a well, and not just for its whole labware, nor by weak
    evidence that speaks of the first well as well, where the name has overruled it.
    """
    return any(
        other != role
        and not clue.whole
        and not (clue.strength <= Strength.LOOSE_NAME and first in clue.wells)
        for _, other, clue, _ in found
    )


def _fed_by(roles: Roles, trace: Trace) -> dict[WellRef, set[str]]:
    """The named roles of all that each well is filled from."""
    found: dict[WellRef, set[str]] = {}
    for source, well, _ in trace.feedings():
        assigned = roles.by_well.get(source.ref)
        if assigned is not None:
            found.setdefault(well.ref, set()).add(assigned.role)
    return found
