"""Names that a loop binds to another item in each turn, so that the last one says little."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator

from .literals import names_in


def picked_by(loop: ast.For | ast.AsyncFor, turning: set[str]) -> Iterator[str]:
    """Names that a loop binds to another item in each turn: ``src = rack[spots[i]]``.

    Or to one of two: ``dye = trough["A1"] if i < 6 else trough["A2"]``.
    """
    for node in ast.walk(loop):
        for target, value in _bound(node) if isinstance(node, ast.Assign) else ():
            indices = (s.slice for s in ast.walk(value) if isinstance(s, ast.Subscript))
            either = isinstance(value, ast.IfExp)
            if either or any(not turning.isdisjoint(names_in(index)) for index in indices):
                yield target.id
        if isinstance(node, ast.If):
            yield from _bound_in(node.body) & _bound_in(node.orelse)


def _bound_in(branch: Iterable[ast.stmt]) -> set[str]:
    """The names that the statements of a branch bind."""
    return {
        target.id
        for statement in branch
        for node in ast.walk(statement)
        for target, _ in (_bound(node) if isinstance(node, ast.Assign) else ())
    }


def _bound(node: ast.Assign) -> Iterator[tuple[ast.Name, ast.expr]]:
    """Each name that an assignment binds, with what it is bound to: ``a, b = rack[i], row[i]``."""
    for target in node.targets:
        pairs = [(target, node.value)]
        if isinstance(target, ast.Tuple) and isinstance(node.value, ast.Tuple):
            pairs = list(zip(target.elts, node.value.elts, strict=False))
        for one, value in pairs:
            if isinstance(one, ast.Name):
                yield one, value
