"""Holds families against what exists: their roles, the vocabulary of checks, each other."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import Any

from ...errors import RuleError
from ..checks import make_check
from ..rules import Family
from ..source import tokens

_NAME = "name such wells in the protocol, load a liquid, or give them in the guard's `roles`"
_BY_NAME = (
    "single_with single_beside used_like gets in_place_of common_to called_alike_beside passed_on"
)

DROPPED: Mapping[str, str] = {
    **dict.fromkeys(_BY_NAME.split(), _NAME),
    "holds": "load the liquid, and list its role in `receives`",
    "undosed": "give the wells of dose 0 a name of their own",
    "replicated": "name the wells of each plate",
    "receives_with": "leave it out: `receives` alone decides",
    "feeds_beside": "leave it out: `feeds` alone decides",
}
"""Fields of schema 1 that are gone, each with what to write instead."""

_WORDS = ("words", "never", "differing")


def refuse_dropped(data: Mapping[str, Any], file: str) -> None:
    """Refuse a family that uses what schema 2 no longer has.

    Args:
        data: The file, as it was parsed.
        file: Its name, for the message.

    Raises:
        RuleError: With file, place, field, and what to write instead.
    """
    if isinstance(series := data.get("series"), dict) and "wells" in series:
        raise RuleError(f"{file}: series: 'wells' is no field any more: leave it out")
    roles = data.get("roles")
    for name, role in roles.items() if isinstance(roles, dict) else ():
        for field in role if isinstance(role, dict) else ():
            if field in DROPPED:
                raise RuleError(
                    f"{file}: roles.{name}: {field!r} is no field since schema 2: {DROPPED[field]}"
                )


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
    _refuse_circle(parents, lambda name: f"{file}: roles.{name}: parents")


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
    files = {rule.id: Path(family.path).name for family in families for rule in family.rules}
    rules = {rule.id: rule for family in families for rule in family.rules}
    for name, rule in rules.items():
        for other in rule.unless_reported:
            if other not in rules:
                raise RuleError(
                    f"{files[name]}: rule {name}: unless_reported: there is no rule {other!r}; "
                    f"known are {', '.join(sorted(rules))}"
                )
    leads_to = {name: rule.unless_reported for name, rule in rules.items()}
    _refuse_circle(leads_to, lambda name: f"{files[name]}: rule {name}: unless_reported")


def _refuse_circle(leads_to: Mapping[str, Collection[str]], where: Callable[[str], str]) -> None:
    """Refuse a way that ends where it begins, ``a -> b -> a``, through names that name others."""
    try:
        TopologicalSorter(leads_to).prepare()
    except CycleError as error:
        circle = tuple(reversed(error.args[1]))
        told = f"they go in a circle: {' -> '.join(circle)}"
        raise RuleError(f"{where(circle[0])}: {told}") from None
