"""What a well is given in the whole run."""

from __future__ import annotations

from ..trace import Well
from .case import Case, RoleSet, delivered


def received(case: Case, well: Well, liquid: RoleSet) -> tuple[float, int | None]:
    """µL of a liquid that a well receives in the run, and the line that first brought it."""
    total, line = 0.0, None
    for visit in case.trace.deliveries(well):
        for source, volume, composition, _ in visit.parts:
            if source is None or source is well:
                continue
            share = sum(part for origin, part in composition.items() if case.has(origin, liquid))
            if not share and case.has(source, liquid):
                share = 1.0  # it stood there mixed before the run
            if share:
                total += volume * share
                line = line or visit.line
    return total, line


def filled(case: Case, well: Well) -> tuple[float, int | None]:
    """µL that a well receives in the run altogether, and the line that brought the last."""
    total, line = 0.0, None
    for visit in case.trace.deliveries(well):
        for _, volume, _, _ in delivered(visit):
            total += volume
        line = visit.line
    return total, line


def came_from(case: Case, well: Well, liquid: RoleSet) -> set[Well]:
    """The wells that a liquid came into this one from.

    Those that it stood in to begin with; where the run makes it, those of what it is made of.
    """
    stood = {origin for origin in case.meant.get(well, {}) if case.has(origin, liquid)}
    if stood:
        return stood
    made_in = {source for source in case.sources_of(well) if case.has(source, liquid)}
    return {part for made in made_in for part in case.meant.get(made, {made: 0})}
