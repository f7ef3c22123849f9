"""What a well is given in the whole run."""

from __future__ import annotations

from ..trace import Well
from .case import Case, RoleSet


def received(case: Case, well: Well, liquid: RoleSet) -> tuple[float, int | None]:
    """µL of a liquid that a well receives in the run, and the line that first brought it."""
    total, line = 0.0, None
    for one in well.received:
        share = sum(part for origin, part in one.liquid.items() if case.has(origin, liquid))
        if not share and case.has(one.source, liquid):
            share = 1.0  # it stood there mixed before the run
        if share:
            total += one.volume * share
            line = line or one.visit.line
    return total, line


def filled(well: Well) -> tuple[float, int | None]:
    """µL that a well receives in the run altogether, and the line that brought the last."""
    line = well.received[-1].visit.line if well.received else None
    return sum(one.volume for one in well.received), line


def came_from(case: Case, well: Well, liquid: RoleSet) -> set[Well]:
    """The wells that a liquid came into this one from.

    Those that it stood in to begin with; where the run makes it, those of what it is made of.
    """
    stood = {origin for origin in case.meant.get(well, {}) if case.has(origin, liquid)}
    if stood:
        return stood
    made_in = {one.source for one in well.received if case.has(one.source, liquid)}
    return {part for made in made_in for part in case.meant.get(made, {made: 0})}


def is_made_of(case: Case, well: Well, wells: RoleSet) -> bool:
    """Whether a well is filled from such wells alone: a later stage, a gel."""
    return bool(well.received) and all(case.has(one.source, wells) for one in well.received)
