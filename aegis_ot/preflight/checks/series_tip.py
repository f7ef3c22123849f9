"""The check on the tip that goes along a dilution series."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from ...vocabulary import Site
from ..trace import Transfer, Visit, Well
from .case import Case
from .check import Check, Doubt, Result, Violation, at, place
from .dilution_steps import NO_SERIES, is_dilution, is_mixed
from .series import Series

_MIXED = "Each step is mixed before the next, which rinses the tip: common practice, not exact."


@dataclass(frozen=True)
class SeriesTip(Check):
    """A tip that has touched a more concentrated well touches no later well of the series.

    The two wells of the first step that it makes are excepted.
    """

    name: ClassVar[str] = "series_tip"

    def find(self, case: Case) -> Iterator[Result]:
        """Follow each tip along each series."""
        if not case.series:
            yield Doubt(NO_SERIES)
        for series in case.series:
            if not series.entered:
                yield Doubt("nothing says which end of the series holds the stock")
            yield from self._along(case, series)

    def _along(self, case: Case, series: Series) -> Iterator[Result]:
        by_tip: dict[int, list[Visit]] = {}
        for well in series.wells:
            for visit in well.visits:
                if visit.contact:
                    by_tip.setdefault(visit.tip.number, []).append(visit)
        dilutions = [step for step in series.steps if is_dilution(case, step)]
        feeding = {link.source for link in series.links}
        goes_on = [step for step in dilutions if step.well in feeding]  # the last well is SD-1's
        mixed = all(is_mixed(case, step) for step in goes_on or dilutions)
        for visits in by_tip.values():
            visits.sort(key=lambda visit: visit.index)
            yield from self._one_tip(series, dilutions, visits, _MIXED if mixed else "")

    def _one_tip(
        self, series: Series, dilutions: list[Transfer], visits: list[Visit], warning: str
    ) -> Iterator[Result]:
        tip = visits[0].tip
        first = next((step for step in dilutions if _made_by(step, tip.number)), None)
        excepted = {first.source, first.well} if first else set()
        strongest: tuple[int, Visit] | None = None
        reported: set[Well] = set()
        for visit in visits:
            place_here = series.position[visit.well]
            if (
                strongest is not None
                and strongest[0] < place_here
                and visit.well not in excepted
                and visit.well not in reported
            ):
                reported.add(visit.well)
                before = strongest[1]
                yield Violation(
                    f"The tip that touched the more concentrated {place(before.well)} "
                    f"{at(before.line)} entered {place(visit.well)} {at(visit.line)}.",
                    (
                        Site(before.line, before.well.ref, "touched the more concentrated well"),
                        Site(visit.line, visit.well.ref, "entered a later well"),
                    ),
                    visit.well,
                    ("series tip",),
                    contact=min(before.contact, visit.contact),
                    warning=warning,
                )
            entered = series.entered.get(visit.well)
            holds_stock = entered is not None and entered <= visit.index
            if visit.touches and holds_stock and (strongest is None or place_here < strongest[0]):
                strongest = (place_here, visit)


def _made_by(step: Transfer, tip: int) -> bool:
    return any(
        visit.tip.number == tip and any(part[0] is step.source for part in visit.parts)
        for visit in step.well.visits
    )
