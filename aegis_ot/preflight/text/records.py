"""Tables whose rows are objects: ``[Zone("vehicle", range(2, 4)), Zone("drug", range(4, 8))]``."""

from __future__ import annotations

import ast
from collections.abc import Container, Iterator, Mapping, Sequence
from typing import Any

from .facts import SourceFacts
from .literals import last_name, plain_text, written_value

_FEWEST = 2

_NAMED_TUPLE = ("namedtuple", 2)
"""How they are made: of a name and of what lists the fields."""


def read_records(tree: ast.Module, facts: SourceFacts) -> None:
    """Note every list of such rows by its name, each row with the fields that are written down."""
    fields = dict(_classes(tree))
    for node in ast.walk(tree):
        if isinstance(node, (ast.Assign, ast.AnnAssign)) and node.value is not None:
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            rows = list(_rows(node.value, fields))
            if len(rows) >= _FEWEST and all(rows):
                for name in filter(None, map(last_name, targets)):
                    facts.records.setdefault(name, rows)


def _classes(tree: ast.Module) -> Iterator[tuple[str, Sequence[str]]]:
    """The fields of classes that state them, in order, and of named tuples."""
    yield "dict", ()
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef):
            stated = [part.target for part in node.body if isinstance(part, ast.AnnAssign)]
            yield node.name, [target.id for target in stated if isinstance(target, ast.Name)]
        elif isinstance(node, ast.Call) and (last_name(node.func), len(node.args)) == _NAMED_TUPLE:
            name, listed = node.args
            yield plain_text(name), _fields_listed(listed)


def _fields_listed(node: ast.expr) -> Sequence[str]:
    """The fields in ``"kind columns"``, ``"kind, columns"`` or ``["kind", "columns"]``."""
    if isinstance(node, (ast.List, ast.Tuple)):
        return [plain_text(part) for part in node.elts]
    return plain_text(node).replace(",", " ").split()


def _rows(node: ast.expr, fields: Mapping[str, Sequence[str]]) -> Iterator[dict[str, Any]]:
    for row in node.elts if isinstance(node, (ast.List, ast.Tuple)) else ():
        yield dict(_cells(row, fields)) if isinstance(row, ast.Call) else {}


def _cells(row: ast.Call, fields: Mapping[str, Sequence[str]]) -> Iterator[tuple[str, Any]]:
    """The fields of one row; none where it is spread out of another one: ``Zone(*row)``."""
    kind = last_name(row.func)
    if kind not in fields or any(isinstance(argument, ast.Starred) for argument in row.args):
        return
    named = [(word.arg, word.value) for word in row.keywords if word.arg]
    for name, value in (*zip(fields[kind], row.args, strict=False), *named):
        cell = _value(value, fields)
        if cell is not None:
            yield name, cell


def _value(node: ast.expr, classes: Container[str]) -> Any:
    """What a cell holds; a member of an Enum is its name, what the run computes is nothing."""
    if isinstance(node, ast.Attribute):
        return node.attr if last_name(node.value) in classes else None
    return written_value(node)
