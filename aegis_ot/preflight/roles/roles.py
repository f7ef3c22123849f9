"""What each well is for in the eyes of one assay family, with the evidence."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, field
from functools import cached_property

from ...vocabulary import WellRef
from ..evidence import DOUBTFUL, Evidence, Kind
from ..rules import Family


@dataclass
class Assignment:
    """One well's role in one family.

    Attributes:
        role: Name of the role.
        evidence: What speaks for it, what decided first.
        level: Concentration or dose, if known.
        conflict: What contradicts it, in words; empty if nothing.
    """

    role: str
    evidence: tuple[Evidence, ...]
    level: float | None = None
    conflict: str = ""

    @property
    def kind(self) -> Kind:
        """The kind of the evidence that decided."""
        return self.evidence[0].kind

    @property
    def text(self) -> str:
        """The words that named it."""
        return self.evidence[0].text

    @property
    def whole(self) -> bool:
        """Whether nothing but the name or label of a whole labware says so."""
        return all(one.whole for one in self.evidence)


@dataclass
class Roles:
    """All role assignments of one family in one protocol.

    Attributes:
        family: The family.
        by_well: The role of each well that has one.
        conflicts: Evidence that conflicts, in words, with the wells that it concerns.
        derived: Roles that follow from what a well gives and receives.
        unnamed: Wells with a loaded liquid whose name is none of the family's words.
        unread: Evidence that names no role that fits its wells.
        apart: Unnamed wells that each serve one well of their own, and so hold different things.
        also: All roles that the words for a well name, with the kind of the best such words.
        marked: Wells whose name has a word of control beside that of a liquid.
        tubes: Sources that hold a control's liquid: they tell which wells are the control, and are
            none.
        followed: Wells that are a control because they are given what stands in such a tube.
        supposed: Those of them for which no word of control speaks, but the vehicle's name alone.
        diluent_guessed: Whether use alone tells which of several buffers dilutes.
    """

    family: Family
    by_well: dict[WellRef, Assignment] = field(default_factory=dict)
    conflicts: dict[str, list[WellRef]] = field(default_factory=dict)
    derived: dict[WellRef, set[str]] = field(default_factory=dict)
    unnamed: set[WellRef] = field(default_factory=set)
    unread: list[Evidence] = field(default_factory=list)
    apart: set[WellRef] = field(default_factory=set)
    also: dict[WellRef, dict[str, Kind]] = field(default_factory=dict)
    marked: set[WellRef] = field(default_factory=set)
    tubes: set[WellRef] = field(default_factory=set)
    followed: set[WellRef] = field(default_factory=set)
    supposed: set[WellRef] = field(default_factory=set)
    diluent_guessed: bool = False

    def of(self, ref: WellRef) -> frozenset[str]:
        """All roles that a well counts as, general ones included."""
        assigned = self.by_well.get(ref)
        roles = self.family.closure(assigned.role) if assigned else frozenset()
        extra = self.derived.get(ref)
        return roles | extra if extra else roles

    def has(self, ref: WellRef, wanted: Collection[str]) -> bool:
        """Whether a well has any of these roles."""
        return not self.of(ref).isdisjoint(wanted)

    def derive(self, ref: WellRef, role: str) -> None:
        """Give a well a role that follows from its use, with all above it."""
        self.derived.setdefault(ref, set()).update(self.family.closure(role))

    def is_called(self, ref: WellRef, wanted: Collection[str]) -> bool:
        """Whether something says that a well has one of these roles, and not its use alone."""
        assigned = self.by_well.get(ref)
        return assigned is not None and not self.family.closure(assigned.role).isdisjoint(wanted)

    def is_known(self, ref: WellRef) -> bool:
        """Whether it is known what a well is for: something names it, or the liquid put there."""
        return ref in self.by_well or ref in self.derived

    def is_given(self, ref: WellRef) -> bool:
        """Whether the guard's arguments say what a well is for."""
        return ref in self.by_well and self.by_well[ref].kind is Kind.GIVEN

    def is_doubtful(self, ref: WellRef) -> bool:
        """Whether nothing but written wells or a model's reading says what a well is for."""
        assigned = self.by_well.get(ref)
        if assigned is None or assigned.role in self.derived.get(ref, ()):
            return False
        return assigned.kind in DOUBTFUL

    def is_named_by_labware(self, ref: WellRef) -> bool:
        """Whether neither its own name nor what it receives says what a well is for."""
        assigned = self.by_well.get(ref)
        return assigned is not None and assigned.whole and not self.derived.get(ref)

    def level(self, ref: WellRef) -> float | None:
        """Concentration or dose of a well, if known."""
        assigned = self.by_well.get(ref)
        if assigned is not None and assigned.level is not None:
            return assigned.level
        told = self.levels_beside.get(ref)
        own = None if assigned is None else self.family.roles[assigned.role].level
        return own if told is None else told

    @cached_property
    def levels_beside(self) -> dict[WellRef, float]:
        """Levels that are said of a well apart from what it holds: ``{"A1": 0.5}``."""
        found: dict[WellRef, set[float]] = {}
        for one in self.unread:
            for ref, level in zip(one.wells, one.levels, strict=False):
                if level is not None:
                    found.setdefault(ref, set()).add(level)
        return {ref: levels.pop() for ref, levels in found.items() if len(levels) == 1}

    def is_declared(self, role: str) -> bool:
        """Whether a role does not follow from what a well receives: a control."""
        spec = self.family.roles[role]
        return bool(spec.parents) and not spec.receives and spec.side != "source"

    def is_control(self, role: str) -> bool:
        """Whether a role is a control's, whose liquid tells which wells are one."""
        return bool(self.family.roles[role].follows)

    def known(self, role: str) -> bool:
        """Whether any well surely has this role; the tube of a control's liquid is no control."""
        unsure = self.tubes | self.supposed if self.is_control(role) else frozenset()
        return any(role in self.of(ref) for ref in self.wells if ref not in unsure)

    @property
    def wells(self) -> Iterable[WellRef]:
        """All wells with a role."""
        return dict.fromkeys((*self.by_well, *self.derived))

    def title(self, ref: WellRef) -> str:
        """What a well is, for a message: "no-template control"."""
        assigned, derived = self.by_well.get(ref), sorted(self.derived.get(ref, ()))
        if assigned is None:
            return self.family.roles[derived[0]].title if derived else "well"
        finer = [role for role in derived if assigned.role in self.family.closure(role) - {role}]
        return self.family.roles[finer[0] if finer else assigned.role].title
