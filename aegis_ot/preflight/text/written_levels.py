"""Amounts that a comment or a docstring lists under the names of what holds them.

As a kit's leaflet does::

    Vial      A     B     C    D
    ug/mL  2000  1500  1000    0 (blank)

    vials: A 2000, B 1500, C 1000 ug/ml, D = diluent only (0)

or a drawing of a plate, with the unit beneath::

         1        2        3
    A  S1 2000  S1 2000  lysate 1
    B  S2 1000  S2 1000  lysate 2
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from ...instrumentation import is_spot
from .comments import comment_blocks
from .facts import SourceFacts
from .levels import UNITS, unit_in, with_u

_FEWEST = 3
_NOTES = re.compile(r"\([^()]*\)")
_NUMBER = re.compile(r"\d+(?:[.,]\d+)?")
_ENTRY = re.compile(
    r"(?:^|[,;|:(]|\s{2})\s*([A-Za-z]\w{0,7})\s*[=:]?\s*(?:[^,;|\d]*\()?(\d+(?:\.\d+)?)"
    rf"(?:\s?({UNITS}))?(?![\w.%])",
    re.IGNORECASE,
)
"""``A 2000``, ``S1 = 0.5``, ``I = diluent only (0)``."""
_ROW = re.compile(r"\s*[A-P]\s*[:|]?\s")
_CELL = re.compile(r"[\s|]([A-Za-z]{1,6}\d{1,2})\s{1,3}(\d+(?:\.\d+)?)(?=\s{2}|\s*(?:\||$))")
"""``S1 2000`` in a row of a drawing."""
_LAST = re.compile(rf"\d\s?({UNITS})\s*(?:\(|$)", re.IGNORECASE)
_NAME = re.compile(r"[A-Za-z][\w+-]{0,15}")
_LONGEST_LINE = 400
"""Characters; `_ENTRY` takes a time that grows with the square of a line's length."""


def read_written_levels(facts: SourceFacts) -> None:
    """Note, by the unit that stands before or after them, the amount under each name."""
    for first, text in (*facts.docstrings, *comment_blocks(facts)):
        lines = with_u(text).splitlines()
        if unit := unit_in(with_u(text)):
            levels = _in_drawing(lines)
            if len(levels) >= _FEWEST:
                facts.levels[f"{unit} of the drawing at line {first}"] = levels
        for at, written in enumerate(lines):
            below = lines[at + 1] if at + 1 < len(lines) else ""
            for unit, levels in (
                _entries(written),
                (_unit_of_row(below), dict(_columns(written, below))),
                (_unit_of_row(written), dict(_columns(below, written))),
            ):
                if unit and len(levels) >= _FEWEST:
                    facts.levels[f"{unit} at line {first + at}"] = levels


def _entries(written: str) -> tuple[str, dict[str, float]]:
    """The unit of a list like "A 2000, B 1500, C 1000 ug/ml", and the amount of each name."""
    entries = _ENTRY.findall(written[:_LONGEST_LINE])
    levels = {name: float(amount) for name, amount, _ in entries}
    units = {unit.lower() for _, _, unit in entries if unit} | {unit_in(written)} - {""}
    placed = any(map(is_spot, levels))
    return ("" if placed or len(units) != 1 else units.pop()), levels


def _in_drawing(lines: Iterable[str]) -> dict[str, float]:
    """The amount beside each name in the cells of a drawn plate, if it is the same everywhere."""
    amounts: dict[str, set[float]] = {}
    for written in lines:
        if _ROW.match(written):
            for name, amount in _CELL.findall(written[:_LONGEST_LINE]):
                amounts.setdefault(name, set()).add(float(amount))
    return {name: told.pop() for name, told in amounts.items() if len(told) == 1}


def _unit_of_row(written: str) -> str:
    """The unit before a row of numbers, or right after the last: not the "nm" of "595 nm"."""
    last = _LAST.search(written)
    return unit_in(written) or (last[1].lower() if last else "")


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
