"""Holds families against what exists: their roles, the vocabulary of checks, each other."""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Iterator, Mapping, Sequence
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import Any

from ...errors import RuleError
from ..checks import make_check
from ..rules import Family
from ..source import tokens

_WORDS = ("words", "never", "differing")


def check_family(family: Family, file: str) -> None:
    """Refuse a family that names a role or check that does not exist, or words nobody can find.

    Raises:
        RuleError: With file, rule or role, and field.
    """
    for place, part in _parts(family, file):
        for field in dataclasses.fields(part):
            where = f"{place}: {field.name}"
            if field.metadata.get("roles"):
                _check_roles(family, getattr(part, field.name), where)
            elif field.name in _WORDS:
                for word in getattr(part, field.name):
                    if not tokens(word):
                        raise RuleError(f"{where}: {word!r} holds no letter or number to look for")
    parents = {name: role.parents for name, role in family.roles.items()}
    # What a role counts as is followed to the end.
    _refuse_circle(parents, {name: f"{file}: roles.{name}: parents" for name in parents})


def _parts(family: Family, file: str) -> Iterator[tuple[str, Any]]:
    """Everything in a family that may name roles, with where it stands."""
    for number, signal in enumerate(family.signals):
        yield f"{file}: signals[{number}]", signal
    for name, role in family.roles.items():
        yield f"{file}: roles.{name}", role
    yield f"{file}: series", family.series
    for number, together in enumerate(family.known_by):
        yield f"{file}: known_by[{number}]", together
    for rule in family.rules:
        yield f"{file}: rule {rule.id}", rule
        for number, check in enumerate(rule.checks):
            place = f"{file}: rule {rule.id}: checks[{number}]"
            yield place, make_check(check, place)


def _check_roles(family: Family, names: Sequence[str], where: str) -> None:
    for role in (role for name in names for role in name.split("|")):
        if role not in family.roles:
            known = ", ".join(family.roles)
            raise RuleError(f"{where}: there is no role {role!r} in this family; known are {known}")


def check_together(families: Sequence[Family]) -> None:
    """Refuse families that define one thing twice, or name a rule that none of them has.

    Raises:
        RuleError: With file, rule and field; of two that clash, with both files.
    """
    _refuse_doubles(families)
    defaults = [family for family in families if family.default]
    if len(defaults) > 1:  # what nothing speaks for is judged by one family
        first, second = defaults[:2]
        raise RuleError(
            f"{second.path}: default: the family {first.family} in {first.path} is the default "
            f"already, and {second.family} cannot be a second one"
        )
    _check_replaced(families)


def _refuse_doubles(families: Sequence[Family]) -> None:
    """Names that differ in capitals alone are one: options and waivers do not tell them apart."""
    seen: dict[tuple[str, str], tuple[str, str]] = {}
    for family in families:
        rules = (("rule", rule.id) for rule in family.rules)
        for kind, name in (("family", family.family), *rules):
            key = (kind, name.casefold())
            if key in seen:
                first, path = seen[key]
                spelled = "" if first == name else f" as {first}"
                raise RuleError(
                    f"{family.path}: {kind} {name} is already defined in {path}{spelled}"
                )
            seen[key] = (name, family.path)


def _check_replaced(families: Sequence[Family]) -> None:
    """Of rules that give way to each other in a circle none would report anything."""
    rules = [(rule, Path(family.path).name) for family in families for rule in family.rules]
    where = {rule.id: f"{file}: rule {rule.id}: unless_reported" for rule, file in rules}
    for rule, _ in rules:
        for other in rule.unless_reported:
            if other not in where:
                known = ", ".join(sorted(where))
                raise RuleError(f"{where[rule.id]}: there is no rule {other!r}; known are {known}")
    _refuse_circle({rule.id: rule.unless_reported for rule, _ in rules}, where)


def _refuse_circle(leads_to: Mapping[str, Collection[str]], where: Mapping[str, str]) -> None:
    """Refuse a way that ends where it begins, ``a -> b -> a``, through names that name others."""
    try:
        TopologicalSorter(leads_to).prepare()
    except CycleError as error:
        circle = tuple(reversed(error.args[1]))
        told = f"they go in a circle: {' -> '.join(circle)}"
        raise RuleError(f"{where[circle[0]]}: {told}") from None
