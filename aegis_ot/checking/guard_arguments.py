"""What a guarded protocol itself says about its roles: ``@guard(assay="pcr", roles={...})``.

Read from the text, because in a rehearsal the guard stands aside. Only literals count.
"""

from __future__ import annotations

import ast
from typing import Any

_NAMES = ("assay", "roles", "select", "ignore", "rules")


def guard_arguments(text: str) -> dict[str, Any]:
    """The literal arguments of the protocol's guard that concern judging; empty without one."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and _is_guard(node.func):
            return {
                keyword.arg: value
                for keyword in node.keywords
                if keyword.arg in _NAMES and (value := _literal(keyword.value)) is not None
            }
    return {}


def _is_guard(function: ast.expr) -> bool:
    if isinstance(function, ast.Attribute):
        return function.attr == "guard"
    return isinstance(function, ast.Name) and function.id == "guard"


def _literal(node: ast.expr) -> Any:
    try:
        return ast.literal_eval(node)
    except (ValueError, TypeError, SyntaxError):
        return None
