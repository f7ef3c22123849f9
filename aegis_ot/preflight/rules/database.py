"""The rule database: all families in force, and the words of no assay in particular."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ...errors import RuleError
from .specs import SCHEMA_VERSION, Family, RuleSpec


@dataclass(frozen=True)
class Common:
    """``common.json``: word lists that belong to no family.

    Attributes:
        pauses: What a pause's message says may have been done, see ``trace.pauses``.
        prefilled: Names of wells that held liquid before the run.
        waste: Names of wells that are waste.
        flow_through: Names of labware that liquid runs through: it holds nothing.
        levels: Words for concentrations, with their value: ``blank`` is 0.
        amounts: Words for concentrations or doses: ``conc``.
        aliases: Abbreviations and what they stand for, word by word.
        joints: What follows one of these only says more: "drug in medium".
        sides: Words that only say on which side of a transfer something stands: ``src``.
        joining: Words that join several things: "and".
        lacking: Words before something that is not there: "without".
        noise: Words that tell no compound from another: "stock", "well".
        distinct: Words for things of which each has a name of its own: "compounds".
        dose_words: Words for amounts of one thing: "dose".
        schema: The version of this format.
    """

    pauses: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    prefilled: tuple[str, ...] = ()
    waste: tuple[str, ...] = ()
    flow_through: tuple[str, ...] = ()
    levels: Mapping[str, float] = field(default_factory=dict)
    amounts: tuple[str, ...] = ()
    aliases: Mapping[str, str] = field(default_factory=dict)
    joints: tuple[str, ...] = ()
    sides: tuple[str, ...] = ()
    joining: tuple[str, ...] = ()
    lacking: tuple[str, ...] = ()
    noise: tuple[str, ...] = ()
    distinct: tuple[str, ...] = ()
    dose_words: tuple[str, ...] = ()
    schema: int = SCHEMA_VERSION


@dataclass(frozen=True)
class Database:
    """All families and common words in force."""

    families: tuple[Family, ...]
    common: Common

    @property
    def assays(self) -> tuple[Family, ...]:
        """The families that a protocol may be of; the others hold rules for every protocol."""
        return tuple(family for family in self.families if family.is_assay)

    @property
    def rules(self) -> tuple[RuleSpec, ...]:
        """Every rule, in file order."""
        return tuple(rule for family in self.families for rule in family.rules)

    def rule(self, rule_id: str) -> tuple[Family, RuleSpec]:
        """Find a rule.

        Raises:
            RuleError: If there is none with this identifier.
        """
        known = {rule.id: (family, rule) for family in self.families for rule in family.rules}
        if rule_id not in known:
            raise RuleError(f"there is no rule {rule_id!r}; known are {', '.join(known)}")
        return known[rule_id]

    def family(self, name: str) -> Family:
        """Find a family.

        Raises:
            RuleError: If there is none of this name.
        """
        known = {family.family: family for family in self.families}
        if name not in known:
            raise RuleError(f"there is no assay family {name!r}; known are {', '.join(known)}")
        return known[name]
