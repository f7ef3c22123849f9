"""What iterables made of literals and of a module's constants yield, in order."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from typing import Any

_KEEPS_ORDER = ("list", "tuple", "iter")


def sequence_of(node: ast.expr, constants: Mapping[str, Any]) -> Sequence[Any] | None:
    """What an iterable made of literals yields, in order."""
    if isinstance(node, ast.Name):
        value = constants.get(node.id)
        return list(value) if isinstance(value, (list, tuple, dict, str)) else None
    if isinstance(node, ast.Call):
        return _called(node, constants)
    if isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Slice):
        rows = sequence_of(node.value, constants)
        bounds = [_literal(b) for b in (node.slice.lower, node.slice.upper, node.slice.step)]
        if rows is None or not all(bound is None or isinstance(bound, int) for bound in bounds):
            return None
        return rows[slice(*bounds)]
    value = _literal(node)
    return list(value) if isinstance(value, (list, tuple, dict, str)) else None


def counted(node: ast.expr, constants: Mapping[str, Any]) -> str:
    """The list whose items are counted in ``range(len(DOSES))``, or ``""``."""
    match node:
        case ast.Call(ast.Name("range"), [ast.Call(ast.Name("len"), [ast.Name(name)], [])], []) if (
            isinstance(constants.get(name), (list, tuple))
        ):
            return name
    return ""


def _called(node: ast.Call, constants: Mapping[str, Any]) -> Sequence[Any] | None:
    if isinstance(node.func, ast.Attribute) and not node.args:
        holder = node.func.value
        value = constants.get(holder.id) if isinstance(holder, ast.Name) else _literal(holder)
        if isinstance(value, dict) and node.func.attr in ("items", "keys", "values"):
            return list(getattr(value, node.func.attr)())
        return None
    if not isinstance(node.func, ast.Name) or len(node.args) != 1 or node.keywords:
        return None
    rows = sequence_of(node.args[0], constants)
    if rows is None or node.func.id in _KEEPS_ORDER:
        return rows
    if node.func.id == "reversed":
        return rows[::-1]
    if node.func.id == "sorted":
        try:
            return sorted(rows)
        except TypeError:
            return None
    return None


def _literal(node: ast.expr | None) -> Any:
    try:
        return None if node is None else ast.literal_eval(node)
    except (ValueError, TypeError, SyntaxError, MemoryError, RecursionError):
        return ...
