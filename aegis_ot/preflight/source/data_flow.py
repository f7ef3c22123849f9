"""Which names a name's values come from, and which labware is indexed with them.

Flow-insensitive and by name: enough to tell on which labware a plate map is used,
``plate[well] for well, kind in LAYOUT.items()``. A ``zip`` is taken apart, so that what names
the sources says nothing of the wells beside them.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

from .nodes import LOOPS, Nodes

_ASSIGNMENTS: tuple[type[ast.Assign | ast.AnnAssign | ast.NamedExpr], ...] = (
    ast.Assign,
    ast.AnnAssign,
    ast.NamedExpr,
)
_PASSING_ON = frozenset(
    {"enumerate", "list", "tuple", "reversed", "sorted", "set", "iter", "next", "zip", "dict"}
)
_WELL_GETTERS = frozenset(
    {"wells", "well", "columns", "rows", "wells_by_name", "columns_by_name", "rows_by_name"}
)


class Index(NamedTuple):
    """``rack[row["tube"]]``: what is indexed, with values of which names and fields."""

    indexed: str
    names: frozenset[str]
    fields: frozenset[str]


@dataclass
class Flow:
    """Where values come from.

    Attributes:
        comes_from: For each name, the names in what it is bound to.
        indexed: Each subscript of what may be labware.
    """

    comes_from: dict[str, set[str]] = field(default_factory=dict)
    indexed: list[Index] = field(default_factory=list)

    def take(self, name: str, value: ast.expr) -> None:
        """The name is bound to this."""
        self.comes_from.setdefault(name, set()).update(set(_held_names(value)) - {name})

    @cached_property
    def indexed_with(self) -> dict[str, list[Index]]:
        """Where something is indexed with values of a name, or with what comes from it, by name."""
        found: dict[str, list[Index]] = {}
        for index in self.indexed:
            origins: set[str] = set()
            open_ = list(index.names)
            while open_:
                if (name := open_.pop()) not in origins:
                    origins.add(name)
                    open_ += self.comes_from.get(name, ())
            for name in origins:
                found.setdefault(name, []).append(index)
        return found


def read_flow(nodes: Nodes) -> Flow:
    """Read all nodes of a parsed protocol."""
    flow = Flow()
    for assignment in nodes.of(*_ASSIGNMENTS):
        targets = assignment.targets if isinstance(assignment, ast.Assign) else [assignment.target]
        if assignment.value is not None:
            for target in targets:
                _bind(flow, target, assignment.value, looped=False)
    for loop in nodes.of(*LOOPS):
        _bind(flow, loop.target, loop.iter, looped=True)
    for subscript in nodes.of(ast.Subscript):
        _note_index(flow, subscript.value, subscript.slice)
    functions = {function.name: function for function in nodes.of(ast.FunctionDef)}
    for call in nodes.of(ast.Call):
        _call(flow, call, functions)
    return flow


def _bind(flow: Flow, target: ast.expr, value: ast.expr, looped: bool) -> None:
    for part, given in _parts(target, value, looped):
        for inner in ast.walk(part):
            if isinstance(inner, (ast.Name, ast.Attribute)):
                flow.take(_last_name(inner), given)


def _parts(target: ast.expr, value: ast.expr, looped: bool) -> Iterator[tuple[ast.expr, ast.expr]]:
    """Which part of a target takes its values from which expression."""
    if isinstance(target, (ast.Tuple, ast.List)):
        width = len(target.elts)
        pairs: Iterable[tuple[ast.expr, ast.expr]] = ()
        if looped and isinstance(value, ast.Call) and isinstance(value.func, ast.Name):
            if value.func.id == "zip" and len(value.args) == width:
                pairs = zip(target.elts, value.args, strict=True)
            elif value.func.id == "enumerate" and value.args and width == 2:
                pairs = [(target.elts[1], value.args[0])]
        elif not looped and isinstance(value, (ast.Tuple, ast.List)) and len(value.elts) == width:
            pairs = zip(target.elts, value.elts, strict=True)
        if pairs:
            for part, given in pairs:
                yield from _parts(part, given, looped)
            return
    yield target, value


def _held_names(node: ast.expr) -> Iterator[str]:
    """The names whose values an expression may pass on: ``LAYOUT`` in ``LAYOUT[code]``."""
    parts: Iterable[ast.AST] = ast.iter_child_nodes(node)
    if isinstance(node, (ast.Name, ast.Attribute)):
        yield _last_name(node)
    elif isinstance(node, ast.Subscript):
        parts = [node.value]
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
        parts = [node.func.value]
    elif isinstance(node, ast.Call):
        passes_on = not isinstance(node.func, ast.Name) or node.func.id in _PASSING_ON
        parts = node.args if passes_on else ()
    for part in parts:
        if isinstance(part, ast.comprehension):
            yield from _held_names(part.iter)
        elif isinstance(part, ast.expr):
            yield from _held_names(part)


def _note_index(flow: Flow, base: ast.expr, index: ast.expr) -> None:
    if isinstance(base, ast.Call) and isinstance(base.func, ast.Attribute):
        if base.func.attr not in _WELL_GETTERS or base.args:
            return
        base = base.func.value
    if isinstance(index, (ast.BinOp, ast.JoinedStr)):
        return  # `plate[well[0] + "3"]` is another well than the name says
    indexed = _last_name(base)
    names = frozenset(_held_names(index))
    if indexed and names:
        flow.indexed.append(Index(indexed, names, frozenset(_fields_in(index))))


def _fields_in(index: ast.expr) -> Iterator[str]:
    """The keys and attributes that an index asks for: ``row["tube"]``, ``row.tube``; and its
    names, which may have been taken from a field called so.
    """
    for inner in ast.walk(index):
        if isinstance(inner, (ast.Name, ast.Attribute)):
            yield _last_name(inner)
        elif isinstance(inner, ast.Constant) and isinstance(inner.value, (str, int)):
            yield str(inner.value)


def _call(flow: Flow, node: ast.Call, functions: dict[str, ast.FunctionDef]) -> None:
    if isinstance(node.func, ast.Attribute) and node.func.attr in _WELL_GETTERS and node.args:
        for argument in node.args:
            _note_index(flow, node.func.value, argument)
    function = functions.get(_last_name(node.func))
    if function is None:
        return
    names = [argument.arg for argument in function.args.args]
    if names[:1] == ["self"]:
        names = names[1:]
    named = ((keyword.arg, keyword.value) for keyword in node.keywords if keyword.arg)
    for name, value in (*zip(names, node.args, strict=False), *named):
        flow.take(name, value)


def _last_name(node: ast.expr) -> str:
    """``plate`` or ``self.plate``, as the last name."""
    if isinstance(node, ast.Name):
        return node.id
    return node.attr if isinstance(node, ast.Attribute) else ""
