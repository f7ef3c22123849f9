"""Levels that a list tells without a unit, or with one for all: "A1 0, B1 125, C1 250 ug/ml"."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

from ..text import UNITS, concentration_in, tokens, with_u
from .clues import Clue
from .levels import are_amounts

_FEWEST = 3
_ENTRY = re.compile(
    r"[\s=:]*(?P<name>[^\d=:]*?)[\s=:]*(?P<number>\d+(?:[.,]\d+)?)\s*"
    rf"(?P<unit>{UNITS})?\s*(?:\([^()\d]*\))?[\s.,;]*",
    re.IGNORECASE,
)


def with_bare_numbers(clues: Sequence[Clue]) -> Iterator[Clue]:
    """The clues of one text, in which entries of one list that are alike but for a number have
    that as their level: where these numbers are amounts, and so count nothing.
    """
    groups: dict[tuple[str, tuple[str, ...]], dict[int, re.Match[str]]] = {}
    for at, clue in enumerate(clues):
        match = _ENTRY.fullmatch(with_u(clue.text)) if not clue.levels and clue.wells else None
        if match:
            key = (clue.wells[0].labware, tokens(match["name"]))
            groups.setdefault(key, {})[at] = match
    levels: dict[int, float] = {}
    for entries in groups.values():
        numbers = {at: float(match["number"].replace(",", ".")) for at, match in entries.items()}
        units = {match["unit"].lower() for match in entries.values() if match["unit"]}
        if len(set(numbers.values())) < _FEWEST or len(units) > 1:
            continue
        if units or are_amounts(numbers.values()):
            worth = concentration_in(f"1 {units.pop()}") if units else 1.0
            levels.update((at, number * (worth or 1.0)) for at, number in numbers.items())
    for at, clue in enumerate(clues):
        if at in levels:
            clue = replace(clue, levels=(levels[at],) * len(clue.wells))
            if "(" in clue.text:  # "0 (PBS)" is a level, and says what that is made of
                yield replace(clue, text="")
        yield clue
