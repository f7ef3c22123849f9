"""Plates drawn in text: column numbers, and under them lines that begin with a letter of a row.

::

          1      2-11     12
    A    DMSO   drug A   medium
    ...
    H    DMSO   drug H   medium
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

_MOST_LINES = 18
"""As many lines have the plates that people draw."""

_NUMBER = re.compile(r"(?:c|col)?(\d{1,2})(?:\s*[-–]\s*(\d{1,2}))?")
_COLUMN_WORD = re.compile(
    r"\b(?:col(?:umn)?s?|spalten?|colonnes?|columnas?|kolom|sp)\.?\s+(?=\d)", re.IGNORECASE
)
_ROW_WORD = re.compile(r"^\s*(?:row|zeile|reihe|ligne|fila|riga|rij)\s+(?=[A-P]\b)", re.IGNORECASE)
_LETTERS = re.compile(r"([A-P])(?:\s*[-–]\s*([A-P]))?:?")
_DOTS = re.compile(r"\.{2,}|…")


class Drawing(NamedTuple):
    """What a drawing says.

    Attributes:
        end: The line after its last one.
        wells_of: The wells of each code, in the order of the rows.
    """

    end: int
    wells_of: dict[str, list[str]]


def drawn_grid(lines: Sequence[str], at: int) -> Drawing:
    """The drawing whose column numbers stand in a line; without wells, if none does.

    Dots stand for more of the same: for columns in a row, for rows under one.
    """
    columns = _columns(lines[at])
    wells_of: dict[str, list[str]] = {}
    end, last, codes, repeated = at + 1, 0, list[str](), False
    for written in lines[at + 1 : at + 1 + _MOST_LINES] if columns else ():
        first, *said = cells_of(_ROW_WORD.sub("", written), len(columns) + 1) or [""]
        if _DOTS.match(first) and codes:
            repeated, end = True, end + 1
            continue
        letters = _LETTERS.fullmatch(first)
        begin = ord(letters[1]) - ord("A") if letters else -1
        filled = _filled(said, len(columns))
        if letters is None and end == at + 1 and written.strip():
            end += 1  # of what each column gets
            continue
        if letters is None or not filled or (begin != last and not (repeated and begin > last)):
            break
        stop = ord(letters[2] or letters[1]) - ord("A") + 1
        for row in range(last, stop):
            for numbers, code in zip(columns, codes if row < begin else filled, strict=True):
                if re.search(r"[^\W\d_]", code):
                    letter = chr(ord("A") + row)
                    wells_of.setdefault(code, []).extend(f"{letter}{n}" for n in numbers)
        last, codes, repeated, end = stop, filled, False, end + 1
    return Drawing(end if wells_of else at, wells_of)


def drawn_lines(lines: Sequence[str]) -> set[int]:
    """Places of the lines that belong to drawings."""
    return {line for at in range(len(lines)) for line in range(at, drawn_grid(lines, at).end)}


def cells_of(written: str, count: int = 0) -> list[str]:
    """The cells of a line; those of several words stand apart by two spaces or by bars.

    What stands further right than the last of them is a remark: "<- gene 1", "uM".
    """
    written = re.split(r"<[-=]|#", written, maxsplit=1)[0].rstrip()
    words = written.replace("|", " ").split()
    if len(words) == count or not count:
        return words
    cells = [cell.strip() for cell in re.split(r"\s{2,}|\|", written.strip(" |"))]
    begun = re.match(rf"((?:\S+\s+){{{count - 1}}}\S+)\s{{2,}}", written.replace("|", " ").strip())
    return begun[1].split() if len(cells) != count and begun else cells


def _columns(written: str) -> list[list[int]]:
    """The columns under each number of a line that counts on from 1: "1  2-11  12"."""
    columns: list[list[int]] = []
    last = 0
    for cell in cells_of(_COLUMN_WORD.sub("", written).lower()):
        match = _NUMBER.fullmatch(cell)
        if match is None or int(match[1]) != last + 1:
            return []
        last = int(match[2] or match[1])
        columns.append(list(range(int(match[1]), last + 1)))
    return columns if len(columns) > 1 and all(columns) else []


def _filled(said: Sequence[str], count: int) -> list[str]:
    """As many codes as columns, those that dots stand for among them; else none."""
    dots = [at for at, code in enumerate(said) if _DOTS.fullmatch(code)]
    if len(dots) == 1 and dots[0] > 0 and len(said) <= count + 1:
        at = dots[0]
        said = [*said[:at], *[said[at - 1]] * (count - len(said) + 1), *said[at + 1 :]]
    return list(said) if len(said) == count else []
