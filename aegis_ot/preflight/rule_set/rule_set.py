"""The rules in force: all families, and the words of no assay in particular."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from ...errors import RuleError
from ..rules import Common, Family, RuleSpec

if TYPE_CHECKING:
    from ..checks import Check
    from ..roles import FamilyWords


@dataclass(frozen=True)
class RuleSet:
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

    @cached_property
    def checks(self) -> Mapping[str, Sequence[Check]]:
        """The checks of each rule, by its identifier."""
        from ..checks import make_check  # who only shows rules needs nothing that judges

        return {rule.id: [make_check(c, rule.id) for c in rule.checks] for rule in self.rules}

    @cached_property
    def words(self) -> Mapping[str, FamilyWords]:
        """The words of each family, by its name."""
        from ..roles import FamilyWords

        return {family.family: FamilyWords(family, self.common) for family in self.families}

    def prepare(self) -> None:
        """Make now, and not at the first verdict, what is made of the rules once."""
        _ = self.checks
        for words in self.words.values():
            words.has_word_of_control("")

    def rule(self, rule_id: str) -> tuple[Family, RuleSpec]:
        """Find a rule.

        Raises:
            RuleError: If there is none with this identifier.
        """
        if rule_id not in self._by_id:
            raise RuleError(f"there is no rule {rule_id!r}; known are {', '.join(self._by_id)}")
        return self._by_id[rule_id]

    @cached_property
    def _by_id(self) -> Mapping[str, tuple[Family, RuleSpec]]:
        return {rule.id: (family, rule) for family in self.families for rule in family.rules}

    def family(self, name: str) -> Family:
        """Find a family.

        Raises:
            RuleError: If there is none of this name.
        """
        known = {family.family: family for family in self.families}
        if name not in known:
            raise RuleError(f"there is no assay family {name!r}; known are {', '.join(known)}")
        return known[name]
