"""What only the text of a protocol can tell: comments, docstrings, constants, subscripts.

The rehearsal knows which wells were used; the text knows what the scientist wrote about them.
"""

from __future__ import annotations

import ast
import io
import tokenize
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Place:
    """``rack[MASTER_MIX]``: a labware name, how it was indexed, and by which names.

    Attributes:
        labware: The expression that holds the labware, ``"rack"``.
        names: Names that stand in the index, ``("MASTER_MIX",)``.
        value: The index, where constants give it: ``"A1"``, ``95``, a list of these; else
            ``None``.
        kind: ``well``, ``wells``, ``columns`` or ``rows``: what is indexed.
        line: Where it stands.
    """

    labware: str
    names: tuple[str, ...]
    value: Any
    kind: str
    line: int


@dataclass
class SourceFacts:
    """The facts of one protocol text.

    Attributes:
        comments: Comment text by line.
        own_line: Lines that hold nothing but a comment.
        docstrings: Module and function docstrings, and other free-standing strings.
        metadata: Values of the ``metadata`` dict.
        constants: Names bound to literals, by name.
        places: Subscripts of labware by names or constants.
        loose: Names that are loop variables or parameters, as ``(function, name)``.
        loops: Those of them that are loop variables.
        notes: Comment beside or right above the assignment of a name, by that name.
        assigned: Line of the first assignment of each name.
        tables: For names bound to a list of rows or to a dict, the constants of each row.
        blocks: For the first line of a run of statements without a gap, all lines of it.
        arguments: By line, the names that calls draw from and give to, as ``(side, name)``.
        liquids: Description of each liquid defined in the text, by its name.
        names: Every identifier of the text, once.
        strings: Every other string of the text, with its line.
    """

    comments: dict[int, str] = field(default_factory=dict)
    own_line: set[int] = field(default_factory=set)
    docstrings: list[tuple[int, str]] = field(default_factory=list)
    metadata: dict[str, str] = field(default_factory=dict)
    constants: dict[str, Any] = field(default_factory=dict)
    places: list[Place] = field(default_factory=list)
    loose: set[tuple[str, str]] = field(default_factory=set)
    loops: set[tuple[str, str]] = field(default_factory=set)
    notes: dict[str, str] = field(default_factory=dict)
    assigned: dict[str, int] = field(default_factory=dict)
    tables: dict[str, list[tuple[Any, ...]]] = field(default_factory=dict)
    blocks: dict[int, tuple[int, ...]] = field(default_factory=dict)
    arguments: dict[int, list[tuple[str, str]]] = field(default_factory=dict)
    liquids: dict[str, str] = field(default_factory=dict)
    names: set[str] = field(default_factory=set)
    strings: list[tuple[int, str]] = field(default_factory=list)


_ARGUMENTS: dict[str, dict[int | str, str]] = {
    "aspirate": {1: "source", "location": "source"},
    "dispense": {1: "destination", "location": "destination"},
    **{
        method: {1: "source", "source": "source", 2: "destination", "dest": "destination"}
        for method in ("transfer", "distribute", "consolidate", "transfer_with_liquid_class")
    },
}


def read_source(text: str) -> SourceFacts:
    """Read a protocol's text. Text that does not parse yields what its comments say."""
    facts = SourceFacts()
    _read_comments(text, facts)
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):
        return facts
    _Reader(facts).visit_module(tree)
    _read_blocks(text, tree, facts)
    return facts


def _read_blocks(text: str, tree: ast.Module, facts: SourceFacts) -> None:
    """A comment heads the statements below it, up to a blank line or the next comment."""
    lines = text.splitlines()
    for node in ast.walk(tree):
        if not isinstance(node, ast.stmt) or isinstance(node, ast.FunctionDef):
            continue
        first = node.lineno
        if first - 1 not in facts.own_line:
            continue
        covered = []
        for line in range(first, len(lines) + 1):
            content = lines[line - 1]
            if line in facts.own_line or not content.strip():
                break
            indent = len(content) - len(content.lstrip())
            if indent < node.col_offset:
                break
            covered.append(line)
        facts.blocks[first] = tuple(covered)


def _read_comments(text: str, facts: SourceFacts) -> None:
    try:
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            if token.type == tokenize.COMMENT:
                facts.comments[token.start[0]] = token.string.lstrip("#").strip()
                if not token.line[: token.start[1]].strip():
                    facts.own_line.add(token.start[0])
    except (tokenize.TokenError, IndentationError, SyntaxError):
        pass


class _Reader:
    def __init__(self, facts: SourceFacts) -> None:
        self._facts = facts
        self._documents: set[int] = set()

    def visit_module(self, tree: ast.Module) -> None:
        facts = self._facts
        for node in ast.walk(tree):
            if isinstance(node, ast.Assign):
                for target in node.targets:
                    self._assign(target, node.value, node.lineno)
            elif isinstance(node, ast.AnnAssign) and node.value is not None:
                self._assign(node.target, node.value, node.lineno)
            elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
                if isinstance(node.value.value, str):
                    facts.docstrings.append((node.lineno, node.value.value))
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
        self._functions(tree, "<module>")
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
            return
        name = _name(target)
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
            if line + 1 not in facts.assigned.values():
                note = above
        if note:
            facts.notes.setdefault(name, note)
        rows = list(_rows(value))
        if rows:
            facts.tables.setdefault(name, rows)
        try:
            literal = ast.literal_eval(value)
        except (ValueError, TypeError, SyntaxError, MemoryError, RecursionError):
            return
        facts.constants.setdefault(name, literal)

    def _functions(self, node: ast.AST, function: str) -> None:
        for child in ast.iter_child_nodes(node):
            inside = child.name if isinstance(child, ast.FunctionDef) else function
            if isinstance(child, (ast.For, ast.AsyncFor)):
                for name in _names(child.target):
                    self._facts.loose.add((inside, name))
                    self._facts.loops.add((inside, name))
            elif isinstance(child, ast.comprehension):
                for name in _names(child.target):
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
        labware = _name(base)
        if labware:
            self._place(labware, node.slice, kind, node.lineno)

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
            labware = _name(node.func.value)
            if labware:
                self._place(labware, node.args[0], "well", node.lineno)

    def _arguments(self, node: ast.Call, method: str) -> None:
        """``p20.transfer(2, sample, well)``: wells drawn from are samples, whatever the loop."""
        sides = _ARGUMENTS.get(method, {})
        given = [(sides.get(n), a) for n, a in enumerate(node.args)]
        given += [(sides.get(k.arg), k.value) for k in node.keywords if k.arg]
        for side, value in given:
            while isinstance(value, (ast.Call, ast.Attribute)):
                value = value.func if isinstance(value, ast.Call) else value.value
            if side and isinstance(value, ast.Name):
                self._facts.arguments.setdefault(node.lineno, []).append((side, value.id))

    def _liquid(self, node: ast.Call) -> None:
        values = dict(zip(("name", "description"), (_text(a) for a in node.args), strict=False))
        values.update({k.arg: _text(k.value) for k in node.keywords if k.arg in values or k.arg})
        name, description = values.get("name"), values.get("description")
        if name and description:
            self._facts.liquids.setdefault(name, description)

    def _place(self, labware: str, index: ast.expr, kind: str, line: int) -> None:
        names = tuple(dict.fromkeys(_names(index)))
        if names:
            self._facts.places.append(Place(labware, names, self._value(index), kind, line))

    def _value(self, node: ast.expr) -> Any:
        """The value of an index made of constants and simple arithmetic."""
        if isinstance(node, ast.Constant):
            return node.value
        if isinstance(node, ast.Name):
            return self._facts.constants.get(node.id)
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            value = self._value(node.operand)
            return -value if isinstance(value, int) else None
        if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub)):
            left, right = self._value(node.left), self._value(node.right)
            if isinstance(left, int) and isinstance(right, int):
                return left + right if isinstance(node.op, ast.Add) else left - right
            return None
        if isinstance(node, ast.Slice):
            low = self._value(node.lower) if node.lower else None
            high = self._value(node.upper) if node.upper else None
            given = [(node.lower, low), (node.upper, high)]
            if any(bound is not None and not isinstance(v, int) for bound, v in given):
                return None
            return slice(low, high)
        if isinstance(node, ast.Subscript):
            holder, key = self._value(node.value), self._value(node.slice)
            try:
                return holder[key]
            except (TypeError, KeyError, IndexError):
                return None
        return None


def _rows(value: ast.expr) -> Iterator[tuple[Any, ...]]:
    """The constants that stand in each row of a list of tuples, dicts or calls, or of a dict.

    ``[("NTC", plate["H12"], 5)]`` yields ``("NTC", 5)``: what stands beside the well, but
    not the indices inside an expression.
    """
    if isinstance(value, ast.Dict):
        for key, item in zip(value.keys, value.values, strict=False):
            if key is not None:
                yield tuple(_constants([key, item]))
    elif isinstance(value, (ast.List, ast.Tuple)):
        for element in value.elts:
            if isinstance(element, (ast.Tuple, ast.List)):
                yield tuple(_constants(element.elts))
            elif isinstance(element, ast.Dict):
                yield tuple(_constants(element.values))
            elif isinstance(element, ast.Call):
                yield tuple(_constants([*element.args, *(k.value for k in element.keywords)]))
            else:
                return


def _constants(nodes: Iterable[ast.expr | None]) -> Iterator[Any]:
    for node in nodes:
        if isinstance(node, ast.UnaryOp) and isinstance(node.operand, ast.Constant):
            node = node.operand
        if isinstance(node, ast.Constant) and isinstance(node.value, (str, int, float)):
            yield node.value
        elif isinstance(node, (ast.Tuple, ast.List)):
            yield from _constants(node.elts)


def _name(node: ast.expr) -> str:
    """``plate`` or ``self.plate``, as the last name."""
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute):
        return node.attr
    return ""


def _text(node: ast.expr) -> str:
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else ""


def _names(node: ast.AST) -> Iterator[str]:
    for inner in ast.walk(node):
        if isinstance(inner, ast.Name):
            yield inner.id


def flat_texts(value: Any, depth: int = 0) -> Iterator[str]:
    """Every string inside a literal."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, Mapping) and depth < 4:
        for key, item in value.items():
            yield from flat_texts(key, depth + 1)
            yield from flat_texts(item, depth + 1)
    elif isinstance(value, (list, tuple, set, frozenset)) and depth < 4:
        for item in value:
            yield from flat_texts(item, depth + 1)
