"""What the text of a protocol says as Python: comments, docstrings, names, and how they flow.

The rehearsal knows which wells were used and which names held them. The text adds what no run
can show: what was written beside the code, and which labware is indexed with what.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeGuard

from .data_flow import Flow, read_flow

_LOOPS = (ast.For, ast.AsyncFor, ast.comprehension)

_MOST_TEXTS = 2000
"""A protocol that carries its data in strings says nothing more of itself after so many."""

_TEXT_OR_COMMENT = re.compile(
    r'''"""(?:\\.|[^\\])*?"""|\'{3}(?:\\.|[^\\])*?\'{3}|"(?:\\.|[^"\\\n])*"|'''
    r"""'(?:\\.|[^'\\\n])*'|#[^\n]*""",
    re.DOTALL,
)
"""Python's own tokenizer takes a third of the time that reading a text takes."""


@dataclass
class SourceFacts:
    """The facts of one protocol text.

    Attributes:
        comments: Comment text by line.
        own_line: Lines that hold nothing but a comment.
        docstrings: Docstrings and other free-standing strings, with their first line.
        metadata: Values of the ``metadata`` dict that are text.
        names: Every identifier of the text, once.
        strings: Every other string of the text, with its line.
        assigned: Line of the first assignment of each name.
        varying: Names that are loop variables, as ``(function, name)``.
        rebound: Names that loops bind anew in each turn, these among them.
        parameters: Names that are parameters of functions, as ``(function, name)``.
        nodes: The parsed text in reading order, without operators and annotations.
        flow: Which names the values of a name come from, and which labware they index.
    """

    comments: dict[int, str] = field(default_factory=dict)
    own_line: set[int] = field(default_factory=set)
    docstrings: list[tuple[int, str]] = field(default_factory=list)
    metadata: dict[str, str] = field(default_factory=dict)
    names: set[str] = field(default_factory=set)
    strings: list[tuple[int, str]] = field(default_factory=list)
    assigned: dict[str, int] = field(default_factory=dict)
    varying: set[tuple[str, str]] = field(default_factory=set)
    rebound: set[tuple[str, str]] = field(default_factory=set)
    parameters: set[tuple[str, str]] = field(default_factory=set)
    nodes: list[ast.AST] = field(default_factory=list, repr=False)

    @cached_property
    def flow(self) -> Flow:
        return read_flow(self.nodes)

    def comment_blocks(self) -> list[tuple[int, str]]:
        """Comments by their first line; those that stand below each other are one text."""
        blocks: dict[int, list[str]] = {}
        first = 0
        for line, said in sorted(self.comments.items()):
            if line in self.own_line and line - 1 in self.own_line:
                blocks[first].append(said)
            else:
                first = line
                blocks[first] = [said]
        return [(line, "\n".join(texts)) for line, texts in blocks.items()]


def read_source(text: str) -> SourceFacts:
    """Read a protocol's text. Text that does not parse yields what its comments say."""
    facts = SourceFacts()
    _read_comments(text, facts)
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError):
        return facts
    placed = _in_reading_order(tree)
    facts.nodes = [node for node, _, _ in placed]
    _read_nodes(facts)
    _read_scopes(placed, facts)
    return facts


_Placed = tuple[ast.AST, str, tuple[str, ...]]
"""A node, the function that it is in, and those around it in which loops enclose it."""

_PLAIN_FIELDS = frozenset({"ctx", "op", "ops", "kind", "type_comment", "returns", "annotation"})
"""What holds operators and types: nearly half of all nodes, and nothing is read from them."""


def _in_reading_order(tree: ast.AST) -> list[_Placed]:
    """Every node that says something, once: the walk takes longer than what is read from it."""
    found: list[_Placed] = []
    open_: list[_Placed] = [(tree, "<module>", ())]
    while open_:
        placed = open_.pop()
        found.append(placed)
        node, function, looping = placed
        if isinstance(node, (ast.FunctionDef, ast.Lambda)):
            function = _name_of(node)
        elif isinstance(node, _LOOPS):
            looping = (*looping, function)
        open_ += [(child, function, looping) for child in reversed(_children(node))]
    return found


def _children(node: ast.AST) -> list[ast.AST]:
    children: list[ast.AST] = []
    for name in node._fields:
        if name not in _PLAIN_FIELDS:
            value = getattr(node, name, None)
            if isinstance(value, ast.AST):
                children.append(value)
            elif isinstance(value, list):
                children += [child for child in value if isinstance(child, ast.AST)]
    return children


def _name_of(function: ast.FunctionDef | ast.Lambda) -> str:
    return function.name if isinstance(function, ast.FunctionDef) else "<lambda>"


def _read_comments(text: str, facts: SourceFacts) -> None:
    line, at = 1, 0
    for found in _TEXT_OR_COMMENT.finditer(text):
        start = found.start()
        if text[start] == "#":
            line += text.count("\n", at, start)
            at = start
            facts.comments[line] = found[0].lstrip("#").strip()
            if not text[text.rfind("\n", 0, start) + 1 : start].strip():
                facts.own_line.add(line)


def _read_nodes(facts: SourceFacts) -> None:
    documents: set[int] = set()
    for node in facts.nodes:
        if isinstance(node, ast.Expr) and _is_text(node.value):
            facts.docstrings.append((node.value.lineno, str(node.value.value)))
            documents.add(id(node.value))
        elif isinstance(node, ast.Name):
            facts.names.add(node.id)
            if isinstance(node.ctx, ast.Store):
                facts.assigned.setdefault(node.id, node.lineno)
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            facts.assigned.setdefault(node.attr, node.lineno)
        elif isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            facts.names.add(node.name)
        elif _is_text(node) and id(node) not in documents and len(facts.strings) < _MOST_TEXTS:
            facts.strings.append((node.lineno, str(node.value)))
        if isinstance(node, ast.Assign) and _is_metadata(node):
            facts.metadata.update(_texts_of(node.value))


def _is_text(node: ast.AST) -> TypeGuard[ast.Constant]:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def _is_metadata(node: ast.Assign) -> bool:
    return any(isinstance(target, ast.Name) and target.id == "metadata" for target in node.targets)


def _texts_of(value: ast.expr) -> Mapping[str, str]:
    if not isinstance(value, ast.Dict):
        return {}
    return {
        key.value: item.value
        for key, item in zip(value.keys, value.values, strict=True)
        if isinstance(key, ast.Constant)
        and isinstance(key.value, str)
        and isinstance(item, ast.Constant)
        and isinstance(item.value, str)
    }


def _read_scopes(placed: Iterable[_Placed], facts: SourceFacts) -> None:
    """Which names loops give many values, and which ones calls do, by the function they are in."""
    for node, function, looping in placed:
        if isinstance(node, (ast.FunctionDef, ast.Lambda)):
            inside, given = _name_of(node), node.args
            for argument in (*given.posonlyargs, *given.args, *given.kwonlyargs):
                facts.parameters.add((inside, argument.arg))
        elif isinstance(node, _LOOPS):
            facts.varying |= {(function, name) for name in names_in(node.target)}
        elif looping and isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            facts.rebound |= {(outer, node.id) for outer in looping}


def names_in(node: ast.AST) -> set[str]:
    """Every name that stands anywhere in an expression."""
    return {inner.id for inner in ast.walk(node) if isinstance(inner, ast.Name)}
