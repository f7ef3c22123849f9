"""Holds a family against what exists: its own roles, and the vocabulary of checks."""

from __future__ import annotations

from collections.abc import Sequence

from ...errors import RuleError
from ..checks import make_check
from ..rules import Family, RoleSpec, RuleSpec
from ..trace import SHAPES


def check_family(family: Family, file: str) -> None:
    """Refuse a family that names a role, check or word that does not exist.

    Args:
        family: As it was read.
        file: Its name, for the message.

    Raises:
        RuleError: With file, rule and field.
    """
    for name, role in family.roles.items():
        _check_role(family, name, role, file)
    for number, spoken in enumerate(family.signals):
        for name in spoken.roles:
            _known(family, name, f"{file}: signals[{number}]: roles")
    for signal in family.shapes:
        for shape in (signal.shape, *signal.unless):
            if shape not in SHAPES:
                raise RuleError(
                    f"{file}: shapes: there is no shape {shape!r}; known are {', '.join(SHAPES)}"
                )
    for together in family.known_by:
        for alternatives in together.roles:
            for name in alternatives.split("|"):
                _known(family, name, f"{file}: known_by")
    for rule in family.rules:
        _check_rule(family, rule, f"{file}: rule {rule.id}")


def _check_role(family: Family, name: str, role: RoleSpec, file: str) -> None:
    if role.side not in ("source", "destination", "any"):
        raise RuleError(
            f"{file}: roles.{name}.side: expected source, destination or any, found {role.side!r}"
        )
    for other in (
        *role.parents,
        *role.receives,
        *role.filled_by,
        *role.feeds,
        *role.used_like,
        *role.gets,
        *role.in_place_of,
        *role.common_to,
    ):
        _known(family, other, f"{file}: roles.{name}")


def _check_rule(family: Family, rule: RuleSpec, where: str) -> None:
    if rule.severity not in ("error", "warning"):
        raise RuleError(f"{where}: severity: expected error or warning, found {rule.severity!r}")
    if rule.scope not in ("family", "all"):
        raise RuleError(f"{where}: scope: expected family or all, found {rule.scope!r}")
    for need in rule.needs:
        for role in need.split("|"):
            _known(family, role, f"{where}: needs")
    if not rule.checks:
        raise RuleError(f"{where}: checks: at least one check is needed")
    if not rule.examples.passing or not rule.examples.failing:
        raise RuleError(f"{where}: examples: one passing and one failing are needed")
    for number, check in enumerate(rule.checks):
        place = f"{where}: checks[{number}]"
        for role in make_check(check, place).roles():
            _known(family, role, place)


def _known(family: Family, role: str, where: str) -> None:
    if role not in family.roles:
        raise RuleError(
            f"{where}: there is no role {role!r} in this family; "
            f"known are {', '.join(family.roles)}"
        )


def refuse_doubles(families: Sequence[Family]) -> None:
    """Refuse a family or a rule that another file defines already.

    Raises:
        RuleError: With both files.
    """
    seen: dict[str, str] = {}
    for family in families:
        for kind, name in [
            ("family", family.family),
            *(("rule", rule.id) for rule in family.rules),
        ]:
            key = f"{kind} {name}"
            if key in seen:
                raise RuleError(f"{family.path}: {key} is already defined in {seen[key]}")
            seen[key] = family.path
