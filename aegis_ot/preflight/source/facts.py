"""What the text of a protocol says as Python: comments, docstrings, names, and how they flow.

The rehearsal knows which wells were used and which names held them. The text adds what no run
can show: what was written beside the code, and which labware is indexed with what.
"""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice
from typing import TypeGuard

from .data_flow import Flow, read_flow
from .nodes import LOOPS, Nodes

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
        passing: Names that hold many things in turn: parameters of functions, and what loops bind
            anew in each turn, their variables among them.
        tree: The parsed text, empty where it is none.
        nodes: All its nodes by kind.
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
    passing: set[tuple[str, str]] = field(default_factory=set)
    tree: ast.Module = field(default_factory=lambda: ast.Module([], []), repr=False)

    @cached_property
    def nodes(self) -> Nodes:
        return Nodes(self.tree)

    @cached_property
    def flow(self) -> Flow:
        return read_flow(self.nodes)

    def comment_blocks(self) -> list[tuple[int, str]]:
        """Comments by their first line; those that stand below each other are one text."""
        blocks: list[tuple[int, list[str]]] = []
        for line, said in sorted(self.comments.items()):
            if line in self.own_line and line - 1 in self.own_line:
                blocks[-1][1].append(said)
            else:
                blocks.append((line, [said]))
        return [(line, "\n".join(texts)) for line, texts in blocks]


def read_source(text: str) -> SourceFacts:
    """Read a protocol's text. Text that does not parse yields what its comments say."""
    facts = SourceFacts()
    _read_comments(text, facts)
    try:
        facts.tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError):
        return facts
    _read_strings(facts)
    _read_names(facts)
    _read_scopes(facts)
    return facts


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


def _read_strings(facts: SourceFacts) -> None:
    documents: set[int] = set()
    for statement in facts.nodes.of(ast.Expr):
        if _is_text(statement.value):
            facts.docstrings.append((statement.value.lineno, str(statement.value.value)))
            documents.add(id(statement.value))
    others = (n for n in facts.nodes.of(ast.Constant) if _is_text(n) and id(n) not in documents)
    facts.strings += [(node.lineno, str(node.value)) for node in islice(others, _MOST_TEXTS)]
    for assignment in facts.nodes.of(ast.Assign):
        named = {target.id for target in assignment.targets if isinstance(target, ast.Name)}
        if "metadata" in named and isinstance(assignment.value, ast.Dict):
            for key, value in zip(assignment.value.keys, assignment.value.values, strict=True):
                if _is_text(key) and _is_text(value):
                    facts.metadata[str(key.value)] = str(value.value)


def _read_names(facts: SourceFacts) -> None:
    for name in facts.nodes.of(ast.Name):
        facts.names.add(name.id)
        if isinstance(name.ctx, ast.Store):
            facts.assigned.setdefault(name.id, name.lineno)
    for attribute in facts.nodes.of(ast.Attribute):
        if isinstance(attribute.ctx, ast.Store):
            line = facts.assigned.get(attribute.attr, attribute.lineno)
            facts.assigned[attribute.attr] = min(line, attribute.lineno)
    facts.names |= {node.name for node in facts.nodes.of(ast.FunctionDef)}
    facts.names |= {node.name for node in facts.nodes.of(ast.ClassDef)}


def _is_text(node: ast.AST | None) -> TypeGuard[ast.Constant]:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def _read_scopes(facts: SourceFacts) -> None:
    """Which names loops give many values, and which ones calls do, by the function they are in."""
    for given, function, _ in facts.nodes.placed(ast.arguments):
        for argument in (*given.posonlyargs, *given.args, *given.kwonlyargs):
            facts.passing.add((function, argument.arg))
    for loop, inside, _ in facts.nodes.placed(*LOOPS):
        targets = (node for node in ast.walk(loop.target) if isinstance(node, ast.Name))
        facts.varying |= {(inside, target.id) for target in targets}
    for name, _, looping in facts.nodes.placed(ast.Name):
        if looping and isinstance(name.ctx, ast.Store):
            facts.passing |= {(outer, name.id) for outer in looping}


def source_lines(text: str) -> list[str]:
    """Split at ends of lines. ``str.splitlines`` would also split at form feeds and the like,
    which Python does not count: all later findings would show a wrong line."""
    lines = re.split(r"\r\n|\r|\n", text)
    return lines[:-1] if lines[-1] == "" else lines
