"""What each well is for in the eyes of one assay family, with the evidence."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from ...vocabulary import WellRef
from ..evidence import Clue, Strength
from ..rules import Family


@dataclass
class Assignment:
    """One well's role in one family.

    Attributes:
        role: Name of the role.
        evidence: What speaks for it, in words, first what decided.
        strength: Of the strongest evidence that says so much.
        text: The words that named it.
        level: Concentration or dose, if known, on a scale within the family.
        conflict: What contradicts it, in words; empty if nothing.
        whole: Whether nothing but the name or the label of a whole labware says so.
        named: The role that the strongest evidence names, which weaker may say more exactly.
    """

    role: str
    evidence: list[str]
    strength: Strength
    text: str
    level: float | None = None
    conflict: str = ""
    whole: bool = False
    named: str = ""

    def copied(self, why: str) -> Assignment:
        """The same for a well that shares this one's part, which the evidence then says."""
        evidence = [f"{said} ({why})" for said in self.evidence]
        return replace(self, evidence=evidence, conflict="")


@dataclass
class Roles:
    """All role assignments of one family in one protocol.

    Attributes:
        family: The family.
        by_well: The role of each well that has one.
        conflicts: Evidence that conflicts, in words, with the wells that it concerns.
        derived: Roles that follow from what a well gives and receives.
        told_levels: Levels that are said of a well apart from what it holds.
        derived_levels: Levels that follow from the wells that a source goes into.
        of_liquid: Roles that the name of a well's loaded liquid would mean in a source, too.
        unnamed: Wells with a loaded liquid whose name is none of the family's words.
        untold: Clues that name no role which fits their wells.
        denied: For a role, the wells whose names or liquids speak against it.
        replicates: For the key of a labware, those of its replicates.
        apart: Unnamed wells that each serve one well of their own, and so hold different things.
    """

    family: Family
    by_well: dict[WellRef, Assignment] = field(default_factory=dict)
    conflicts: dict[str, list[WellRef]] = field(default_factory=dict)
    derived: dict[WellRef, set[str]] = field(default_factory=dict)
    told_levels: dict[WellRef, float] = field(default_factory=dict)
    derived_levels: dict[WellRef, float] = field(default_factory=dict)
    of_liquid: dict[WellRef, set[str]] = field(default_factory=dict)
    unnamed: set[WellRef] = field(default_factory=set)
    apart: set[WellRef] = field(default_factory=set)
    untold: list[Clue] = field(default_factory=list)
    denied: dict[str, set[WellRef]] = field(default_factory=dict)
    replicates: dict[str, set[str]] = field(default_factory=dict)
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

    def by_comment_only(self, ref: WellRef) -> bool:
        """Whether nothing but comments and docstrings says what a well is for."""
        assigned = self.by_well.get(ref)
        if assigned is None or assigned.role in self.derived.get(ref, ()):
            return False
        return assigned.strength <= Strength.COMMENT

    def by_plate_only(self, ref: WellRef) -> bool:
        """Whether neither its own name nor what it receives says what a well is for."""
        assigned = self.by_well.get(ref)
        return assigned is not None and assigned.whole and not self.derived.get(ref)

    def is_named(self, ref: WellRef) -> bool:
        """Whether something says of a well itself what it is for, not of its plate alone."""
        assigned = self.by_well.get(ref)
        return assigned is not None and not assigned.whole

    def has_its_own(self, ref: WellRef) -> bool:
        """Whether what a well gets in another liquid's place is known to stand somewhere: the water
        of a no-template control.
        """
        assigned = self.by_well.get(ref)
        return assigned is not None and any(map(self.known, self.family.roles[assigned.role].gets))

    def is_set_apart(self, ref: WellRef) -> bool:
        """Whether a well is named for something that does not follow from what it receives."""
        assigned = self.by_well.get(ref)
        if assigned is None:
            return False
        spec = self.family.roles[assigned.role]
        return bool(spec.parents) and not spec.receives

    def level(self, ref: WellRef) -> float | None:
        """Concentration or dose of a well, if known."""
        assigned = self.by_well.get(ref)
        if assigned is not None and assigned.level is not None:
            return assigned.level
        own = None if assigned is None else self.family.roles[assigned.role].level
        return self.told_levels.get(ref, self.derived_levels.get(ref, own))

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

    def named_otherwise(self) -> frozenset[WellRef]:
        """Wells without a role that have a name of their own, or a liquid's: "catalase"."""
        outright = (Strength.NAME, Strength.LIQUID)
        clues = (clue for clue in self.untold if clue.strength in outright and not clue.whole)
        return frozenset(ref for clue in clues for ref in clue.wells if not self.of(ref))

    def title(self, ref: WellRef) -> str:
        """What a well is, for a message: "no-template control"."""
        assigned, derived = self.by_well.get(ref), sorted(self.derived.get(ref, ()))
        if assigned is None:
            return self.family.roles[derived[0]].title if derived else "well"
        finer = [role for role in derived if assigned.role in self.closure(role) - {role}]
        return self.family.roles[finer[0] if finer else assigned.role].title
