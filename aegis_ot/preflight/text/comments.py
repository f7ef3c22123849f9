"""The comments of a protocol, and the statements that each one heads."""

from __future__ import annotations

import ast
import io
import tokenize

from .facts import SourceFacts
from .lines import source_lines, without_gaps


def read_comments(text: str, facts: SourceFacts) -> None:
    """Note every comment, and the lines that hold nothing else."""
    try:
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            if token.type == tokenize.COMMENT:
                facts.comments[token.start[0]] = without_gaps(token.string.lstrip("#").strip())
                if not token.line[: token.start[1]].strip():
                    facts.own_line.add(token.start[0])
    except (tokenize.TokenError, IndentationError, SyntaxError):
        pass


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
