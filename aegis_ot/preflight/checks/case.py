"""One protocol, read with one family's eyes: all that a check may ask."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice

from ...instrumentation import OperationKind
from ...vocabulary import WellRef
from ..roles import Roles
from ..rules import Common, Family
from ..source import name_without_level, without_strength
from ..trace import Load, Met, Trace, Transfer, Visit, Well, loads_of
from .series import SeriesFinder

RoleSet = Collection[str]
"""Names of roles."""


@dataclass
class Case:
    """What a check is given, and what is worked out from it once for all checks.

    Attributes:
        trace: What happened.
        roles: What the wells are for.
        common: Words of no family.
        confident: Whether the family is more than a guess.
        waste: Wells that are called waste.
        unsure: Wells that may have held liquid before the run, as the labware's name goes.
        left_over: Whether the family is judged only because no other one fits.
        in_prose: Whether only comments and docstrings tell that it is of this family.
        absent: Roles that no well has, as the guard's arguments say: ``{"ntc": []}``.
        is_claimed: Whether a rule of the assay judges what a tip brings from one well into
            another; ``None`` if it may.
        beside: Whether the protocol is of another family, and this one judges by composition.
    """

    trace: Trace
    roles: Roles
    common: Common
    confident: bool = True
    waste: frozenset[WellRef] = frozenset()
    unsure: frozenset[WellRef] = frozenset()
    left_over: bool = False
    in_prose: bool = False
    absent: frozenset[str] = frozenset()
    is_claimed: Callable[[Well, Well], bool | None] = lambda origin, well: False
    beside: bool = False
    _of: dict[Well, frozenset[str]] = field(default_factory=dict, init=False)
    _same: dict[tuple[Well, Well], bool] = field(default_factory=dict, init=False)

    @property
    def family(self) -> Family:
        """The family whose rules are judged."""
        return self.roles.family

    def of(self, well: Well) -> frozenset[str]:
        """All roles of a well."""
        found = self._of.get(well)
        if found is None:
            found = self._of[well] = self.roles.of(well.ref)
        return found

    def has(self, well: Well, wanted: RoleSet) -> bool:
        """Whether a well has any of these roles."""
        return not self.of(well).isdisjoint(wanted)

    def is_one_liquid(self, well: Well) -> bool:
        """Whether a well holds what all wells of its role hold: water, a mix, a buffer."""
        return any(self.family.roles[role].one_liquid for role in self.of(well))

    def brings(self, transfer: Transfer, wanted: RoleSet) -> bool:
        """Whether a transfer brings liquid that stood in a well of these roles before the run."""
        return any(self.has(origin, wanted) for origin in transfer.liquid)

    def wells(self, wanted: RoleSet) -> list[Well]:
        """The wells with any of these roles, in order of first use."""
        return [well for well in self.trace.wells.values() if self.has(well, wanted)]

    def title(self, well: Well) -> str:
        """What a well is, in words, for the middle of a sentence."""
        return self.roles.title(well.ref)

    def titles(self, roles: Sequence[str], between: str = " or ") -> str:
        """These roles in words."""
        return between.join(self.family.roles[role].title for role in roles)

    def is_drawn_first(self, well: Well) -> bool:
        """Whether the run draws from a well before it puts anything there: a source."""
        return self.trace.usage[well.ref].first_drawn

    @cached_property
    def meant(self) -> Mapping[Well, Mapping[Well, int]]:
        """For each well the liquids that measured volumes brought to it, with first index."""
        found: dict[Well, dict[Well, int]] = {}
        for one in self.trace.transfers:
            into = found.setdefault(one.well, {})
            for origin in one.liquid:
                into.setdefault(origin, one.visit.index)
        return found

    def is_given(self, well: Well, liquid: Well) -> bool:
        """Whether a measured volume of the same liquid is brought to a well in the whole run."""
        meant = self.meant.get(well, {})
        return liquid in meant or any(self.same_liquid(liquid, other) for other in meant)

    @cached_property
    def destinations(self) -> Mapping[Well, Mapping[Well, int]]:
        """For each well the wells that it was drawn for, with the last index."""
        found: dict[Well, dict[Well, int]] = {}
        for one in self.trace.transfers:
            found.setdefault(one.source, {})[one.well] = one.visit.index
        return found

    @cached_property
    def made_of(self) -> Mapping[Well, Sequence[Well]]:
        """For each well the wells that it was drawn for, but for the waste."""
        return {
            well: [one for one in drawn_for if one.ref not in self.waste]
            for well, drawn_for in self.destinations.items()
        }

    def is_said_to_hold(self, well: Well) -> bool:
        """Whether a loaded liquid, or the role that it has, says that a well holds something."""
        roles = self.family.roles
        return bool(well.liquids) or any(roles[one].implies_contents for one in self.of(well))

    def at(self, one: Visit | Met) -> str:
        """Where in the protocol it happened, in words: the line, and of a function that several
        lines call, which one did.
        """
        callers = self.trace.callers.get(one.line or 0, ())
        called = f" (called at line {one.caller})" if one.caller and len(callers) > 1 else ""
        return at(one.line) + called

    @cached_property
    def fillings(self) -> Mapping[Well, Counter[Well]]:
        """For each well, how often it is given each source at most before most of what it holds is
        drawn off: a wash is gone. A blow-out ends what a dispense began.
        """
        return {well: _fillings(well) for well in self.trace.wells.values()}

    @cached_property
    def loads(self) -> Sequence[Load]:
        """What the pipettes take up and give, load by load."""
        return list(loads_of(self.trace))

    def is_waste(self, well: Well) -> bool:
        """Whether what goes into a well is not needed any more."""
        used = self.trace.usage.get(well.ref)
        return well.ref in self.waste or (used is not None and used.drain)

    @cached_property
    def series(self) -> SeriesFinder:
        """The dilution series of the protocol."""
        return SeriesFinder(self)

    def same_liquid(self, one: Well, other: Well) -> bool:
        """Whether two wells hold the same liquid, as far as roles, names, loads and use say."""
        known = self._same.get((one, other))
        if known is None:
            known = self._same[one, other] = self._is_same_liquid(one, other)
        return known

    def _is_same_liquid(self, one: Well, other: Well) -> bool:
        if one is other or one.ref == other.ref or self._is_one_source(one, other):
            return True
        roles = self.roles
        if (
            one.liquids
            and one.liquids == other.liquids
            and any(map(str.isdigit, without_strength(one.liquids[0])))
            and self.roles.level(one.ref) == self.roles.level(other.ref)
        ):
            return True
        if self.are_twins(one, other):
            return True
        if {one.ref, other.ref} <= roles.unnamed and one.liquids == other.liquids:
            return one.ref not in roles.apart
        mine, theirs = roles.by_well.get(one.ref), roles.by_well.get(other.ref)
        if mine is None or theirs is None or mine.role != theirs.role:
            return False
        if not self.family.roles[mine.role].one_liquid:
            return False
        return self.compound(one) == self.compound(other)

    def are_twins(self, one: Well, other: Well) -> bool:
        """Whether two wells that the run fills were loaded under one name with what a role of
        theirs says: nothing tells one template from the other.
        """
        loaded = (role for role, spec in self.family.roles.items() if spec.loaded_with)
        return (
            bool(one.liquids)
            and one.liquids == other.liquids
            and not self.of(one).isdisjoint(self.of(other).intersection(loaded))
        )

    def compound(self, well: Well) -> tuple[str, ...]:
        """What a liquid's name says besides its dose: ``("cisplatin",)``, ``("b",)``."""
        assigned = self.roles.by_well.get(well.ref)
        words = (*self.common.noise, *self.common.levels)
        return name_without_level(assigned.text, words) if assigned else ()

    def _is_one_source(self, one: Well, other: Well) -> bool:
        """Whether one list or loop uses two wells of reservoirs as one liquid.

        One statement draws from both, under one name, each for wells of its own. What is given to
        the same wells one after the other is two liquids, and doses have a well each.
        """
        infos = [self.trace.labware.get(well.ref.labware) for well in (one, other)]
        if any(info is None or not info.centers_channels for info in infos):
            return False
        mine, theirs = (self.roles.by_well.get(well.ref) for well in (one, other))
        if (mine and mine.text) != (theirs and theirs.text):
            return False
        if mine and self.family.roles[mine.role].dosed:
            return False
        if one.liquids != other.liquids or self.roles.level(one.ref) != self.roles.level(other.ref):
            return False
        served, also = (self.destinations.get(well, {}).keys() for well in (one, other))
        # A channel that runs dry may go half and half with the next one into one well.
        return len(served & also) <= 1 and not _drawing_lines(one).isdisjoint(_drawing_lines(other))


def _fillings(well: Well) -> Counter[Well]:
    most: Counter[Well] = Counter()
    times: Counter[Well] = Counter()
    left = given = well.declared or 0.0
    for visit in (visit for visit in well.visits if not visit.mixing):
        if visit.kind is OperationKind.ASPIRATE:
            left -= visit.volume
            if left < given / 2:
                times.clear()
                left = given = max(left, 0.0)
            continue
        left, given = left + visit.volume, given + visit.volume
        if visit.kind is OperationKind.DISPENSE:
            for source in {one.source for one in visit.brought}:
                times[source] += 1
                most[source] = max(most[source], times[source])
    return most


def _drawing_lines(well: Well) -> set[int | None]:
    return {visit.line for visit in well.visits if visit.kind is OperationKind.ASPIRATE}


def at(line: int | None) -> str:
    """ "at line 14", or nothing."""
    return f"at line {line}" if line else "somewhere in the protocol"


def carried_liquids(visit: Visit, after: int = 0) -> Iterator[tuple[Well, Met]]:
    """The liquids that the tip had met before this visit, with the first contact; the first
    ``after`` of them, which it had met before an earlier visit, are passed over.
    """
    return islice(visit.tip.origins.items(), after, visit.carried)
