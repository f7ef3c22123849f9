"""All families in force, and how to find one of them or one of their rules."""

from __future__ import annotations

from dataclasses import dataclass

from ...errors import RuleError
from .common import Common
from .specs import Family, RuleSpec


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
