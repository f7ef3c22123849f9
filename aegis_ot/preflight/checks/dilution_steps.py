"""What a dilution step is, what fills a well of a series, and what all checks of series share."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from ...instrumentation import OperationKind
from ..trace import Transfer, Visit, Well
from .case import Case
from .check import Check, Doubt, Result
from .series import Series


@dataclass(frozen=True)
class SeriesCheck(Check):
    """A check on each dilution series by itself."""

    def find(self, case: Case) -> Iterator[Result]:
        """Judge each series."""
        if not case.series:
            yield Doubt("no chain of transfers from well to well was found")
        for series in case.series:
            yield from self.along(case, series)

    def along(self, case: Case, series: Series) -> Iterator[Result]:
        """What is wrong with one series, or cannot be judged of it."""
        raise NotImplementedError


def diluent_arrivals(case: Case, well: Well) -> list[int]:
    """Index of each delivery of diluent to a well."""
    return [
        one.visit.index
        for one in well.received
        if case.has(one.source, case.diluent)
        or one.source in case.fillers
        or _is_made_diluent(case, one)
    ]


def _is_made_diluent(case: Case, one: Transfer) -> bool:
    """Whether a source elsewhere was filled in the run with diluent, and with no stock."""
    return (
        one.source.ref.labware != one.well.ref.labware
        and not one.source.prefilled
        and case.brings(one, case.diluent)
        and not case.brings(one, case.stock)
    )


def dilutions(case: Case, series: Series) -> list[Transfer]:
    """The steps that dilute.

    Undiluted stock in an empty first well is none: that well never gets diluent, or only after it
    was drawn from, when all wells are filled up for the reader.
    """
    return [
        step
        for step in series.steps
        if step.source in series.position
        or case.has(step.well, case.diluent)
        or _is_filled_before_drawn(case, step)
    ]


def _is_filled_before_drawn(case: Case, step: Transfer) -> bool:
    drawn = next_draw(step)
    then = drawn.index if drawn else math.inf
    return any(index < then for index in diluent_arrivals(case, step.well))


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
