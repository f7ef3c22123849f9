"""The vocabulary of checks: predicates over trace and roles that rules are made of.

A rule file names a check and gives its parameters; no rule has code of its own.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib import import_module
from typing import Any

from ...errors import RuleError
from ..rules import read_dataclass
from .check import Check, Doubt, Violation
from .rule_context import RuleContext

_ROOMS = (
    "carry receiving uniform_volume order drawn_off dose_order dilution filling volumes "
    "handling range written emptied"
)

CHECKS: dict[str, type[Check]] = {
    re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower(): check
    for room in (import_module(f".{name}", __name__) for name in _ROOMS.split())
    for name, check in vars(room).items()
    if getattr(check, "__module__", "") == room.__name__
    if isinstance(check, type) and issubclass(check, Check) and name != "SeriesCheck"
}
"""Each check by its class's name: ``mixed_after`` is :class:`MixedAfter`."""


def make_check(data: Mapping[str, Any], where: str) -> Check:
    """Build a check from its description in a rule file.

    Raises:
        RuleError: If there is no such check, or its parameters are wrong.
    """
    parameters = dict(data)
    name = parameters.pop("check", None)
    if not isinstance(name, str) or name not in CHECKS:
        called = repr(name) if isinstance(name, str) else "without a name"
        raise RuleError(
            f"{where}: check: there is no check {called}; known are {', '.join(CHECKS)}"
        )
    return read_dataclass(CHECKS[name], parameters, where)


__all__ = ["CHECKS", "Check", "Doubt", "RuleContext", "Violation", "make_check"]
