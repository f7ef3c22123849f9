"""The nodes of a parsed text by kind, each with the function that it is in."""

from __future__ import annotations

import ast
import functools
from collections import defaultdict
from collections.abc import Iterator
from typing import TypeVar

LOOPS: tuple[type[ast.For | ast.comprehension], ...] = (ast.For, ast.comprehension)

_Node = TypeVar("_Node", bound=ast.AST)
_Placed = tuple[ast.AST, str, tuple[str, ...]]

_SILENT_FIELDS = frozenset(
    {"arg", "attr", "ctx", "op", "ops", "kind", "type_comment", "returns", "annotation"}
)
"""What holds names, operators, types: nearly half of all nodes, and nothing is read from them."""


class Nodes:
    """Every node that says something, in reading order within its kind.

    The walk takes most of the time that reading a text takes, so there is one, and each reader
    looks only at its own kinds.
    """

    def __init__(self, tree: ast.AST) -> None:
        self._placed: dict[type[ast.AST], list[_Placed]] = defaultdict(list)
        open_: list[_Placed] = [(tree, "<module>", ())]
        while open_:
            placed = open_.pop()
            node, function, looping = placed
            self._placed[type(node)].append(placed)
            if not (fields := _telling_fields(type(node))):  # type: ignore[arg-type]
                continue
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
                function = node.name
            elif isinstance(node, ast.Lambda):
                function = "<lambda>"
            elif isinstance(node, LOOPS):
                looping = (*looping, function)
            below: list[object] = []
            for name in fields:
                value = getattr(node, name, None)
                below += value if isinstance(value, list) else (value,)
            nodes = (part for part in reversed(below) if isinstance(part, ast.AST))
            open_ += [(part, function, looping) for part in nodes]

    def of(self, *kinds: type[_Node]) -> Iterator[_Node]:
        """The nodes of these kinds, one kind after the other."""
        for node, _, _ in self.placed(*kinds):
            yield node

    def placed(self, *kinds: type[_Node]) -> Iterator[tuple[_Node, str, tuple[str, ...]]]:
        """Likewise, each with its function, and with those in which loops enclose it."""
        for kind in kinds:
            yield from self._placed.get(kind, ())  # type: ignore[misc]


@functools.cache
def _telling_fields(kind: type[ast.AST]) -> tuple[str, ...]:
    """What may hold further nodes; most nodes are of two kinds, and nothing is below them."""
    if kind in (ast.Name, ast.Constant):
        return ()
    return tuple(name for name in kind._fields if name not in _SILENT_FIELDS)
