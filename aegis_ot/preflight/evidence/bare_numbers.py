"""Levels of a list whose unit is said once: "A1 0, B1 125, C1 250 ug/ml"."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

from ..text import UNITS, amounts_in, concentration_in, tokens, with_u
from .clues import Clue
from .levels import are_amounts

_FEWEST = 3
_ENTRY = re.compile(
    rf"(?P<name>[^\d=:]*)[=:]? ?(?P<number>\d+(?:[.,]\d+)?) ?(?P<unit>{UNITS})?"
    r" ?(?:\([^()\d]*\))?(?:, ?\d+(?:\.\d+)? ?[mu]?l\b[^\d,;]{0,20})?[.,;]?",
    re.IGNORECASE,
)
"""A name, a number, perhaps its unit; the last entry may say the volume of each."""


def with_bare_numbers(clues: Sequence[Clue], text: str) -> Iterator[Clue]:
    """The clues of one text, in which entries of one list that are alike but for a number have
    that as their level: where one of them says the unit, or the text has no other one, and the
    numbers count nothing. Without a unit they may be lots, times or volumes.
    """
    groups: dict[tuple[str, tuple[str, ...]], dict[int, re.Match[str]]] = {}
    for at, clue in enumerate(clues):
        plain = " ".join(with_u(clue.text).split()).lstrip("=: ")
        match = _ENTRY.fullmatch(plain) if not clue.levels and clue.wells else None
        if match:
            key = (clue.wells[0].labware, tokens(match["name"]))
            groups.setdefault(key, {})[at] = match
    elsewhere = {match[2].lower() for match, _ in amounts_in(text) if match[2]}
    levels: dict[int, float] = {}
    for entries in groups.values():
        numbers = {at: float(match["number"].replace(",", ".")) for at, match in entries.items()}
        units = {match["unit"].lower() for match in entries.values() if match["unit"]}
        if not units and are_amounts(numbers.values()):
            units = elsewhere
        if len(set(numbers.values())) >= _FEWEST and len(units) == 1:
            worth = concentration_in(f"1 {units.pop()}") or 1.0
            levels.update((at, type(worth)(number * worth)) for at, number in numbers.items())
    for at, clue in enumerate(clues):
        if at in levels:
            clue = replace(clue, levels=(levels[at],) * len(clue.wells))
            if "(" in clue.text:  # "0 (PBS)" is a level, and says what that is made of
                yield replace(clue, text="")
        yield clue
