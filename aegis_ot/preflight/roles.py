"""Decides what each well is for, within one assay family, and keeps the evidence.

Stronger evidence beats weaker; among names, those of fewer wells beat those of many, and a
labware's name speaks only for wells that nothing else speaks for. What is not said stays
unsaid: a well without evidence has no role, and rules that need one are undecided.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from ..vocabulary import WellRef
from .clues import Clue, Strength
from .levels import level_of
from .rulefiles import Common, Family, RoleSpec
from .trace import Trace
from .words import Lexicon, Match, tokens


@dataclass
class Assignment:
    """One well's role in one family.

    Attributes:
        role: Name of the role.
        evidence: What speaks for it, strongest first, in words.
        strength: Of the strongest evidence.
        text: The words that named it.
        level: Concentration or dose, if known, on a scale within the family.
        conflict: What contradicts it, in words; empty if nothing.
    """

    role: str
    evidence: list[str]
    strength: Strength
    text: str
    level: float | None = None
    conflict: str = ""


@dataclass
class Usage:
    """How the run uses a well: which came first, and whether it feeds others."""

    first_drawn: bool = False
    received: bool = False
    feeds: bool = False
    prefilled: bool = False


@dataclass
class Roles:
    """All role assignments of one family in one protocol.

    Attributes:
        family: The family.
        by_well: The role of each well that has one.
        conflicts: Wells whose evidence conflicts, in words.
    """

    family: Family
    by_well: dict[WellRef, Assignment] = field(default_factory=dict)
    conflicts: list[str] = field(default_factory=list)
    derived: dict[WellRef, set[str]] = field(default_factory=dict)
    _closure: dict[str, frozenset[str]] = field(default_factory=dict)

    def of(self, ref: WellRef) -> frozenset[str]:
        """All roles that a well counts as, general ones included."""
        assigned = self.by_well.get(ref)
        roles = self.closure(assigned.role) if assigned else frozenset()
        extra = self.derived.get(ref)
        return roles | extra if extra else roles

    def has(self, ref: WellRef, wanted: frozenset[str]) -> bool:
        """Whether a well has any of these roles."""
        return not wanted.isdisjoint(self.of(ref))

    def level(self, ref: WellRef) -> float | None:
        """Concentration or dose of a well, if known."""
        assigned = self.by_well.get(ref)
        if assigned is None:
            return None
        if assigned.level is not None:
            return assigned.level
        return self.family.roles[assigned.role].level

    def closure(self, role: str) -> frozenset[str]:
        """A role and all roles above it."""
        known = self._closure.get(role)
        if known is None:
            found = {role}
            for parent in self.family.roles[role].parents:
                found |= self.closure(parent)
            known = self._closure[role] = frozenset(found)
        return known

    def known(self, role: str) -> bool:
        """Whether any well has this role."""
        if any(role in self.closure(a.role) for a in self.by_well.values()):
            return True
        return any(role in extra for extra in self.derived.values())

    def title(self, ref: WellRef) -> str:
        """What a well is, for a message: "no-template control"."""
        assigned = self.by_well.get(ref)
        if assigned is not None:
            return self.family.roles[assigned.role].title
        for role in sorted(self.derived.get(ref, ())):
            return self.family.roles[role].title
        return "well"


def usage_of(trace: Trace) -> dict[WellRef, Usage]:
    """How each well is used, generations of a plate taken together."""
    usages: dict[WellRef, Usage] = {}
    for well in trace.wells.values():
        usage = usages.setdefault(well.ref, Usage())
        usage.prefilled = usage.prefilled or well.prefilled
        if well.visits and well.visits[0].kind.value == "aspirate":
            usage.first_drawn = True
    for visit in trace.visits:
        for source, volume, _, _ in visit.parts:
            if source is not None and source is not visit.well and volume > 0:
                usages[source.ref].feeds = True
                usages[visit.well.ref].received = True
    return usages


Candidate = tuple[tuple[float, ...], str, Clue, "float | None"]


def assign_roles(
    family: Family,
    common: Common,
    clues: Sequence[Clue],
    usage: Mapping[WellRef, Usage],
    trace: Trace,
) -> Roles:
    """Give each well the role that the strongest evidence names.

    Args:
        family: Whose roles and words.
        common: Words for levels.
        clues: All evidence.
        usage: How the run uses each well.
        trace: For the columns that multi-channel pipettes reach.
    """
    roles = Roles(family)
    lexicon = _lexicon(family, common)
    candidates: dict[WellRef, list[Candidate]] = {}
    sides = _Sides(usage)
    named_outright: set[str] = set()
    for clue in sorted(clues, key=lambda clue: bool(clue.step)):
        matches = lexicon.find(clue.text)
        named = [clue.role] if clue.role in family.roles else _named(matches, clue, common)
        if not named:
            continue
        for position, ref in enumerate(clue.wells):
            role = _fitting(named, roles, sides(ref), clue)
            if role is None:
                continue
            if not clue.step and clue.strength >= Strength.DESCRIPTION and not clue.whole:
                named_outright.add(role)
            elif clue.step and role in named_outright and family.roles[role].one_liquid:
                # The comment says what the step is for; which well holds that is said
                # elsewhere, and this may be another one by mistake.
                continue
            level = level_of(clue, position, common) if clue.wells else None
            candidates.setdefault(ref, []).append((_worth(clue), role, clue, level))
    for ref, found in candidates.items():
        assignment = _choose(roles, ref, found)
        if assignment is not None:
            roles.by_well[ref] = assignment
    _spread_over_channels(roles, trace)
    return roles


_LEXICONS: dict[int, tuple[Family, Lexicon]] = {}


def _lexicon(family: Family, common: Common) -> Lexicon:
    known = _LEXICONS.get(id(family))
    if known is None or known[0] is not family:
        phrases: dict[str, Sequence[str]] = {}
        for name, spec in family.roles.items():
            phrases[name] = spec.words
            phrases[f"!{name}"] = spec.never
        known = (family, Lexicon(phrases, common.aliases))
        if len(_LEXICONS) > 64:
            _LEXICONS.clear()
        _LEXICONS[id(family)] = known
    return known[1]


_BOTH = frozenset({"and", "plus", "all", "und", "et", "y"})


def _named(matches: Sequence[Match], clue: Clue, common: Common) -> list[str]:
    """The roles that a text names, the head of the phrase first.

    English puts the head last: ``sample_buffer`` is a buffer; but what follows "in" or "for"
    only says more about it.
    """
    places: dict[int, list[str]] = {}
    for match in matches:
        places.setdefault(match.start, []).append(match.topic)
    words = tokens(clue.text)
    joints = [at for at, word in enumerate(words) if word in common.joints]
    if joints and any(at < joints[0] for at in places):
        # "drug in medium" is a drug.
        places = {at: topics for at, topics in places.items() if at < joints[0]}
    ordered = [places[at] for at in sorted(places, reverse=True)]
    return [topic for group in ordered for topic in group if not topic.startswith("!")]


def _ambiguous(fitting: Sequence[str], roles: Roles, clue: Clue) -> bool:
    """A text that joins several different things speaks of none of them in particular.

    In a name the last word is the head, unless the name joins several with "and".
    """
    if clue.subject and not _BOTH & set(tokens(clue.text)):
        return False
    return any(
        one not in roles.closure(other) and other not in roles.closure(one)
        for one in fitting
        for other in fitting
    )


class _Sides:
    """On which side of the run's transfers a well stands.

    A well that the run never uses stands where the others of its labware stand.
    """

    def __init__(self, usage: Mapping[WellRef, Usage]) -> None:
        self._usage = usage
        self._labware: dict[str, set[str]] = {}
        for ref, used in usage.items():
            side = _side(used)
            if side:
                self._labware.setdefault(ref.labware, set()).add(side)

    def __call__(self, ref: WellRef) -> tuple[str, bool]:
        """``source``, ``destination`` or ``""``, and whether it passes liquid on as well."""
        used = self._usage.get(ref)
        side = _side(used) if used else ""
        if not side:
            others = self._labware.get(ref.labware, set())
            if len(others) == 1:
                side = next(iter(others))
            elif used and used.prefilled:
                side = "source"
        return side, bool(used and used.feeds and used.received)


def _side(used: Usage) -> str:
    if used.first_drawn:
        return "source"
    return "destination" if used.received else ""


def _fitting(named: Iterable[str], roles: Roles, sides: tuple[str, bool], clue: Clue) -> str | None:
    """The first named role whose side agrees with how the run uses the well."""
    named = list(dict.fromkeys(named))
    if clue.strength is Strength.GIVEN:
        return named[0]
    specs = roles.family.roles
    side, passes_on = sides
    if clue.step == "destination" and len(named) > 1:
        return None
    if clue.step and clue.step != side:
        return None
    fitting = [role for role in named if specs[role].side in ("any", side)]
    if not fitting and passes_on and not clue.whole and clue.strength is not Strength.COMMENT:
        fitting = [role for role in named if specs[role].side == "source"]
    if not fitting or _ambiguous(fitting, roles, clue):
        return None
    return fitting[0]


def _worth(clue: Clue) -> tuple[float, ...]:
    return (float(clue.strength), 0.0 if clue.whole else 1.0, -float(len(set(clue.wells))))


def _choose(roles: Roles, ref: WellRef, found: list[Candidate]) -> Assignment | None:
    found.sort(key=lambda candidate: candidate[0], reverse=True)
    worth, role, clue, _ = found[0]
    for _, other, hint, _ in found[1:]:
        # Weaker evidence may say more exactly what the stronger leaves open: the liquid says
        # "cells", the name says "vehicle_controls".
        exact = not hint.whole and hint.strength is not Strength.LOOSE_NAME
        said = exact or hint.strength == clue.strength
        if said and role != other and role in roles.closure(other):
            role = other
    rivals = [
        candidate
        for candidate in found[1:]
        if candidate[0] == worth
        and candidate[1] != role
        and candidate[1] not in roles.closure(role)
        and role not in roles.closure(candidate[1])
    ]
    conflict = ""
    if rivals:
        conflict = f"{clue.said} against {rivals[0][2].said}"
        roles.conflicts.append(f"{ref}: {conflict}")
        if clue.strength <= Strength.LOOSE_NAME:
            return None
    agreeing = [c for c in found if role in roles.closure(c[1]) or c[1] in roles.closure(role)]
    level = next((c[3] for c in agreeing if c[3] is not None), None)
    return Assignment(
        role,
        list(dict.fromkeys(c[2].said for c in agreeing)),
        clue.strength,
        clue.text,
        level,
        conflict,
    )


def _spread_over_channels(roles: Roles, trace: Trace) -> None:
    """A name for the well that a multi-channel pipette is aimed at names its whole column.

    Only where the named well is never used alone, and the others have no better evidence.
    """
    for first, group in trace.groups.items():
        assigned = roles.by_well.get(first)
        if assigned is None or first in trace.singles:
            continue
        for ref in group:
            if ref == first or ref in trace.singles:
                continue
            other = roles.by_well.get(ref)
            if other is not None and other.role == assigned.role:
                if other.level is None:
                    other.level = assigned.level
            elif other is None or (
                other.strength <= assigned.strength
                and assigned.role != other.role
                and assigned.role not in roles.closure(other.role)
                and _is_wide(other)
                and not _is_wide(assigned)
            ):
                roles.by_well[ref] = Assignment(
                    assigned.role,
                    [f"{said} (same channel group)" for said in assigned.evidence],
                    assigned.strength,
                    assigned.text,
                    assigned.level,
                )


def _is_wide(assignment: Assignment) -> bool:
    return all("label" in said for said in assignment.evidence)


def derive(roles: Roles, trace: Trace, usage: Mapping[WellRef, Usage]) -> None:
    """Roles that follow from what a well receives: a reaction is what template goes into.

    Wells that only pass liquid on (a dilution plate) are left out.
    """
    for name, spec in roles.family.roles.items():
        if spec.feeds:
            _derive_source(roles, name, spec, trace)
        if spec.one_to_one:
            _derive_one_to_one(roles, name, trace)
    for name, spec in roles.family.roles.items():
        if spec.receives:
            _derive_one(roles, name, spec, trace, usage)


def settle_diluent(roles: Roles, trace: Trace) -> None:
    """Where nothing is called the diluent, find it among the buffers.

    It is the one that most wells are filled from, together with others that fill at least
    three in ten (two series may have a diluent each). A buffer that fills one well of many is
    rather a mistake than a second diluent.
    """
    spec = roles.family.series
    if spec is None or not spec.diluent or any(roles.known(role) for role in spec.diluent):
        return
    otherwise = frozenset(spec.diluent_else)
    filled: dict[str, set[WellRef]] = {}
    sources: dict[str, set[WellRef]] = {}
    for well in trace.wells.values():
        for visit in trace.deliveries(well):
            for source, _, _, _ in visit.parts:
                if source is not None and roles.has(source.ref, otherwise):
                    text = roles.by_well[source.ref].text
                    filled.setdefault(text, set()).add(well.ref)
                    sources.setdefault(text, set()).add(source.ref)
    if not filled:  # named, and never used: then something else is used in its place
        for ref, assigned in roles.by_well.items():
            if assigned.role in otherwise:
                sources.setdefault(assigned.text, set()).add(ref)
        filled = {text: set() for text in sources} if len(sources) == 1 else {}
    total = len(set().union(*filled.values())) if filled else 0
    for text, wells in filled.items():
        if len(wells) >= 0.3 * total:
            for ref in sources[text]:
                roles.by_well[ref].role = spec.diluent[0]


def _derive_source(roles: Roles, name: str, spec: RoleSpec, trace: Trace) -> None:
    """A source without a name that goes into named wells of ``spec.feeds``, mostly."""
    wanted = frozenset(spec.feeds)
    fed: dict[WellRef, set[WellRef]] = {}
    for well in trace.wells.values():
        for visit in trace.deliveries(well):
            for source, _, _, _ in visit.parts:
                if source is not None and source.prefilled:
                    fed.setdefault(source.ref, set()).add(well.ref)
    for ref, wells in fed.items():
        if roles.of(ref):
            continue
        right = sum(roles.has(well, wanted) for well in wells)
        if right * 2 > len(wells):
            roles.derived.setdefault(ref, set()).update(roles.closure(name))


_FEWEST_PAIRS = 3
_SMALLEST_PLATE = 24


def _derive_one_to_one(roles: Roles, name: str, trace: Trace) -> None:
    """Wells of a plate that each serve one well of their own hold each something of its own.

    A liquid that stands in several wells (a strip of master mix) serves several wells each.
    """
    served: dict[WellRef, set[WellRef]] = {}
    for well in trace.wells.values():
        for visit in trace.deliveries(well):
            for source, _, _, _ in visit.parts:
                if source is not None and source is not well and source.prefilled:
                    served.setdefault(source.ref, set()).add(well.ref)
    plates: dict[str, list[WellRef]] = {}
    for ref in served:
        info = trace.labware.get(ref.labware)
        if info is None or info.centers_channels or len(info.wells) < _SMALLEST_PLATE:
            continue
        plates.setdefault(ref.labware, []).append(ref)
    for refs in plates.values():
        pairs = all(len(served[ref]) == 1 and not roles.of(ref) for ref in refs)
        into = {well for ref in refs for well in served[ref]}
        if pairs and len(refs) >= _FEWEST_PAIRS and len(into) == len(refs):
            for ref in refs:
                roles.derived.setdefault(ref, set()).update(roles.closure(name))


def _derive_one(
    roles: Roles, name: str, spec: RoleSpec, trace: Trace, usage: Mapping[WellRef, Usage]
) -> None:
    wanted = frozenset(spec.receives)
    is_wanted: Callable[[WellRef], bool] = lambda ref: roles.has(ref, wanted)  # noqa: E731
    for well in trace.wells.values():
        used = usage.get(well.ref)
        if used is None or used.feeds or not used.received or used.first_drawn:
            continue
        assigned = roles.by_well.get(well.ref)
        if assigned is not None and assigned.role not in roles.closure(name):
            continue
        for visit in trace.deliveries(well):
            if any(is_wanted(o.ref) for part in visit.parts for o in part[2]):
                roles.derived.setdefault(well.ref, set()).update(roles.closure(name))
                break


def implied_contents(roles: Roles, trace: Trace) -> set[WellRef]:
    """Wells whose role says that they held liquid before the run.

    Not those that are given in the run what such a well is made of, or something unknown.
    """
    found = {
        ref: frozenset(roles.family.roles[assigned.role].filled_by)
        for ref, assigned in roles.by_well.items()
        if roles.family.roles[assigned.role].implies_contents
    }
    if not found:
        return set()
    for well in trace.wells.values():
        if well.ref not in found:
            continue
        for visit in trace.deliveries(well):
            for source, _, _, _ in visit.parts:
                if source is None or source is well or well.ref not in found:
                    continue
                theirs = roles.of(source.ref)
                if not theirs or not found[well.ref].isdisjoint(theirs):
                    del found[well.ref]
    return set(found)
