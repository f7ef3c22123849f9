"""Where a protocol makes the place of a well out of a number or a letter.

``plate[f"A{column}"]``, ``plate.columns()[column - 1]`` and ``plate.rows_by_name()[row]`` tell that
``column`` counts columns and ``row`` names rows, and so do the constants that these come from.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

from .facts import Numbered, SourceFacts
from .literals import last_name, plain_text, taken_in_part

_INDEXED = {
    "columns": ("column", 0),
    "rows": ("row", 0),
    "columns_by_name": ("column", 1),
    "rows_by_name": ("row", 1),
}
"""What each method of a labware lists, and the number of the first one."""

_LETTERS = "ABCDEFGHIJKLMNOP"


def read_numbered(tree: ast.Module, facts: SourceFacts) -> None:
    """Note every such place; one in a helper, for each call of it, with what the call passes on."""
    calls: dict[str, list[ast.Call]] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            calls.setdefault(node.func.id, []).append(node)
    helpers = [
        node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef) and node.name in calls
    ]
    for place in _places(tree):
        around = [h for h in helpers if h.lineno <= place.lines[0] <= (h.end_lineno or h.lineno)]
        if around:
            helper = around[-1]  # the innermost: the walk goes from the outside in
            for call in calls[helper.name]:
                facts.numbered.extend(_passed(place, _arguments_of(helper, call), call.lineno))
        else:
            facts.numbered.append(place)


def _places(tree: ast.Module) -> Iterator[Numbered]:
    named, in_part = _names_of_lists(tree), taken_in_part(tree)
    for node in ast.walk(tree):
        if isinstance(node, ast.Subscript):
            for place in _found(node.value, node.slice, node.lineno, named):
                yield replace(place, partly=id(node) in in_part)
        elif (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Attribute)
            and node.func.attr in ("well", "wells")
            and len(node.args) == 1
        ):
            yield from _found(node.func.value, node.args[0], node.lineno, named)


def _arguments_of(helper: ast.FunctionDef, call: ast.Call) -> dict[str, ast.expr]:
    """What a call gives to each parameter of a helper."""
    given = dict(zip((a.arg for a in helper.args.args), call.args, strict=False))
    given.update({k.arg: k.value for k in call.keywords if k.arg})
    return given


def _passed(place: Numbered, given: Mapping[str, ast.expr], line: int) -> Iterator[Numbered]:
    """A helper's place as one of its calls makes it."""
    name, added = _counted(given[place.name]) if place.name in given else (place.name, 0)
    if not name:
        return
    fixed, across, across_first = place.fixed, place.across, place.across_first
    if across in given:
        across, more = _counted(given[across])
        across_first -= more
        row = plain_text(given[place.across])
        if place.axis == "column" and len(row) == 1 and row in _LETTERS:
            fixed = _LETTERS.index(row)
    labware = last_name(given[place.labware]) if place.labware in given else place.labware
    yield Numbered(
        labware or place.labware,
        place.axis,
        name,
        place.first - added,
        (*place.lines, line),
        fixed,
        across,
        across_first,
        place.partly,
    )


class _Listed(NamedTuple):
    """Columns or rows of a labware, or wells of one row by their columns."""

    labware: str
    axis: str
    first: int
    fixed: int | None = None


def _listed(node: ast.expr, named: Mapping[str, _Listed]) -> _Listed | None:
    """What ``plate.columns()``, ``plate.rows()[0]`` or ``[c[0] for c in plate.columns()]`` list."""
    if isinstance(node, ast.Name):
        return named.get(node.id)
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
        if node.func.attr in _INDEXED and not node.args:
            return _Listed(last_name(node.func.value), *_INDEXED[node.func.attr])
        return None
    if isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Constant):
        lines, at = _listed(node.value, named), node.slice.value
        if lines is None or lines.axis != "row" or lines.fixed is not None:
            return None
        if isinstance(at, str) and len(at) == 1 and at in _LETTERS:
            at = _LETTERS.index(at)
        return _Listed(lines.labware, "column", 0, at) if isinstance(at, int) else None
    if isinstance(node, ast.ListComp) and len(node.generators) == 1:
        made, each = node.generators[0], node.elt
        lines = _listed(made.iter, named)
        if (
            lines is not None
            and lines.axis == "column"
            and not made.ifs
            and isinstance(each, ast.Subscript)
            and isinstance(each.slice, ast.Constant)
            and isinstance(each.slice.value, int)
        ):
            return lines._replace(fixed=each.slice.value)
    return None


def _names_of_lists(tree: ast.Module) -> dict[str, _Listed]:
    """Names that hold such a list, and nothing else anywhere."""
    named: dict[str, _Listed] = {}
    others: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign) and len(node.targets) == 1:
            name, listed = last_name(node.targets[0]), _listed(node.value, named)
            if listed is None or named.get(name, listed) != listed:
                others.add(name)
            else:
                named[name] = listed
    return {name: listed for name, listed in named.items() if name not in others}


def _found(
    base: ast.expr, index: ast.expr, line: int, named: Mapping[str, _Listed]
) -> Iterator[Numbered]:
    listed = _listed(base, named)
    if listed is not None:
        name, added = _counted(index)
        if name:
            place = Numbered(
                listed.labware, listed.axis, name, listed.first - added, (line,), listed.fixed
            )
            yield replace(place, key=_key_in(index))
        return
    if isinstance(base, ast.Call) and isinstance(base.func, ast.Attribute):
        if base.func.attr != "wells_by_name" or base.args:
            return
        base = base.func.value
    parts = _pieces(index)
    if len(parts) != 2:
        return
    row, column = parts
    labware = last_name(base)
    letter = _held_in(row) if isinstance(row, ast.expr) else ""
    number, added = _counted(column) if isinstance(column, ast.expr) else ("", 0)
    if number:
        fixed = _LETTERS.find(row) if isinstance(row, str) and row in _LETTERS else None
        place = Numbered(labware, "column", number, 1 - added, (line,), fixed, letter)
        yield replace(place, key=_key_in(column) if isinstance(column, ast.expr) else "")
    if letter:
        fixed = int(column) - 1 if isinstance(column, str) and column.isdecimal() else None
        yield Numbered(labware, "row", letter, 0, (line,), fixed, number, 1 - added)


def _held_in(node: ast.expr) -> str:
    """The name in ``c``, ``layout.c``, ``LAYOUT["c"]`` or ``COLUMN[arm]``: a constant, a field or
    a dict.
    """
    if isinstance(node, ast.Subscript):
        key = node.slice.value if isinstance(node.slice, ast.Constant) else node.slice
        node = node.value if isinstance(key, (str, ast.Name)) else node
    return last_name(node) if isinstance(node, (ast.Name, ast.Attribute)) else ""


def _counted(node: ast.expr) -> tuple[str, int]:
    """The name in ``c``, ``str(c)``, ``c - 1`` or ``row["c"] + 1``, and what is added to it."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "str":
        node = node.args[0] if node.args else node
    if held := _held_in(node):
        return held, 0
    held = _held_in(node.left) if isinstance(node, ast.BinOp) else ""
    if not held or not isinstance(node, ast.BinOp):
        return "", 0
    added = node.right.value if isinstance(node.right, ast.Constant) else None
    if isinstance(added, int) and isinstance(node.op, (ast.Add, ast.Sub)):
        return held, added if isinstance(node.op, ast.Add) else -added
    return "", 0


def _key_in(node: ast.expr) -> str:
    """The key in ``row["col"]``, ``row["col"] - 1`` and ``str(row["col"])``, or ``""``."""
    for part in ast.walk(node):
        if isinstance(part, ast.Subscript) and isinstance(part.slice, ast.Constant):
            return part.slice.value if isinstance(part.slice.value, str) else ""
    return ""


def _pieces(node: ast.expr) -> list[str | ast.expr]:
    """What a text is put together of: ``f"A{c}"``, ``"A" + str(c)``, ``"A%d" % c``, ``r + "1"``."""
    if isinstance(node, ast.JoinedStr):
        return [
            part.value if isinstance(part, ast.FormattedValue) else str(part.value)
            for part in node.values
            if isinstance(part, (ast.FormattedValue, ast.Constant))
        ]
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return [*_piece(node.left), *_piece(node.right)]
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mod):
        return _filled(plain_text(node.left), ("%d", "%s", "%i"), _arguments(node.right))
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute):
        return []
    if node.func.attr == "format":
        return _filled(plain_text(node.func.value), ("{}",), node.args)
    return []


def _piece(node: ast.expr) -> list[str | ast.expr]:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return [node.value]
    return [node]


def _arguments(node: ast.expr) -> list[ast.expr]:
    return list(node.elts) if isinstance(node, ast.Tuple) else [node]


def _filled(text: str, marks: tuple[str, ...], values: list[ast.expr]) -> list[str | ast.expr]:
    """A row's letter and a value, or two values, where a text has as many marks."""
    for mark in marks:
        text = text.replace(mark, "\0")
    if text == "\0\0" and len(values) == 2:
        return list(values)
    if len(text) == 2 and text[1] == "\0" and len(values) == 1:
        return [text[0], values[0]]
    return []
