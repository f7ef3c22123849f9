"""Amounts that a comment or a docstring lists under the names of what holds them.

As a kit's leaflet does::

    Vial      A     B     C    D
    ug/mL  2000  1500  1000    0 (blank)
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

from .comments import comment_blocks
from .facts import SourceFacts
from .levels import unit_in

_FEWEST = 3
_NOTES = re.compile(r"\([^()]*\)")
_NUMBER = re.compile(r"\d+(?:[.,]\d+)?")
_NAME = re.compile(r"[A-Za-z][\w+-]{0,15}")


def read_written_levels(facts: SourceFacts) -> None:
    """Note, by the unit that stands before or after them, the amount under each name."""
    for _, text in (*facts.docstrings, *comment_blocks(facts)):
        for upper, lower in pairwise(text.splitlines()):
            for names, numbers in ((upper, lower), (lower, upper)):
                unit = unit_in(numbers)
                if unit and (levels := dict(_columns(names, numbers))):
                    facts.levels.setdefault(unit, levels)


def _columns(names: str, numbers: str) -> Iterator[tuple[str, float]]:
    """Each name with the number under it, if there are as many of both, all different."""
    cells = _NOTES.sub(" ", numbers).replace("|", " ").split()
    amounts = [cell for cell in cells if _NUMBER.fullmatch(cell)]
    listed = [name for name in _NOTES.sub(" ", names).replace("|", " ").split() if name != ":"]
    keys = listed[-len(amounts) :] if 0 <= len(listed) - len(amounts) <= 2 else []
    if len(set(keys)) != len(amounts) or len(amounts) < _FEWEST:
        return
    if all(map(_NAME.fullmatch, keys)):
        for key, amount in zip(keys, amounts, strict=True):
            yield key, float(amount.replace(",", "."))
