"""Holds the families in force against each other."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ...errors import RuleError
from ..rules import Family
from .circles import circle_in


def check_together(families: Sequence[Family]) -> None:
    """Refuse families that define one thing twice, or name a rule that none of them has.

    Raises:
        RuleError: With file, rule and field; of two that clash, with both files.
    """
    _refuse_doubles(families)
    _refuse_second_default(families)
    _check_replaced(families)


def _check_replaced(families: Sequence[Family]) -> None:
    """Of rules that give way to each other in a circle none would report anything."""
    files = {rule.id: Path(family.path).name for family in families for rule in family.rules}
    rules = {rule.id: rule for family in families for rule in family.rules}
    for name, rule in rules.items():
        for other in rule.unless_reported:
            if other not in rules:
                raise RuleError(
                    f"{files[name]}: rule {name}: unless_reported: there is no rule {other!r}; "
                    f"known are {', '.join(sorted(rules))}"
                )
    circle = circle_in({name: rule.unless_reported for name, rule in rules.items()})
    if circle:
        raise RuleError(
            f"{files[circle[0]]}: rule {circle[0]}: unless_reported: they go in a circle: "
            f"{' -> '.join(circle)}"
        )


def _refuse_doubles(families: Sequence[Family]) -> None:
    """Names that differ in capitals alone are one: options and waivers do not tell them apart."""
    seen: dict[tuple[str, str], tuple[str, str]] = {}
    for family in families:
        for kind, name in [
            ("family", family.family),
            *(("rule", rule.id) for rule in family.rules),
        ]:
            key = (kind, name.casefold())
            if key in seen:
                first, path = seen[key]
                spelled = "" if first == name else f" as {first}"
                raise RuleError(
                    f"{family.path}: {kind} {name} is already defined in {path}{spelled}"
                )
            seen[key] = (name, family.path)


def _refuse_second_default(families: Sequence[Family]) -> None:
    """What nothing speaks for is judged by one family."""
    defaults = [family for family in families if family.default]
    if len(defaults) > 1:
        first, second = defaults[:2]
        raise RuleError(
            f"{second.path}: default: the family {first.family} in {first.path} is the default "
            f"already, and {second.family} cannot be a second one"
        )
