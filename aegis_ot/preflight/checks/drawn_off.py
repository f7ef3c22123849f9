"""Checks on what is drawn off: it is gone before the next liquid comes, and it stays gone."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ...adapters.opentrons.instrumentation import EventKind, OperationKind
from ..rules import role_names
from ..trace import EMPTY_UL, Visit, Well
from .check import Check, Doubt, Result, Violation, microlitres, site_of
from .rule_context import RuleContext, at

_GONE = 0.5
"""A liquid counts as drawn off where at least this share of it was."""


@dataclass(frozen=True)
class DrawnOffBefore(Check):
    """What a well was given of ``first`` is drawn off before it is given any of ``then``.

    Judged in wells that are given ``first`` before ``then``. Where the run pauses in between, a
    person or a plate washer may empty them; a source that goes by several names may be exchanged
    by hand.

    Attributes:
        first: Roles of the liquid that has to go.
        then: Roles of the liquid that must not meet it.
    """

    first: tuple[str, ...] = role_names(required=True)
    then: tuple[str, ...] = role_names(required=True)

    def find(self, case: RuleContext) -> Iterator[Result]:
        for wanted in (self.first, self.then):
            for source in case.wells(wanted):
                if source in case.destinations and _changes(case, source):
                    why = f"{source.ref} goes by several names; it may be exchanged by hand"
                    yield Doubt(why, roles_of=(source,))
                    return
        pauses = [i for i, one in enumerate(case.trace.log) if one.kind is EventKind.PAUSED]
        for well in case.trace.wells.values():
            if well.runs_through or case.is_waste(well):
                continue
            if (found := self._left(case, well)) is None:
                continue
            given, volume, then = found
            first, title = case.titles(self.first), case.titles(self.then)
            if any(given.index <= pause <= then.index for pause in pauses):
                yield Doubt(f"the run pauses before the {title} comes; the {first} may go then")
                return
            yield Violation(
                f"{well.ref} still holds {microlitres(volume)} of {first}, given {at(given.line)}, "
                f"when {title} is added {at(then.line)}.",
                (
                    site_of(given, f"received {first}, never drawn off"),
                    site_of(then, f"received {title} on top of it"),
                ),
                (given.line, then.line),
            )

    def _left(self, case: RuleContext, well: Well) -> tuple[Visit, float, Visit] | None:
        """The visit that gave ``first`` last, µL of it that are still there, and the visit that
        then brings ``then``; ``None`` where it was drawn off.
        """
        given, left, drawn = None, 0.0, 0.0
        for visit in (visit for visit in well.visits if not visit.mixing):
            if visit.kind is OperationKind.ASPIRATE:
                drawn += visit.volume
                continue
            sources = [one.source for one in visit.brought]
            if given and any(case.has(source, self.then) for source in sources):
                if drawn < _GONE * left:
                    return given, left, visit
                given, left, drawn = None, 0.0, 0.0
            if any(case.has(source, self.first) for source in sources):
                if drawn >= _GONE * left:
                    left = drawn = 0.0
                volume = sum(one.volume for one in visit.brought)
                if volume > EMPTY_UL:
                    given, left = visit, left + volume
        return None


@dataclass(frozen=True)
class WasteStays(Check):
    """What several wells were emptied into, under the name of waste, goes into no other well."""

    lasting = True

    def find(self, case: RuleContext) -> Iterator[Result]:
        for one in case.trace.transfers:
            waste, into, visit = one.source, one.well, one.visit
            if waste.ref not in case.waste or case.is_waste(into):
                continue
            emptied = {e.source for e in waste.received if e.visit.index < visit.index} - {into}
            if len(emptied) > 1:
                yield Violation(
                    f"What is drawn from {waste.ref} {at(one.drawn)} goes into {into.ref} "
                    f"{case.at(visit)}: {len(emptied)} other wells were emptied into that waste.",
                    (site_of(visit, "given what is waste"),),
                    (one.drawn, waste.ref),
                )


def _changes(case: RuleContext, source: Well) -> bool:
    """Whether a source goes by several names: exchanged by hand, it holds now this, now that."""
    assigned = case.roles.by_well.get(source.ref)
    return assigned is not None and len({one.text for one in assigned.evidence}) > 1
