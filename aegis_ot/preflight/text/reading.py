"""From a protocol's text to its facts."""

from __future__ import annotations

import ast

from .comments import read_blocks, read_comments, read_item_notes
from .facts import SourceFacts
from .flow import read_flow
from .functions import read_functions
from .numbered import read_numbered
from .records import read_records
from .syntax import SyntaxReader
from .written_levels import read_written_levels


def read_source(text: str) -> SourceFacts:
    """Read a protocol's text. Text that does not parse yields what its comments say."""
    facts = SourceFacts()
    read_comments(text, facts)
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):
        return facts
    SyntaxReader(facts).visit_module(tree)
    read_records(tree, facts)
    read_written_levels(facts)
    read_flow(tree, facts)
    read_numbered(tree, facts)
    read_blocks(text, tree, facts)
    read_item_notes(tree, facts)
    read_functions(tree, facts)
    return facts
