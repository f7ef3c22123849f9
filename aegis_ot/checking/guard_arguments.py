"""What a guarded protocol itself says about its judging: ``@guard(assay="pcr", roles={...})``.

Read from the text, because in a rehearsal the guard stands aside. Only literals count.
"""

from __future__ import annotations

import ast
from dataclasses import dataclass, field
from typing import Any

from ..settings.values import READERS, Site
from ..vocabulary import Remark

_JUDGING = ("assay", "roles", "select", "ignore", "rules")
_NAMES = (*_JUDGING, "recover", "recover_limit", "recover_run_limit")


@dataclass(frozen=True)
class GuardArguments:
    """The arguments of the protocol's guard that a workstation must know to judge or to simulate.

    Attributes:
        values: Those that are literals, as the settings hold them.
        unread: Those for judging that are none: the guard will know them, and a reader of the text
            does not.
    """

    values: dict[str, Any] = field(default_factory=dict)
    unread: tuple[Remark, ...] = ()


def guard_arguments(text: str) -> GuardArguments:
    """Read them; nothing is said without a guard, or by text that does not parse.

    Raises:
        ConfigurationError: One of them is nothing that the guard takes, which will say so too.
    """
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return GuardArguments()
    calls = [n for n in ast.walk(tree) if isinstance(n, ast.Call) and _is_guard(n.func)]
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef):
            above = [one for one in function.decorator_list if one in calls]
            if above:  # several are one guard, and the outer one comes first
                read = [_read(one) for one in above if isinstance(one, ast.Call)]
                values = {
                    name: value for one in reversed(read) for name, value in one.values.items()
                }
                return GuardArguments(values, tuple(said for one in read for said in one.unread))
    return _read(calls[0]) if calls else GuardArguments()


def _read(call: ast.Call) -> GuardArguments:
    values: dict[str, Any] = {}
    unread: list[Remark] = []
    for keyword in call.keywords:
        if keyword.arg not in _NAMES:
            continue
        name, line = keyword.arg, keyword.value.lineno
        try:
            value = ast.literal_eval(keyword.value)
        except (ValueError, TypeError, SyntaxError):
            if name not in _JUDGING:
                continue
            told = f"The guard's {name} is worked out in the run, so this check does not know it;"
            unread.append(Remark(f"{told} written out as a literal, it counts.", line))
            continue
        if value is not None:
            values[name] = READERS[name](value, Site(name, f"argument of the guard, line {line}"))
    return GuardArguments(values, tuple(unread))


def _is_guard(function: ast.expr) -> bool:
    if isinstance(function, ast.Attribute):
        module = function.value
        named = isinstance(module, ast.Name) and module.id == "aegis_ot"
        return named and function.attr == "guard"
    return isinstance(function, ast.Name) and function.id == "guard"
