"""The comments of a protocol, and the statements that each one heads."""

from __future__ import annotations

import ast
import io
import tokenize
from collections.abc import Iterator

from .facts import SourceFacts
from .lines import source_lines, without_gaps
from .literals import last_name


def read_comments(text: str, facts: SourceFacts) -> None:
    """Note every comment, and the lines that hold nothing else."""
    try:
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            if token.type == tokenize.COMMENT:
                said = token.string.lstrip("#")
                facts.comments[token.start[0]] = without_gaps(said.strip())
                facts.indents[token.start[0]] = min(len(said) - len(said.lstrip()), _WIDEST)
                if not token.line[: token.start[1]].strip():
                    facts.own_line.add(token.start[0])
                if token.start[1]:
                    facts.among_code.add(token.start[0])
    except (tokenize.TokenError, IndentationError, SyntaxError):
        pass


_WIDEST = 40
"""Spaces before what a drawing in a comment has on a line."""


def read_blocks(text: str, tree: ast.Module, facts: SourceFacts) -> None:
    """A comment heads the statements below it, up to a blank line or the next comment."""
    lines = source_lines(text)
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


def read_item_notes(tree: ast.Module, facts: SourceFacts) -> None:
    """Note the comments beside the items of a list, where each has a line to itself, and those
    beside the lines of a dict.
    """
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Dict):
            lines = _noted_keys(node.value, facts)
            if len(lines) > 1:
                for name in filter(None, map(last_name, node.targets)):
                    facts.key_notes.setdefault(name, lines)
        if isinstance(node, ast.Assign) and isinstance(node.value, (ast.List, ast.Tuple)):
            ends = [item.end_lineno or item.lineno for item in node.value.elts]
            notes = tuple(facts.comments.get(end, "") for end in ends)
            if len(set(ends)) == len(ends) > 1 and all(notes):
                for name in filter(None, map(last_name, node.targets)):
                    facts.item_notes.setdefault(name, notes)


def _noted_keys(node: ast.Dict, facts: SourceFacts) -> dict[str, tuple[str, ...]]:
    """The comments beside the lines of a dict, all different, with the keys that stand there."""
    keys: dict[int, list[str]] = {}
    for key, value in zip(node.keys, node.values, strict=True):
        one_line = key is not None and key.lineno == value.end_lineno != node.lineno
        if one_line and isinstance(key, ast.Constant) and isinstance(key.value, str):
            keys.setdefault(key.lineno, []).append(key.value)
    notes = [note for line in keys if (note := facts.comments.get(line))]
    if len(set(notes)) != len(notes):
        return {}
    return {
        facts.comments[line]: tuple(held) for line, held in keys.items() if line in facts.comments
    }


def written_lines(facts: SourceFacts) -> Iterator[str]:
    """Each line of the docstrings and of the comments."""
    for _, text in (*facts.docstrings, *comment_blocks(facts)):
        yield from text.splitlines()


def comment_blocks(facts: SourceFacts, indented: bool = False) -> list[tuple[int, str]]:
    """Comments by their first line; those that stand below each other are one text.

    Where they are ``indented``, columns that stand in line do so in that text.
    """
    blocks: dict[int, list[str]] = {}
    first = 0
    for line, said in sorted(facts.comments.items()):
        text = " " * facts.indents.get(line, 0) + said if indented else said
        if line in facts.own_line and line - 1 in facts.own_line:
            blocks[first].append(text)
        else:
            first = line
            blocks[first] = [text]
    return [(line, "\n".join(texts)) for line, texts in blocks.items()]
