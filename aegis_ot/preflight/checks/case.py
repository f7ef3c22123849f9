"""One protocol, read with one family's eyes: all that a check may ask."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice

from ...vocabulary import WellRef
from ..roles import Roles
from ..rules import Common, Family
from ..trace import Met, Tip, Trace, Usage, Visit, Well
from .same_liquid import SameLiquid
from .series import Series, find_series

RoleSet = frozenset[str]

FirstOrLast = Mapping[Well, Mapping[Well, int]]
"""For each well other wells, each with an index of the run."""


@dataclass
class Case:
    """What a check is given, and what is worked out from it once for all checks.

    Attributes:
        trace: What happened.
        roles: What the wells are for.
        usage: How each well is used.
        common: Words of no family.
        confident: Whether the family is more than a guess.
        waste: Wells that are called waste.
        unsure: Wells that may have held liquid before the run, as the labware's name goes.
        left_over: Whether the family is judged only because no other one fits.
    """

    trace: Trace
    roles: Roles
    usage: Mapping[WellRef, Usage]
    common: Common
    confident: bool = True
    waste: frozenset[WellRef] = frozenset()
    unsure: frozenset[WellRef] = frozenset()
    left_over: bool = False

    @cached_property
    def by_tip(self) -> Mapping[Tip, Sequence[Visit]]:
        """What each tip did, in order."""
        found: dict[Tip, list[Visit]] = {}
        for visit in self.trace.visits:
            found.setdefault(visit.tip, []).append(visit)
        return found

    @property
    def family(self) -> Family:
        """The family whose rules are judged."""
        return self.roles.family

    def of(self, well: Well) -> RoleSet:
        """All roles of a well."""
        found = self._of.get(well)
        if found is None:
            found = self._of[well] = self.roles.of(well.ref)
        return found

    @cached_property
    def _of(self) -> dict[Well, RoleSet]:
        return {}

    def has(self, well: Well, wanted: RoleSet) -> bool:
        """Whether a well has any of these roles."""
        return not wanted.isdisjoint(self.of(well))

    def wells(self, wanted: RoleSet) -> list[Well]:
        """The wells with any of these roles, in order of first use."""
        return [well for well in self.trace.wells.values() if self.has(well, wanted)]

    def title(self, well: Well) -> str:
        """What a well is, in words, for the middle of a sentence."""
        return self.roles.title(well.ref)

    def level(self, well: Well) -> float | None:
        """Concentration or dose of a well, if known."""
        return self.roles.level(well.ref)

    @cached_property
    def meant(self) -> FirstOrLast:
        """For each well the liquids that measured volumes brought to it, with first index."""
        found: dict[Well, dict[Well, int]] = {}
        for visit, _, liquid in _transfers(self.trace):
            into = found.setdefault(visit.well, {})
            for origin in liquid:
                into.setdefault(origin, visit.index)
        return found

    @cached_property
    def destinations(self) -> FirstOrLast:
        """For each well the wells that it was drawn for, with the last index."""
        found: dict[Well, dict[Well, int]] = {}
        for visit, source, _ in _transfers(self.trace):
            found.setdefault(source, {})[visit.well] = visit.index
        return found

    @cached_property
    def _straight(self) -> Mapping[tuple[Well, Well], Sequence[Visit]]:
        found: dict[tuple[Well, Well], list[Visit]] = {}
        for visit, source, _ in _transfers(self.trace):
            found.setdefault((source, visit.well), []).append(visit)
        return found

    def straight(self, source: Well, well: Well) -> Sequence[Visit]:
        """The visits that brought liquid straight from one well into another, in order."""
        return self._straight.get((source, well), ())

    def sources_of(self, well: Well) -> set[Well]:
        """All wells, itself apart, that liquid was drawn from for this one."""
        return {
            part[0]
            for visit in self.trace.deliveries(well)
            for part in visit.parts
            if part[0] is not None and part[0] is not well
        }

    @cached_property
    def series(self) -> Sequence[Series]:
        """The dilution series of the protocol."""
        return find_series(self.trace, self.roles, self.waste)

    @cached_property
    def fillers(self) -> frozenset[Well]:
        """Wells that fill a whole series, whatever they are called."""
        return frozenset(well for series in self.series for well in series.fillers)

    @cached_property
    def same_liquid(self) -> SameLiquid:
        """Tells whether two wells hold the same liquid, as far as roles, names and use say."""
        return SameLiquid(self.trace, self.roles, self.common, self.destinations)


def _transfers(trace: Trace) -> Iterator[tuple[Visit, Well, Mapping[Well, float]]]:
    """Each delivery with the well that it was drawn from, and what that liquid is."""
    for visit in trace.visits:
        for source, volume, liquid, _ in visit.parts:
            if source is not None and source is not visit.well and volume > 0:
                yield visit, source, liquid


def carried_liquids(visit: Visit, after: int = 0) -> Iterator[tuple[Well, Met]]:
    """The liquids that the tip had met before this visit, with the first contact.

    Args:
        visit: The visit.
        after: How many to pass over: the tip had met those before an earlier visit.
    """
    return islice(visit.tip.origins.items(), after, visit.carried)


def delivered(visit: Visit) -> Iterator[tuple[Well, float, Well, int | None]]:
    """``(origin, µL, well drawn from, line of the draw)`` of liquid brought from elsewhere."""
    for source, volume, liquid, line in visit.parts:
        if source is None or source is visit.well:
            continue
        for origin, share in liquid.items():
            yield origin, volume * share, source, line
