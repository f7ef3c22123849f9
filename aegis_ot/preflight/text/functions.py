"""Which function of the protocol each line belongs to."""

from __future__ import annotations

import ast

from .facts import SourceFacts


def read_functions(tree: ast.Module, facts: SourceFacts) -> None:
    """Note the innermost function around each line, without its decorators."""
    for node in ast.walk(tree):  # those within others come later
        if isinstance(node, ast.FunctionDef):
            for line in range(node.lineno, (node.end_lineno or node.lineno) + 1):
                facts.within[line] = (node.name, node.lineno)
