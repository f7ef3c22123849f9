"""What every check is, and what it may ask."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, ClassVar

from ...vocabulary import Site, WellRef
from ..roles import Roles
from ..rules import Common, Family
from ..trace import Contact, Met, Trace, Usage, Visit, Well
from .same_liquid import is_same_liquid
from .series import Series, find_series

RoleSet = frozenset[str]


@dataclass(frozen=True)
class Violation:
    """One place where a rule is broken, before places of one cause are joined.

    Attributes:
        message: One sentence in plain words about this place.
        sites: Both ends; the well that suffers stands last.
        well: The well that suffers.
        cause: Violations of one cause become one finding.
        rests_on: Wells without whose roles nothing would be wrong.
        contact: How surely the tips touched what it rests on.
        warning: Why it is a warning at most, in a sentence; empty for what surely ruins the assay.
        in_any_assay: Whether it holds by what happened and by names alone, whatever the assay is.
    """

    message: str
    sites: tuple[Site, ...]
    well: Well
    cause: tuple[Any, ...]
    rests_on: tuple[Well, ...] = ()
    contact: Contact = Contact.WET
    warning: str = ""
    in_any_assay: bool = False


@dataclass(frozen=True)
class Doubt:
    """A place that a check cannot judge, and why."""

    reason: str


Result = Violation | Doubt


@dataclass
class Case:
    """One protocol, read with one family's eyes.

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
    _meant: dict[Well, dict[Well, int]] | None = None
    _dests: dict[Well, dict[Well, int]] | None = None
    _straight: dict[tuple[Well, Well], list[Visit]] = field(default_factory=dict)
    _same: dict[tuple[Well, Well], bool] = field(default_factory=dict)
    _series: list[Series] | None = None
    _fillers: Set[Well] | None = None
    _of: dict[Well, RoleSet] = field(default_factory=dict)

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

    def has(self, well: Well, wanted: RoleSet) -> bool:
        """Whether a well has any of these roles."""
        return not wanted.isdisjoint(self.of(well))

    def wells(self, wanted: RoleSet) -> list[Well]:
        """The wells with any of these roles, in order of first use."""
        return [well for well in self.trace.wells.values() if self.has(well, wanted)]

    @property
    def meant(self) -> Mapping[Well, Mapping[Well, int]]:
        """For each well the liquids that measured volumes brought to it, with first index."""
        if self._meant is None:
            self._follow()
        assert self._meant is not None
        return self._meant

    @property
    def destinations(self) -> Mapping[Well, Mapping[Well, int]]:
        """For each well the wells that it was drawn for, with the last index."""
        if self._dests is None:
            self._follow()
        assert self._dests is not None
        return self._dests

    def straight(self, source: Well, well: Well) -> Sequence[Visit]:
        """The visits that brought liquid straight from one well into another, in order."""
        if self._dests is None:
            self._follow()
        return self._straight.get((source, well), ())

    def _follow(self) -> None:
        meant: dict[Well, dict[Well, int]] = {}
        dests: dict[Well, dict[Well, int]] = {}
        for visit in self.trace.visits:
            for source, volume, liquid, _ in visit.parts:
                if source is None or source is visit.well or volume <= 0:
                    continue
                into = meant.setdefault(visit.well, {})
                for origin in liquid:
                    into.setdefault(origin, visit.index)
                dests.setdefault(source, {})[visit.well] = visit.index
                self._straight.setdefault((source, visit.well), []).append(visit)
        self._meant, self._dests = meant, dests

    @property
    def series(self) -> list[Series]:
        """The dilution series of the protocol."""
        if self._series is None:
            self._series = find_series(self.trace, self.roles, self.waste)
        return self._series

    @property
    def fillers(self) -> Set[Well]:
        """Wells that fill a whole series, whatever they are called."""
        if self._fillers is None:
            self._fillers = {well for series in self.series for well in series.fillers}
        return self._fillers

    def same_liquid(self, one: Well, other: Well) -> bool:
        """Whether two wells hold the same liquid, as far as roles and names say."""
        known = self._same.get((one, other))
        if known is None:
            known = self._same[one, other] = is_same_liquid(self, one, other)
        return known

    def title(self, well: Well) -> str:
        """What a well is, in words, for the middle of a sentence."""
        return self.roles.title(well.ref)

    def level(self, well: Well) -> float | None:
        """Concentration or dose of a well, if known."""
        return self.roles.level(well.ref)


def place(well: Well) -> str:
    """A well in a message: "A1 of PCR plate (slot 4)"."""
    return str(well.ref)


def at(line: int | None) -> str:
    """ "at line 14", or nothing."""
    return f"at line {line}" if line else "somewhere in the protocol"


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


@dataclass(frozen=True)
class Check:
    """A predicate over trace and roles, with its parameters as fields."""

    name: ClassVar[str] = ""

    def find(self, case: Case) -> Iterable[Result]:
        """Places where it does not hold, and places that it cannot judge."""
        raise NotImplementedError


def role_field(default: tuple[str, ...] | None = None) -> Any:
    """A parameter that lists roles."""
    if default is None:
        return field(metadata={"roles": True})
    return field(default=default, metadata={"roles": True})
