"""Checks on the steps of a dilution series: each is mixed, and they run one way."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ...vocabulary import Site
from ..trace import Transfer, Well
from .case import Case
from .check import Doubt, Result, Violation, at, place
from .dilution_steps import SeriesCheck, dilutions, is_mixed, next_draw
from .series import Series
from .series_links import branching

_BY_HAND = "None of the wells in which this series ends is mixed; that may be done by hand."


@dataclass(frozen=True)
class SeriesMixed(SeriesCheck):
    """Every dilution step is mixed in its well before liquid is drawn on from there."""

    def along(self, case: Case, series: Series) -> Iterator[Result]:
        """Look for a mix between each step and the next draw from its well."""
        steps = dilutions(case, series)
        by_hand = _left_to_hand(case, steps)
        for step in steps:
            if is_mixed(case, step):
                continue
            drawn = next_draw(step)
            then = f"before liquid is carried on {at(drawn.line)}" if drawn else "afterwards"
            yield Violation(
                f"The dilution into {place(step.well)} {at(step.visit.line)} is not mixed {then}.",
                (
                    Site(step.drawn, step.source.ref, "drew the more concentrated solution"),
                    Site(step.visit.line, step.well.ref, "diluted here, not mixed"),
                ),
                step.well,
                (step.visit.line,),
                warning=_BY_HAND if step.well in by_hand else "",
            )


def _left_to_hand(case: Case, steps: Sequence[Transfer]) -> set[Well]:
    """The last wells of a series that branches, where none of them is mixed: one may be forgotten,
    all are left to whoever takes them off the deck.
    """
    ends = [step for step in steps if next_draw(step) is None]
    wells = {step.well for step in ends}
    return set() if len(wells) < 2 or any(is_mixed(case, step) for step in ends) else wells


@dataclass(frozen=True)
class SeriesDirection(SeriesCheck):
    """The series runs from the most to the least concentrated well, one well at a time."""

    def along(self, case: Case, series: Series) -> Iterator[Result]:
        """Compare each link with the order of the series."""
        if not series.directed:
            yield Doubt("nothing says which end of the series holds the stock")
        branches = branching(series.links)
        jumps = [series.position[step.well] - series.position[step.source] for step in series.links]
        backwards = 2 * jumps.count(-1) > len(jumps)
        for step, jump in zip(series.links, jumps, strict=True):
            if jump == 1:
                continue
            if step.source in branches or (branches and jump < 0 and not backwards):
                yield Doubt("a well is diluted by several factors, which no line of wells shows")
                continue
            if jump < 0 and not series.directed:
                continue
            what = (
                "towards the more concentrated end"
                if jump < 0
                else f"skipping {jump - 1} well{'s' if jump > 2 else ''} of the series"
            )
            yield Violation(
                f"The dilution runs {what}: from {place(step.source)} {at(step.drawn)} into "
                f"{place(step.well)} {at(step.visit.line)}.",
                (
                    Site(step.drawn, step.source.ref, "drew from here"),
                    Site(step.visit.line, step.well.ref, f"diluted {what}"),
                ),
                step.well,
                (step.visit.line, jump < 0),
            )
