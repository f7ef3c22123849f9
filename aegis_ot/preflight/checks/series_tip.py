"""The check on the tip that goes along a dilution series."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ...vocabulary import Site
from ..trace import Tip, Transfer, Visit, Well
from .case import Case
from .check import Doubt, Result, Violation, at, place
from .dilution_steps import SeriesCheck, dilutions, is_mixed
from .series import Series

_MIXED = "Each step is mixed before the next, which rinses the tip: common practice, not exact."


@dataclass(frozen=True)
class SeriesTip(SeriesCheck):
    """A tip that has touched a more concentrated well touches no later well of the series.

    The two wells of the first step that it makes are excepted.
    """

    def along(self, case: Case, series: Series) -> Iterator[Result]:
        """Follow each tip along the series."""
        if not series.entered:
            yield Doubt("nothing says which end of the series holds the stock")
        by_tip: dict[int, list[Visit]] = {}
        for well in series.wells:
            for visit in well.visits:
                if visit.contact:
                    by_tip.setdefault(visit.tip.number, []).append(visit)
        steps = dilutions(case, series)
        feeding = {link.source for link in series.links}
        goes_on = [step for step in steps if step.well in feeding]  # the last well is SD-1's
        mixed = all(is_mixed(case, step) for step in goes_on or steps)
        for visits in by_tip.values():
            visits.sort(key=lambda visit: visit.index)
            yield from self._one_tip(series, steps, visits, _MIXED if mixed else "")

    def _one_tip(
        self, series: Series, steps: list[Transfer], visits: list[Visit], warning: str
    ) -> Iterator[Result]:
        tip = visits[0].tip
        first = next((step for step in steps if _is_made_by(step, tip)), None)
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


def _is_made_by(step: Transfer, tip: Tip) -> bool:
    return any(one.source is step.source and one.visit.tip is tip for one in step.well.received)
