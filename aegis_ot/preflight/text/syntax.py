"""Reads the syntax tree of a protocol: assignments, loops, subscripts and calls."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import Any

from ...instrumentation import is_spot
from .bindings import picked_by
from .facts import Place, SourceFacts
from .lines import without_gaps
from .literals import (
    fields_of,
    index_value,
    keying_names,
    keys_in,
    last_name,
    names_in,
    plain_text,
    rows_of,
    taken_in_part,
    written_value,
)

_SIDES: dict[str, dict[int | str, str]] = {
    "aspirate": {1: "source", "location": "source"},
    "dispense": {1: "destination", "location": "destination"},
    **{
        method: {1: "source", "source": "source", 2: "destination", "dest": "destination"}
        for method in ("transfer", "distribute", "consolidate", "transfer_with_liquid_class")
    },
}


class SyntaxReader:
    """Walks a parsed protocol and notes what it finds."""

    def __init__(self, facts: SourceFacts, parameters: Mapping[str, Any]) -> None:
        self._facts = facts
        self._parameters = parameters
        self._documents: set[int] = set()
        self._in_part: set[int] = set()
        self._kinds: set[str] = set()
        self._assigning: set[int] = set()
        self._holders = {"params"}

    def visit_module(self, tree: ast.Module) -> None:
        """Note the facts of a whole module."""
        facts = self._facts
        self._kinds = {
            node.name
            for node in ast.walk(tree)
            if isinstance(node, ast.ClassDef)
            and any(last_name(base).endswith("Enum") for base in node.bases)
            and not _names_places(node)
        }
        self._assigning = {
            node.lineno for node in ast.walk(tree) if isinstance(node, (ast.Assign, ast.AnnAssign))
        }
        self._holders |= {
            last_name(target)
            for node in ast.walk(tree)
            if isinstance(node, ast.Assign) and last_name(node.value) == "params"
            for target in node.targets
        }
        for node in ast.walk(tree):
            if isinstance(node, ast.Assign):
                for target in node.targets:
                    self._assign(target, node.value, node.lineno)
            elif isinstance(node, ast.AnnAssign) and node.value is not None:
                self._assign(node.target, node.value, node.lineno)
            elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
                if isinstance(node.value.value, str):
                    facts.docstrings.append((node.lineno, without_gaps(node.value.value)))
                    self._documents.add(id(node.value))
            elif isinstance(node, (ast.FunctionDef, ast.Lambda)):
                function = node.name if isinstance(node, ast.FunctionDef) else "<lambda>"
                arguments = node.args
                for argument in (
                    *arguments.posonlyargs,
                    *arguments.args,
                    *arguments.kwonlyargs,
                ):
                    facts.loose.add((function, argument.arg))
        for name, given in self._parameters.items():
            if name not in facts.assigned:  # by which something else may be meant
                facts.constants.setdefault(name, given)
                facts.parameters.add(name)
        self._functions(tree, "<module>")
        self._in_part = taken_in_part(tree)
        for node in ast.walk(tree):
            if isinstance(node, ast.Name):
                facts.names.add(node.id)
            elif isinstance(node, ast.FunctionDef):
                facts.names.add(node.name)
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                if id(node) not in self._documents:
                    facts.strings.append((node.lineno, node.value))
            elif isinstance(node, ast.Subscript):
                self._subscript(node)
            elif isinstance(node, ast.Call):
                self._call(node)
        metadata = facts.constants.get("metadata")
        if isinstance(metadata, dict):
            facts.metadata = {
                str(key): value for key, value in metadata.items() if isinstance(value, str)
            }

    def _assign(self, target: ast.expr, value: ast.expr, line: int) -> None:
        facts = self._facts
        if isinstance(target, (ast.Tuple, ast.List)):
            for element in target.elts:
                if isinstance(element, ast.Name):
                    facts.assigned.setdefault(element.id, line)
            if isinstance(value, ast.Tuple) and len(value.elts) == len(target.elts):
                for element, given in zip(target.elts, value.elts, strict=True):
                    if isinstance(element, ast.Name) and isinstance(given, ast.Constant):
                        facts.constants.setdefault(element.id, given.value)
            return
        name = last_name(target)
        if not name:
            return
        facts.assigned.setdefault(name, line)
        note = facts.comments.get(line)
        last = getattr(value, "end_lineno", line) or line
        if note is None and last != line:
            note = facts.comments.get(last)
        if note is None and line - 1 in facts.own_line and line - 2 not in facts.own_line:
            above = facts.comments[line - 1]
            # A comment above a block of assignments heads them all; one above a single
            # assignment speaks of it.
            if line + 1 not in self._assigning:
                note = above
        if note:
            facts.notes.setdefault(name, note)
        rows = list(rows_of(value))
        if rows:
            facts.tables.setdefault(name, rows)
        literal = written_value(value, self._kinds)
        if literal is None:
            literal = fields_of(value, self._kinds)
        if literal is None:
            literal = self._given(value)
        if literal not in (None, {}, [], ()):  # what is filled in the run is no constant
            facts.constants.setdefault(name, literal)

    def _given(self, value: ast.expr) -> Any:
        """What ``protocol.params.column`` and ``int(p.column)`` were in the rehearsal."""
        if isinstance(value, ast.Call) and last_name(value.func) in ("int", "str", "float"):
            value = value.args[0] if len(value.args) == 1 else value
        return self._parameters.get(self._parameter(value))

    def _parameter(self, node: ast.AST) -> str:
        """The runtime parameter that ``protocol.params.column`` or ``p.column`` stands for."""
        held = isinstance(node, ast.Attribute) and last_name(node.value) in self._holders
        return node.attr if held and isinstance(node, ast.Attribute) else ""

    def _functions(self, node: ast.AST, function: str) -> None:
        for child in ast.iter_child_nodes(node):
            inside = child.name if isinstance(child, ast.FunctionDef) else function
            if isinstance(child, (ast.For, ast.AsyncFor)):
                turning = set(names_in(child.target))
                for name in (*turning, *picked_by(child, turning)):
                    self._facts.loose.add((inside, name))
                    self._facts.loops.add((inside, name))
            elif isinstance(child, ast.comprehension):
                for name in names_in(child.target):
                    self._facts.loose.add(("<comprehension>", name))
            self._functions(child, inside)

    def _subscript(self, node: ast.Subscript) -> None:
        base: ast.expr = node.value
        kind = "well"
        if isinstance(base, ast.Call) and isinstance(base.func, ast.Attribute):
            kinds = {
                "wells": "wells",
                "columns": "columns",
                "rows": "rows",
                "wells_by_name": "well",
                "columns_by_name": "column",
                "rows_by_name": "row",
            }
            if base.func.attr not in kinds or base.args:
                return
            kind, base = kinds[base.func.attr], base.func.value
        labware = last_name(base)
        if labware:
            self._place(labware, node.slice, kind, node.lineno, id(node) in self._in_part)

    def _call(self, node: ast.Call) -> None:
        if isinstance(node.func, ast.Attribute) and node.func.attr == "define_liquid":
            self._liquid(node)
        if isinstance(node.func, ast.Attribute):
            self._arguments(node, node.func.attr)
        if (
            isinstance(node.func, ast.Attribute)
            and node.func.attr in ("well", "wells")
            and len(node.args) == 1
        ):
            labware = last_name(node.func.value)
            if labware:
                self._place(labware, node.args[0], "well", node.lineno)

    def _arguments(self, node: ast.Call, method: str) -> None:
        """``p20.transfer(2, sample, well)``: wells drawn from are samples, whatever the loop."""
        sides = _SIDES.get(method, {})
        given = [(sides.get(n), a) for n, a in enumerate(node.args)]
        given += [(sides.get(k.arg), k.value) for k in node.keywords if k.arg]
        for side, value in given:
            if not side:
                continue
            said = value.slice if isinstance(value, ast.Subscript) else value
            names = (_root(said), _field(said))
            listed = self._facts.arguments.setdefault(node.lineno, [])
            listed += [(side, name) for name in names if name]

    def _liquid(self, node: ast.Call) -> None:
        values = dict(
            zip(("name", "description"), (plain_text(a) for a in node.args), strict=False)
        )
        values.update(
            {k.arg: plain_text(k.value) for k in node.keywords if k.arg in values or k.arg}
        )
        name, description = values.get("name"), values.get("description")
        if name and description:
            self._facts.liquids.setdefault(name, description)

    def _place(
        self, labware: str, index: ast.expr, kind: str, line: int, partly: bool = False
    ) -> None:
        given = (name for node in ast.walk(index) if (name := self._parameter(node)))
        names = tuple(dict.fromkeys((*names_in(index), *given)))
        if names:
            self._facts.places.append(
                Place(
                    labware,
                    names,
                    index_value(index, self._facts.constants),
                    kind,
                    line,
                    tuple(keys_in(index)),
                    partly,
                    _is_made_of_parts(index),
                    frozenset(keying_names(index)),
                )
            )


def _is_made_of_parts(index: ast.expr) -> bool:
    """Whether an index is put together: ``"A" + row``, ``f"{row}{column}"``, no ``str(well)``."""
    if isinstance(index, ast.JoinedStr):
        return len(index.values) > 1
    if isinstance(index, ast.Call):
        return isinstance(index.func, ast.Attribute) and index.func.attr == "format"
    return isinstance(index, ast.BinOp)


def _names_places(kind: ast.ClassDef) -> bool:
    """Whether the members of a class are wells, ``DILUENT = "A1"``: such a member is a place."""
    values = [node.value for node in kind.body if isinstance(node, ast.Assign)]
    return any(is_spot(plain_text(value)) for value in values)


def _root(value: ast.expr) -> str:
    """``std`` in ``std``, ``std.top()``, ``std.tube`` and ``std["tube"]``, else ``""``."""
    while isinstance(value, (ast.Call, ast.Attribute, ast.Subscript)):
        value = value.func if isinstance(value, ast.Call) else value.value
    return value.id if isinstance(value, ast.Name) else ""


def _field(value: ast.expr) -> str:
    """``lad.diluent`` in ``lad.diluent`` and ``lad.diluent.bottom(2)``, else ``""``."""
    if isinstance(value, ast.Call):
        value = value.func.value if isinstance(value.func, ast.Attribute) else value
    if isinstance(value, ast.Attribute) and isinstance(value.value, ast.Name):
        return f"{value.value.id}.{value.attr}"
    return ""
