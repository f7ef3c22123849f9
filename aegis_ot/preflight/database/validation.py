"""Holds a family against what exists: its own roles, the vocabulary of checks, readable words."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from typing import Any

from ...errors import RuleError
from ..checks import make_check
from ..rules import Family, RoleSpec, RuleSpec
from ..source import tokens
from .circles import circle_in


def check_family(family: Family, file: str) -> None:
    """Refuse a family that names a role or check that does not exist, or words nobody can find.

    Args:
        family: As it was read.
        file: Its name, for the message.

    Raises:
        RuleError: With file, rule or role, and field.
    """
    for number, spoken in enumerate(family.signals):
        place = f"{file}: signals[{number}]"
        _check_names(family, spoken, place)
        _check_words("words", spoken.words, place)
    for number, shape in enumerate(family.shapes):
        _check_names(family, shape, f"{file}: shapes[{number}]")
    for name, role in family.roles.items():
        _check_role(family, role, f"{file}: roles.{name}")
    _check_parents(family, file)
    if family.series is not None:
        _check_names(family, family.series, f"{file}: series")
    for number, together in enumerate(family.known_by):
        for alternatives in together.roles:
            for name in alternatives.split("|"):
                _known(family, name, f"{file}: known_by[{number}]: roles")
    for rule in family.rules:
        _check_rule(family, rule, f"{file}: rule {rule.id}")


def _check_role(family: Family, role: RoleSpec, where: str) -> None:
    _check_names(family, role, where)
    for field in ("words", "never", "differing"):
        _check_words(field, getattr(role, field), where)


def _check_parents(family: Family, file: str) -> None:
    """What a role counts as is followed to the end, which a circle has not."""
    circle = circle_in({name: role.parents for name, role in family.roles.items()})
    if circle:
        raise RuleError(
            f"{file}: roles.{circle[0]}: parents: they go in a circle: {' -> '.join(circle)}"
        )


def _check_rule(family: Family, rule: RuleSpec, where: str) -> None:
    for need in rule.needs:
        for role in need.split("|"):
            _known(family, role, f"{where}: needs")
    for number, check in enumerate(rule.checks):
        place = f"{where}: checks[{number}]"
        _check_names(family, make_check(check, place), place)


def _check_names(family: Family, holder: Any, where: str) -> None:
    """Hold all fields that list roles against the roles of the family."""
    for field in dataclasses.fields(holder):
        if field.metadata.get("roles"):
            for name in getattr(holder, field.name):
                _known(family, name, f"{where}: {field.name}")


def _known(family: Family, role: str, where: str) -> None:
    if role not in family.roles:
        raise RuleError(
            f"{where}: there is no role {role!r} in this family; "
            f"known are {', '.join(family.roles)}"
        )


def _check_words(field: str, words: Iterable[str], where: str) -> None:
    for word in words:
        if not tokens(word):
            raise RuleError(f"{where}: {field}: {word!r} holds no letter or number to look for")
