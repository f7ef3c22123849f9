"""What a rule file may say: an assay family, its roles, its rules.

A family says which words reveal it, which roles its wells play, and which rules hold. A rule
names checks (:mod:`aegis_ot.preflight.checks`) and their parameters; it holds no code.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ...errors import RuleError
from .common import SCHEMA_VERSION, Common


@dataclass(frozen=True)
class Signal:
    """Words that speak for a family.

    Attributes:
        words: Phrases, see :mod:`aegis_ot.preflight.text.words`.
        weight: How much a mention counts; negative words speak against the family.
        once: Whether the signal counts once, however often it is mentioned.
        defining: Whether it can make the family known. Words that other assays use as well only
            add to what defines it.
        roles: Roles of the family whose words count as well.
    """

    words: tuple[str, ...] = ()
    weight: float = 1.0
    once: bool = True
    defining: bool = True
    roles: tuple[str, ...] = ()


@dataclass(frozen=True)
class ShapeSignal:
    """A shape of the liquid's ways that speaks for a family, or against it.

    Attributes:
        shape: ``chain``, ``pooling``, ``reactions`` or ``copying``.
        weight: How much it counts for three wells; twice as much from six on. A chain counts
            twice where its wells were filled from one place before.
        unless: Shapes beside which it says nothing.
        defining: Whether it can make the family known.
    """

    shape: str
    weight: float
    unless: tuple[str, ...] = ()
    defining: bool = False


@dataclass(frozen=True)
class RoleSignal:
    """Roles that make a family known together, where wells are named for all of them.

    Attributes:
        roles: Roles of the family; ``"a|b"`` for either.
        weight: The score that the family has at least then: what its words have added counts.
    """

    roles: tuple[str, ...]
    weight: float = 4.0


@dataclass(frozen=True)
class RoleSpec:
    """What a well may be for, and which words say so.

    Attributes:
        title: In words, for messages: "no-template control".
        parents: More general roles that it also counts as.
        side: ``source`` if the words mean this role only in wells that liquid is drawn from
            first, ``destination`` if only in wells that liquid is put into first, or ``any``.
        words: Phrases that name it.
        never: Phrases that hold one of the words and still do not name it.
        differing: Those of its words that in the plural, or for a labware, stand for liquids which
            differ, and so do not name it: a rack of "stocks".
        implies_contents: Whether such a well held liquid before the run.
        filled_by: Roles whose liquid, given in the run, would make up those contents.
        feeds: Derived: an unnamed source that mostly feeds wells of these roles.
        feeds_beside: For ``feeds``: only if these wells all get a liquid of these roles as well.
        single_with: Derived: unnamed sources that each go into wells of their own which all get a
            liquid of these roles as well; three at least, or beside named ones of this role.
        single_beside: For ``single_with``: only in labware of which nothing is said, and where
            another one holds one of these roles.
        replicated: Whether plates that are filled alike and called alike have it in the same wells.
        one_liquid: Whether all wells of this role hold the same liquid unless named apart.
        one_to_one: Derived: unnamed wells of a plate or rack that each serve one well of their own.
        loaded: Derived: a well with a loaded liquid whose name says no role: ``shared`` where it
            serves several wells, ``single`` where it serves one or two, ``kept`` where the run
            only adds to it.
        may_be: Roles that such a liquid is used as, if that is said as well: "PBS (vehicle)"; or
            if it goes where they go, and none is named for them.
        level: Value on the scale of concentrations or doses that this role has by itself.
        receives: Derived: a destination that is given liquid of one of these roles.
        receives_with: For ``receives``: where wells get a liquid of these roles as well, straight
            from where it stands, it is they that are meant, and not what they are given on to.
        dosed: Derived: a well on its side of which a concentration is said and no role, beside
            others; a source that goes into wells of one level only, in ``feeds``, has that level.
        called_alike_beside: Derived: a source without a role that is called by the same word as
            the wells it goes into, on a plate with wells of these roles: "APAP" beside controls.
        used_like: Derived: unnamed sources that each go into wells of their own on the labware, and
            in the volume, where a source of one of these roles goes into others.
        gets: Derived, with ``in_place_of``: where no well is named for this role, those that get a
            liquid of these roles in the volume in which more wells get one of those.
        in_place_of: See ``gets``.
        common_to: Derived, where no well is named for this role: unnamed sources of which nearly
            all wells of these roles get one, in the same volume.
        passed_on: Derived: a well into which one of this role goes, unless that tops up many
            wells which have each a liquid of their own besides.
    """

    title: str
    parents: tuple[str, ...] = ()
    side: str = "any"
    words: tuple[str, ...] = ()
    never: tuple[str, ...] = ()
    differing: tuple[str, ...] = ()
    implies_contents: bool = False
    filled_by: tuple[str, ...] = ()
    feeds: tuple[str, ...] = ()
    feeds_beside: tuple[str, ...] = ()
    one_to_one: bool = False
    single_with: tuple[str, ...] = ()
    single_beside: tuple[str, ...] = ()
    replicated: bool = False
    loaded: str = ""
    one_liquid: bool = False
    may_be: tuple[str, ...] = ()
    level: float | None = None
    receives: tuple[str, ...] = ()
    receives_with: tuple[str, ...] = ()
    dosed: bool = False
    called_alike_beside: tuple[str, ...] = ()
    used_like: tuple[str, ...] = ()
    gets: tuple[str, ...] = ()
    in_place_of: tuple[str, ...] = ()
    common_to: tuple[str, ...] = ()
    passed_on: bool = False


@dataclass(frozen=True)
class SeriesSpec:
    """Which roles make a dilution series.

    Attributes:
        wells: Wells of the series.
        stock: What is diluted.
        diluent: What it is diluted with.
        diluent_else: What counts as diluent where nothing is called so: the one of these that
            the wells are mostly filled from.
    """

    wells: tuple[str, ...]
    stock: tuple[str, ...]
    diluent: tuple[str, ...]
    diluent_else: tuple[str, ...] = ()


@dataclass(frozen=True)
class Example:
    """A snippet: the body of ``run`` (or a whole protocol) and what it shows."""

    title: str
    code: tuple[str, ...]


@dataclass(frozen=True)
class Examples:
    """At least one of each."""

    passing: tuple[Example, ...]
    failing: tuple[Example, ...]


@dataclass(frozen=True)
class RuleSpec:
    """One rule.

    Attributes:
        id: ``"PCR-2"``.
        name: ``"fresh-tip-template-to-ntc"``.
        statement: What must hold.
        severity: ``error`` or ``warning``.
        scope: ``family`` or ``all``: whether it is judged in every family's protocols.
        needs: Roles that must be known to judge it; ``"a|b"`` for either.
        checks: Checks that decide it, with their parameters; all of them must hold.
        unless_reported: Rules whose findings on the same wells replace this one's.
        indicators: What to look for in the source, for a model.
        prompt: Instruction for a model.
        rationale: Why it matters.
        reference: Where that is written.
        fix: How to mend a violation.
        examples: Passing and failing snippets.
    """

    id: str
    name: str
    statement: str
    severity: str
    needs: tuple[str, ...]
    checks: tuple[Mapping[str, Any], ...]
    rationale: str
    reference: str
    fix: str
    examples: Examples
    scope: str = "family"
    unless_reported: tuple[str, ...] = ()
    indicators: tuple[str, ...] = ()
    prompt: str = ""


@dataclass(frozen=True)
class Family:
    """One assay family, as its file describes it."""

    family: str
    title: str
    description: str
    signals: tuple[Signal, ...]
    roles: Mapping[str, RoleSpec]
    rules: tuple[RuleSpec, ...]
    schema: int = SCHEMA_VERSION
    series: SeriesSpec | None = None
    shapes: tuple[ShapeSignal, ...] = ()
    known_by: tuple[RoleSignal, ...] = ()
    default: bool = False
    path: str = field(default="", compare=False, metadata={"internal": True})


@dataclass(frozen=True)
class Database:
    """All families and common words in force."""

    families: tuple[Family, ...]
    common: Common

    @property
    def rules(self) -> tuple[RuleSpec, ...]:
        """Every rule, in file order."""
        return tuple(rule for family in self.families for rule in family.rules)

    def rule(self, rule_id: str) -> tuple[Family, RuleSpec]:
        """Find a rule.

        Raises:
            RuleError: If there is none with this identifier.
        """
        for family in self.families:
            for rule in family.rules:
                if rule.id == rule_id:
                    return family, rule
        known = ", ".join(rule.id for rule in self.rules)
        raise RuleError(f"there is no rule {rule_id!r}; known are {known}")

    def family(self, name: str) -> Family:
        """Find a family.

        Raises:
            RuleError: If there is none of this name.
        """
        for family in self.families:
            if family.family == name:
                return family
        known = ", ".join(family.family for family in self.families)
        raise RuleError(f"there is no assay family {name!r}; known are {known}")
