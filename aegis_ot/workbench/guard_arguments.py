"""What a guarded protocol itself says about its judging: ``@guard(assay="pcr", roles={...})``.

Read from the text, because in a rehearsal the guard stands aside. Only literals count.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from ..settings.values import READERS, SettingPlace
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
    nodes = list(ast.walk(tree))
    decorators = (node.decorator_list for node in nodes if isinstance(node, ast.FunctionDef))
    # Several above one function are one guard, and the outer one comes first.
    calls = next(filter(None, map(_guards, decorators)), _guards(nodes)[:1])
    read = [_read(call) for call in calls]
    values = {name: value for one in reversed(read) for name, value in one.values.items()}
    return GuardArguments(values, tuple(said for one in read for said in one.unread))


def _guards(nodes: Iterable[ast.AST]) -> list[ast.Call]:
    return [one for one in nodes if isinstance(one, ast.Call) and _is_guard(one.func)]


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
            values[name] = READERS[name](
                value, SettingPlace(name, f"argument of the guard, line {line}")
            )
    return GuardArguments(values, tuple(unread))


def _is_guard(function: ast.expr) -> bool:
    if isinstance(function, ast.Attribute):
        module = function.value
        named = isinstance(module, ast.Name) and module.id == "aegis_ot"
        return named and function.attr == "guard"
    return isinstance(function, ast.Name) and function.id == "guard"
