"""One protocol, read with one family's eyes: all that a check may ask."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import cache, cached_property
from itertools import islice
from typing import Any, TypeVar

from ...adapters.opentrons.instrumentation import OperationKind
from ...vocabulary import WellRef
from ..roles import Roles
from ..rules import Common, Family
from ..source import Lexicon, lexicon_of, name_without_level, without_strength
from ..trace import Load, Met, Trace, Transfer, Visit, Well, loads_of

_Made = TypeVar("_Made")

RoleSet = Collection[str]
"""Names of roles."""


@dataclass
class RuleContext:
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
        steps_left_out: The wells that each step names which the run leaves out, by its line.
        absent: Roles that no well has, as the guard's arguments say: ``{"ntc": []}``.
        is_claimed: Whether a rule of the assay judges what a tip brings from one well into
            another; ``None`` if it may.
        beside: Whether the protocol is of another family, and this one judges by composition.
        of: All roles of a well.
        title: What a well is, in words, for the middle of a sentence.
        same_liquid: Whether two wells hold the same liquid, as far as roles, names, loads and use
            say.
    """

    trace: Trace
    roles: Roles
    common: Common
    confident: bool = True
    waste: frozenset[WellRef] = frozenset()
    unsure: frozenset[WellRef] = frozenset()
    left_over: bool = False
    in_prose: bool = False
    steps_left_out: Callable[[], Mapping[int, Collection[WellRef]]] = dict
    absent: frozenset[str] = frozenset()
    is_claimed: Callable[[Well, Well], bool | None] = lambda origin, well: False
    beside: bool = False
    of: Callable[[Well], frozenset[str]] = field(init=False)
    title: Callable[[Well], str] = field(init=False)
    same_liquid: Callable[[Well, Well], bool] = field(init=False)
    _made: dict[object, Any] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        # Asked most of all, and always of the same wells.
        self.of = cache(lambda well: self.roles.of(well.ref))
        self.title = cache(lambda well: self.roles.title(well.ref))
        self.same_liquid = cache(self._is_same_liquid)

    @property
    def family(self) -> Family:
        """The family whose rules are judged."""
        return self.roles.family

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
            since = one.source.residue.items()  # an eluate is of its sample
            for origin in (*one.liquid, *(w for w, index in since if index < one.visit.index)):
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

    def left_out(self, well: Well | None, liquid: RoleSet = ()) -> str:
        """That a step is commented out, or switched off, which names a well, and one of a liquid
        if one is asked for; empty if there is none.
        """
        for line, refs in self.steps_left_out().items():
            fits = well is None or well.ref in refs
            if fits and (not liquid or any(self.roles.has(ref, liquid) for ref in refs)):
                return f"the step {at(line)} is commented out, or switched off"
        return ""

    def once(self, make: Callable[[RuleContext], _Made]) -> _Made:
        """What ``make`` works out of it: when first asked for, and once for all checks."""
        if make not in self._made:
            self._made[make] = make(self)
        made: _Made = self._made[make]
        return made

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
        if self.are_twins(one, other) or self._are_called_one(one, other):
            return True
        unnamed = roles.unnamed
        if one.liquids == other.liquids and one.ref in unnamed and other.ref in unnamed:
            return one.ref not in roles.apart
        mine, theirs = roles.by_well.get(one.ref), roles.by_well.get(other.ref)
        if mine is None or theirs is None or mine.role != theirs.role:
            return False
        if not self.family.roles[mine.role].one_liquid:
            return False
        return self.compound(one) == self.compound(other)

    def are_twins(self, one: Well, other: Well) -> bool:
        """Whether one name is all that is said of two wells, and may be of one liquid or of two:
        wells that the run fills were loaded with "template", or each well gets an "antibody".
        """
        if not one.liquids or one.liquids != other.liquids:
            return False
        loaded = (role for role, spec in self.family.roles.items() if spec.loaded_with)
        if not (self.of(one) & self.of(other)).isdisjoint(loaded):
            return True
        several = all(len(self.made_of.get(well, ())) > 1 for well in (one, other))
        return not several and self._are_called_one(one, other)

    @cached_property
    def _liquids(self) -> Lexicon:
        roles = self.family.roles.values()
        topics = {
            "differing": [w for role in roles if not role.one_liquid for w in role.words],
            "alike": [word for role in roles for word in role.alike],
        }
        return lexicon_of(topics, self.common.aliases)

    def _are_called_one(self, one: Well, other: Well) -> bool:
        """Whether two wells were loaded under one name that may be a reagent's: "IPTG",
        "antibody"; not "samples", of which each well holds another one.
        """
        if not self.go_by_one_name(one, [other]):
            return False
        found = self._liquids.find(one.liquids[0])
        alike = {match.start for match in found if match.topic == "alike"}
        return all(match.start in alike for match in found)

    def go_by_one_name(self, one: Well, others: Sequence[Well]) -> bool:
        """Whether one liquid was declared for all these wells: "sample", not "samples"."""
        name = one.liquids[0].rstrip() if one.liquids else ""
        return bool(name) and name[-1] != "s" and all(one.liquids == w.liquids for w in others)

    def compound(self, well: Well) -> tuple[str, ...]:
        """What a liquid's name says besides its dose: ``("cisplatin",)``, ``("b",)``."""
        assigned = self.roles.by_well.get(well.ref)
        words = (*self.common.noise, *self.common.levels)
        return name_without_level(assigned.text, words) if assigned else ()

    @cached_property
    def _troughs(self) -> Set[str]:
        return {key for key, info in self.trace.labware.items() if info.centers_channels}

    def _is_one_source(self, one: Well, other: Well) -> bool:
        """Whether one list or loop uses two wells of reservoirs as one liquid.

        One statement draws from both, under one name, each for wells of its own. What is given to
        the same wells one after the other is two liquids, and doses have a well each.
        """
        if one.ref.labware not in self._troughs or other.ref.labware not in self._troughs:
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
