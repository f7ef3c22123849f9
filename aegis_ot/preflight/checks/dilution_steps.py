"""What a dilution step is, and what fills a well of a series."""

from __future__ import annotations

import math

from ...instrumentation import OperationKind
from ..trace import Composition, Transfer, Visit, Well
from .case import Case

NO_SERIES = "no chain of transfers from well to well was found"


def diluent_roles(case: Case) -> frozenset[str]:
    """Roles that the family dilutes with."""
    spec = case.family.series
    return frozenset(spec.diluent) if spec else frozenset()


def stock_roles(case: Case) -> frozenset[str]:
    """Roles that the family dilutes."""
    spec = case.family.series
    return frozenset(spec.stock) if spec else frozenset()


def diluent_arrivals(case: Case, well: Well) -> list[int]:
    """Index of each delivery of diluent to a well."""
    diluent = diluent_roles(case)
    return [
        visit.index
        for visit in case.trace.deliveries(well)
        if any(
            source is not None
            and (
                case.has(source, diluent)
                or source in case.fillers
                or _is_made_diluent(case, well, source, liquid)
            )
            for source, _, liquid, _ in visit.parts
        )
    ]


def _is_made_diluent(case: Case, well: Well, source: Well, liquid: Composition) -> bool:
    """Whether a source elsewhere was filled in the run with diluent, and with no stock."""
    return (
        source.ref.labware != well.ref.labware
        and not source.prefilled
        and any(case.has(origin, diluent_roles(case)) for origin in liquid)
        and not any(case.has(origin, stock_roles(case)) for origin in liquid)
    )


def is_dilution(case: Case, step: Transfer) -> bool:
    """Whether a transfer is a dilution step.

    Undiluted stock in an empty first well is none: that well never gets diluent, or only after it
    was drawn from, when all wells are filled up for the reader.
    """
    if not step.from_stock or case.has(step.well, diluent_roles(case)):
        return True
    drawn = [
        visit.index
        for visit in step.well.visits
        if visit.kind is OperationKind.ASPIRATE and not visit.mixing
    ]
    then = min((index for index in drawn if index > step.visit.index), default=None)
    arrivals = diluent_arrivals(case, step.well)
    return any(then is None or index < then for index in arrivals)


def is_mixed(case: Case, step: Transfer) -> bool:
    """Whether a step's well is mixed before liquid is carried on from there."""
    drawn = next_draw(step)
    return case.trace.mixed_since(step.well, step.visit.index, drawn.index if drawn else math.inf)


def next_draw(step: Transfer) -> Visit | None:
    """The first draw from a step's well after it, mixing apart."""
    return next(
        (
            visit
            for visit in step.well.visits
            if visit.index > step.visit.index
            and visit.kind is OperationKind.ASPIRATE
            and not visit.mixing
        ),
        None,
    )
