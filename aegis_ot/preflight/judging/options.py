"""How a protocol is to be judged, and whether that names what exists."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from ...errors import ConfigurationError
from ...settings import Settings
from ...vocabulary import nearest
from ..rule_set import RuleSet
from ..rules import RuleSpec


@dataclass(frozen=True)
class Options:
    """How to judge.

    Attributes:
        assay: Families given by hand; empty to infer.
        roles: Roles given by hand: role to places (``"4:H12"``, ``"PCR plate:A1-A8"``).
        select: Only these rules; empty for all.
        ignore: Not these rules.
        severity: Severity in force for a rule: ``error``, ``warning`` or ``off``.
        strict: Whether warnings are errors.
    """

    assay: Sequence[str] = ()
    roles: Mapping[str, Sequence[str]] = field(default_factory=dict)
    select: Sequence[str] = ()
    ignore: Sequence[str] = ()
    severity: Mapping[str, str] = field(default_factory=dict)
    strict: bool = False

    @classmethod
    def from_settings(cls, settings: Settings) -> Options:
        """The part of the guard's settings that concerns judging."""
        return cls(
            assay=tuple(filter(None, map(str.strip, (settings.assay or "").split(",")))),
            roles=settings.roles,
            select=settings.select,
            ignore=settings.ignore,
            strict=settings.rules == "strict",
        )

    def severity_of(self, rule: RuleSpec) -> str:
        """Severity in force for a rule: ``error``, ``warning``, or ``off`` if it is not judged."""
        if (self.select and rule.id not in self.select) or rule.id in self.ignore:
            return "off"
        return self.severity.get(rule.id, rule.severity)

    def leave_none(self, rule_set: RuleSet) -> bool:
        """Whether no rule is left to judge by."""
        return all(self.severity_of(rule) == "off" for rule in rule_set.rules)


def check_options(options: Options, rule_set: RuleSet) -> None:
    """Refuse options that name what does not exist.

    Raises:
        ConfigurationError: A rule, role or severity is unknown.
        RuleError: A family is unknown.
    """
    for name in options.assay:
        rule_set.family(name)
    rules = {rule.id for rule in rule_set.rules}
    roles = {role for family in rule_set.families for role in family.roles}
    for what, names, known in (
        ("rule", (*options.select, *options.ignore, *options.severity), rules),
        ("role", options.roles, roles),
    ):
        for name in names:
            if name not in known:
                told = f"there is no {what} {name!r}{nearest(name, known)}; "
                raise ConfigurationError(f"{told}known are {', '.join(sorted(known))}")
    for rule_id, severity in options.severity.items():
        if severity not in ("error", "warning", "off"):
            raise ConfigurationError(
                f"severity of {rule_id}: expected error, warning or off, found {severity!r}"
            )
