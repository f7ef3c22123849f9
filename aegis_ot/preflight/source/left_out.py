"""Pipetting steps that stand in a protocol and are not executed: commented out, or switched off."""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Iterator
from typing import NamedTuple

from .facts import SourceFacts

_METHODS = r"(?:transfer\w*|distribute\w*|consolidate\w*|aspirate|dispense)"
_STEP = re.compile(rf"\b\w+\.{_METHODS}\s*\(")
_METHOD = re.compile(_METHODS)
_NAME = re.compile(r"[^\W\d]\w*")
_PLACE = re.compile(r"""(\w+)\s*\[\s*["'](\w+)["']\s*\]""")


class LeftOut(NamedTuple):
    """One such step.

    Attributes:
        line: Where it stands.
        names: The names in it.
        origins: Those that the values of these come from.
        places: Wells that it writes out, each with the labware's name.
    """

    line: int
    names: frozenset[str]
    origins: frozenset[str]
    places: tuple[tuple[str, str], ...]


def steps_left_out(facts: SourceFacts, ran: Collection[int]) -> Iterator[LeftOut]:
    """The steps in comments and free-standing texts, and those on no line that ``ran``."""
    texts = [*facts.comment_blocks(), *facts.docstrings]
    for line, text in texts:
        for at, said in enumerate(text.split("\n")):
            if _STEP.search(said):
                yield _step(line + at, text, facts)
    for call in facts.nodes.of(ast.Call):
        if not (isinstance(call.func, ast.Attribute) and _METHOD.fullmatch(call.func.attr)):
            continue
        if not any(line in ran for line in range(call.lineno, (call.end_lineno or 0) + 1)):
            yield _step(call.lineno, ast.unparse(call), facts)


def _step(line: int, text: str, facts: SourceFacts) -> LeftOut:
    names, origins = frozenset(_NAME.findall(text)), set[str]()
    open_ = list(names)
    while open_:
        for name in facts.flow.comes_from.get(open_.pop(), ()):
            if name not in origins:
                origins.add(name)
                open_.append(name)
    return LeftOut(line, names, frozenset(origins), tuple(_PLACE.findall(text)))
