"""Values that a protocol writes down: rows of a table, an index made of constants."""

from __future__ import annotations

import ast
import copy
import json
from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Any


def index_value(node: ast.expr, constants: Mapping[str, Any]) -> Any:
    """The value of an index made of constants and simple arithmetic."""
    if isinstance(node, ast.Constant):
        return node.value
    if isinstance(node, ast.Name):
        return constants.get(node.id)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        value = index_value(node.operand, constants)
        return -value if isinstance(value, int) else None
    if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub)):
        left, right = index_value(node.left, constants), index_value(node.right, constants)
        if isinstance(left, int) and isinstance(right, int):
            return left + right if isinstance(node.op, ast.Add) else left - right
        return None
    if isinstance(node, ast.Slice):
        low = index_value(node.lower, constants) if node.lower else None
        high = index_value(node.upper, constants) if node.upper else None
        given = [(node.lower, low), (node.upper, high)]
        if any(bound is not None and not isinstance(v, int) for bound, v in given):
            return None
        return slice(low, high)
    if isinstance(node, ast.Subscript):
        holder, key = index_value(node.value, constants), index_value(node.slice, constants)
        try:
            return holder[key]
        except (TypeError, KeyError, IndexError):
            return None
    return None


def _literal_of(node: ast.expr, kinds: Collection[str]) -> Any:
    """The value of a literal, in which members of the protocol's own Enums stand as their names.

    Args:
        node: The expression.
        kinds: Names of these Enums: ``Arm.VEHICLE`` is ``"VEHICLE"``.

    Raises:
        ValueError: If it is no literal; and what ``ast.literal_eval`` raises besides.
    """
    if kinds and any(isinstance(inner, ast.Attribute) for inner in ast.walk(node)):
        node = _Members(kinds).visit(copy.deepcopy(node))
    return ast.literal_eval(node)


class _Members(ast.NodeTransformer):
    """Puts the name of a member in its place."""

    def __init__(self, kinds: Collection[str]) -> None:
        self._kinds = kinds

    def visit_Attribute(self, node: ast.Attribute) -> ast.expr:
        if isinstance(node.value, ast.Name) and node.value.id in self._kinds:
            return ast.Constant(node.attr)
        return node


def fields_of(node: ast.expr, kinds: Collection[str]) -> dict[str, Any] | None:
    """What is written down in ``SimpleNamespace(drug=[3, 4])`` or ``dict(drug=range(3, 9))``."""
    if not isinstance(node, ast.Call) or node.args or not node.keywords:
        return None
    if last_name(node.func) not in ("SimpleNamespace", "dict"):
        return None
    found: dict[str, Any] = {}
    for keyword in node.keywords:
        value = written_value(keyword.value, kinds)
        if keyword.arg and value is not None:
            found[keyword.arg] = value
    return found


def written_value(node: ast.expr, kinds: Collection[str] = ()) -> Any:
    """What a literal, a range or a JSON text that is written down says, members of Enums by their
    names; ``None`` for what the run computes.
    """
    try:
        return _literal_of(node, kinds)
    except (ValueError, TypeError, SyntaxError, MemoryError, RecursionError):
        return _counted(node) or _loaded(node) or _split(node)


def _loaded(node: ast.expr) -> Any:
    """What ``json.loads(\"\"\"...\"\"\")`` makes of a text that is written down."""
    if not isinstance(node, ast.Call) or last_name(node.func) != "loads" or len(node.args) != 1:
        return None
    try:
        return json.loads(plain_text(node.args[0]))
    except (ValueError, RecursionError):
        return None


def _split(node: ast.expr) -> list[str] | None:
    """The words of ``"U V d1 d2".split()``, or what stands between commas."""
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute):
        return None
    by = [plain_text(argument) for argument in node.args]
    text = plain_text(node.func.value)
    if node.func.attr != "split" or not text or len(by) > 1 or not all(by) or node.keywords:
        return None
    return [part.strip() for part in text.split(by[0] if by else None)]


_LONGEST_RANGE = 400


def _counted(node: ast.expr) -> list[int] | None:
    """The numbers of ``range(2, 12)``, ``list(range(2, 12))`` or ``slice(2, 12)``, where they are
    written down.
    """
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Name) or node.keywords:
        return None
    if node.func.id in ("list", "tuple") and len(node.args) == 1:
        return _counted(node.args[0])
    bounds = [index_value(argument, {}) for argument in node.args]
    if node.func.id not in ("range", "slice") or not 1 <= len(bounds) <= 3:
        return None
    if not all(type(bound) is int for bound in bounds):
        return None
    try:
        numbers = range(*bounds)
        return list(numbers) if 0 < len(numbers) <= _LONGEST_RANGE else None
    except (ValueError, OverflowError):  # a step of 0, which Python will refuse as well; too many
        return None


_PASSING_ON = ("enumerate", "list", "reversed", "sorted", "tuple", "zip")
"""Calls that give on what they are given, one by one."""


def taken_in_part(tree: ast.AST) -> set[int]:
    """Identities of the expressions of which a slice or a condition takes some members only.

    ``plate.columns()[11]`` in ``plate.columns()[11][:6]`` and ``[w for w in ... if w in used]``.
    """
    found: set[int] = set()
    for node in ast.walk(tree):
        taken: list[ast.expr] = []
        if isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Slice):
            taken = [node.value] if node.slice.lower or node.slice.upper else []
        elif isinstance(node, ast.comprehension) and node.ifs:
            taken = [node.iter]
        while taken:
            part = taken.pop()
            found.add(id(part))
            if isinstance(part, ast.Call) and isinstance(part.func, ast.Name):
                taken += part.args if part.func.id in _PASSING_ON else []
    return found


def rows_of(value: ast.expr) -> Iterator[tuple[Any, ...]]:
    """The constants that stand in each row of a list of tuples, dicts or calls, or of a dict.

    ``[("NTC", plate["H12"], 5)]`` yields ``("NTC", 5)``: what stands beside the well, but
    not the indices inside an expression.
    """
    if isinstance(value, ast.Dict):
        for key, item in zip(value.keys, value.values, strict=False):
            if key is not None:
                yield tuple(constants_in([key, item]))
    elif isinstance(value, (ast.List, ast.Tuple)):
        for element in value.elts:
            if isinstance(element, (ast.Tuple, ast.List)):
                yield tuple(constants_in(element.elts))
            elif isinstance(element, ast.Dict):
                yield tuple(constants_in(element.values))
            elif isinstance(element, ast.Call):
                yield tuple(constants_in([*element.args, *(k.value for k in element.keywords)]))
            else:
                return


def constants_in(nodes: Iterable[ast.expr | None]) -> Iterator[Any]:
    """Strings and numbers among some expressions, those in nested lists included."""
    for node in nodes:
        if isinstance(node, ast.UnaryOp) and isinstance(node.operand, ast.Constant):
            node = node.operand
        if isinstance(node, ast.Constant) and isinstance(node.value, (str, int, float)):
            yield node.value
        elif isinstance(node, (ast.Tuple, ast.List)):
            yield from constants_in(node.elts)


def last_name(node: ast.expr) -> str:
    """``plate`` or ``self.plate``, as the last name."""
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute):
        return node.attr
    return ""


def plain_text(node: ast.expr) -> str:
    """A string constant, else ``""``."""
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else ""


def names_in(node: ast.AST) -> Iterator[str]:
    """Every name that stands anywhere in an expression."""
    for inner in ast.walk(node):
        if isinstance(inner, ast.Name):
            yield inner.id


def keying_names(node: ast.AST) -> set[str]:
    """The names that stand in an expression's indices alone: ``code`` in ``wells_of[code]``."""
    held: set[str] = set()
    open_: list[ast.AST] = [node]
    while open_:
        inner = open_.pop()
        if isinstance(inner, ast.Name):
            held.add(inner.id)
        elif isinstance(inner, ast.Subscript):
            open_.append(inner.value)
        else:
            open_ += ast.iter_child_nodes(inner)
    return set(names_in(node)) - held


def fields_in(node: ast.AST) -> Iterator[str]:
    """Every attribute that an expression takes without a call: ``LAYOUT.vehicle``."""
    called = {id(inner.func) for inner in ast.walk(node) if isinstance(inner, ast.Call)}
    for inner in ast.walk(node):
        if isinstance(inner, ast.Attribute) and id(inner) not in called:
            yield inner.attr


def keys_in(node: ast.AST) -> Iterator[str]:
    """The keys and attributes that an expression asks for: ``row["tube"]``, ``row.tube``."""
    for inner in ast.walk(node):
        if isinstance(inner, ast.Attribute):
            yield inner.attr
        elif isinstance(inner, ast.Subscript) and isinstance(inner.slice, ast.Constant):
            yield str(inner.slice.value)
