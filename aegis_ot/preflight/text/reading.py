"""From a protocol's text to its facts."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Mapping
from typing import Any

from .comments import read_blocks, read_comments, read_item_notes
from .facts import SourceFacts
from .flow import read_flow
from .functions import read_functions
from .leaders import read_leaders
from .numbered import read_numbered
from .records import read_records
from .syntax import SyntaxReader
from .written_levels import read_written_levels


def read_source(text: str, parameters: Mapping[str, Any] | None = None) -> SourceFacts:
    """Read a protocol's text. Text that does not parse yields what its comments say.

    Args:
        text: The source.
        parameters: Values of its runtime parameters, which count as constants.
    """
    facts = SourceFacts()
    read_comments(text, facts)
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):
        return facts
    SyntaxReader(facts, parameters or {}).visit_module(tree)
    read_leaders(facts)
    read_records(tree, facts)
    read_written_levels(facts)
    read_flow(tree, facts)
    read_numbered(tree, facts)
    read_blocks(text, tree, facts)
    read_item_notes(tree, facts)
    read_functions(tree, facts)
    _unsay_crowded_lines(tree, facts)
    return facts


_DRAWING = frozenset({"aspirate", "transfer", "distribute", "consolidate"})


def _unsay_crowded_lines(tree: ast.Module, facts: SourceFacts) -> None:
    """Forget what several steps on one line draw and give: which of them is which is not known.

    The trace tells lines apart, and not the statements between semicolons.
    """
    steps = Counter(
        node.lineno
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Attribute)
        and node.func.attr in _DRAWING
    )
    for line, count in steps.items():
        if count > 1:
            facts.arguments.pop(line, None)
            facts.draws.pop(line, None)
