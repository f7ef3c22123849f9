"""Plates drawn in text: column numbers, and under them lines that begin with a letter of a row.

::

          1      2-11     12
    A    DMSO   drug A   medium
    ...
    H    DMSO   drug H   medium
"""

from __future__ import annotations

import functools
import re
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from .well_names import WellNames

_MOST_LINES = 18
"""As many lines have the plates that people draw."""

_NUMBER = re.compile(r"(?:c|col)?(\d{1,2})(?:\s*[-–]\s*(\d{1,2}))?")
_LETTERS = re.compile(r"([A-P])(?:\s*[-–]\s*([A-P]))?:?")
_AMOUNT = re.compile(r"\d+(?:[.,]\d+)?")
_DOTS = re.compile(r"\.{2,}|…")


class Drawing(NamedTuple):
    """What a drawing says.

    Attributes:
        end: The line after its last one.
        wells_of: The wells of each code, in the order of the rows.
        numbers: The wells of each number that stands in a cell alone.
    """

    end: int
    wells_of: dict[str, list[str]]
    numbers: dict[str, list[str]]


def drawn_grid(lines: Sequence[str], at: int, names: WellNames) -> Drawing:
    """The drawing whose column numbers stand in a line; without wells, if none does.

    Dots stand for more of the same: for columns in a row, for rows under one. A part of a plate
    may be drawn, where the columns are called so, "col 3   col 4", or each row fills them all.
    """
    column_word, row_word = _before_numbers(names)
    without_corner = _corner(names).sub(_blanked, lines[at])
    header = column_word.sub(_blanked, without_corner)
    of_a_part = header != without_corner
    columns = _columns(header, of_a_part)
    if not columns and (part := _columns(header, True)):
        of_a_part = _are_filled(lines[at + 1 : at + 3], len(part), row_word)
        columns = part if of_a_part else []
    heads = list(re.finditer(r"\S+", header))[: len(columns)]
    middles = [(head.start() + head.end()) / 2 for head in heads]
    wells_of: dict[str, list[str]] = {}
    numbers_of: dict[str, list[str]] = {}
    end, last, codes, repeated = at + 1, 0, list[str](), False
    for written in lines[at + 1 : at + 1 + _MOST_LINES] if columns else ():
        plain = row_word.sub(_blanked, written)
        first, *said = _under(plain, middles) or cells_of(plain, len(columns) + 1) or [""]
        if _DOTS.match(first) and codes:
            repeated, end = True, end + 1
            continue
        letters = _LETTERS.fullmatch(first)
        begin = ord(letters[1]) - ord("A") if letters else -1
        last = begin if of_a_part and not wells_of and letters else last
        filled = _filled(said, len(columns))
        if letters and (not filled or _ends_right_of(plain, heads[-1].end())):
            filled = _sparse(plain, middles) or filled
        if letters is None and end == at + 1 and written.strip():
            end += 1  # of what each column gets
            continue
        if letters is None or not filled or (begin != last and not (repeated and begin > last)):
            break
        stop = ord(letters[2] or letters[1]) - ord("A") + 1
        for row in range(last, stop):
            for numbers, code in zip(columns, codes if row < begin else filled, strict=True):
                codes_of = numbers_of if _AMOUNT.fullmatch(code) else wells_of
                if codes_of is numbers_of or re.search(r"[^\W\d_]", code):
                    letter = chr(ord("A") + row)
                    codes_of.setdefault(code, []).extend(f"{letter}{n}" for n in numbers)
        last, codes, repeated, end = stop, filled, False, end + 1
    return Drawing(end if wells_of else at, wells_of, numbers_of)


def drawn_lines(lines: Sequence[str], names: WellNames) -> set[int]:
    """Places of the lines that belong to drawings."""
    drawings = ((at, drawn_grid(lines, at, names)) for at in range(len(lines)))
    found = {line for at, drawing in drawings for line in range(at, drawing.end)}
    return found.union(*(_ragged_rows(lines, at, names) for at in range(len(lines))))


def _ragged_rows(lines: Sequence[str], at: int, names: WellNames) -> set[int]:
    """Places of the lines below "col 2   3   4      8" that begin with a row and have a gap.

    What stands after the gap is of the columns above it, and not of the whole row; but for one
    phrase below several of them.
    """
    column_word, row_word = _before_numbers(names)
    header = column_word.sub(_blanked, lines[at])
    numbers = re.findall(r"\d+", header) if header != lines[at] else []
    apart = len(re.findall(r"\d\s{2,}(?=\d)", header)) >= _FEWEST_COLUMNS - 1
    if not apart or any(int(a) >= int(b) for a, b in pairwise(numbers)):
        return set()
    second = [head.end() for head in re.finditer(r"\S+", header)][1]
    below = range(at + 1, min(at + 1 + _MOST_LINES, len(lines)))
    return {
        line
        for line in below
        if row_word.match(lines[line])
        and len(cells := _GAP.split(lines[line].strip())) > 1
        and not (
            len(cells) == 2
            and _LETTERS.fullmatch(row_word.sub("", cells[0]))
            and len(lines[line].rstrip()) > second
        )
    }


_FEWEST_COLUMNS = 3
_GAP = re.compile(r"(?<=\S)\s{3,}(?=\S)")


@functools.lru_cache(maxsize=8)
def _before_numbers(names: WellNames) -> tuple[re.Pattern[str], re.Pattern[str]]:
    """The words in "col 1   col 2" and in "row A   DMSO", as patterns."""
    column = rf"\b{names.any_column}\.?\s+(?=\d)"
    return re.compile(column), re.compile(rf"^\s*{names.row}\s+(?=[A-P]\b)")


@functools.lru_cache(maxsize=8)
def _corner(names: WellNames) -> re.Pattern[str]:
    """What a line of column numbers may begin with, above the letters of the rows: "row", "#"."""
    return re.compile(rf"^\s*(?:{names.row}(?:\s*[/\\]\s*{names.column})?|[^\w\s|]+)\s+(?=\d)")


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


def _blanked(match: re.Match[str]) -> str:
    """As many spaces, so that what stands in line stays there."""
    return " " * len(match.group())


def _under(written: str, middles: Sequence[float]) -> list[str]:
    """The letter of a row, and the words under each column where some cells have several.

    Only where spaces alone do not tell the cells apart, and nothing stands beside the columns.
    """
    spans = list(re.finditer(r"\S+", written))
    count = len(middles) + 1
    if len(spans) <= count or "|" in written or len(re.split(r"\s{2,}", written.strip())) == count:
        return []
    cells, all_placed = _by_columns(spans[1:], middles)
    return [spans[0].group(), *cells] if all_placed and all(cells) else []


def _by_columns(spans: Sequence[re.Match[str]], middles: Sequence[float]) -> tuple[list[str], bool]:
    """The words under each column, and whether all of them stand there.

    What stands right of all columns is left out; no cells where a word stands between two.
    """
    half = min(later - middle for middle, later in pairwise(middles)) / 2
    cells, all_placed = [""] * len(middles), True
    for span in spans:
        at = (span.start() + span.end()) / 2
        nearest = min(range(len(middles)), key=lambda column: abs(middles[column] - at))
        if abs(middles[nearest] - at) <= half:
            cells[nearest] = f"{cells[nearest]} {span.group()}".strip()
        elif at < middles[-1]:
            return [], False
        else:
            all_placed = False
    return cells, all_placed


def _ends_right_of(written: str, end: int) -> bool:
    """Whether the last word of a line begins right of all columns: a remark."""
    return len(written.rstrip()) - len(written.split()[-1]) > end


def _sparse(written: str, middles: Sequence[float]) -> list[str]:
    """The words under each column where some are left empty; what stands right of all is a remark.

    None where a word stands between two columns.
    """
    cells, _ = _by_columns(list(re.finditer(r"[^\s|]+", written))[1:], middles)
    return cells if sum(map(bool, cells)) > 1 else []


def _columns(written: str, of_a_part: bool) -> list[list[int]]:
    """The columns under each number of a line that counts on from 1: "1  2-11  12".

    Or that rises, where it is said that these are columns, ``of_a_part`` of a plate.
    """
    columns: list[list[int]] = []
    last = 0
    for cell in cells_of(written.lower()):
        match = _NUMBER.fullmatch(cell)
        number = int(match[1]) if match else 0
        if match is None or not (number == last + 1 or (of_a_part and number > last)):
            return []
        last = int(match[2] or match[1])
        columns.append(list(range(int(match[1]), last + 1)))
    return columns if len(columns) > 1 and all(columns) else []


def _are_filled(rows: Sequence[str], count: int, row_word: re.Pattern[str]) -> bool:
    """Whether two rows in order follow, of as many cells as there are columns, three at least."""
    if count < _FEWEST_COLUMNS or len(rows) < _FEWEST_ROWS:
        return False
    cells = [cells_of(row_word.sub(_blanked, row), count + 1) for row in rows]
    begins = [letter[1] for row in cells if row and (letter := _LETTERS.fullmatch(row[0]))]
    in_order = len(begins) == len(rows) and begins[0] < begins[1]
    return in_order and all(_filled(row[1:], count) for row in cells)


_FEWEST_ROWS = 2


def _filled(said: Sequence[str], count: int) -> list[str]:
    """As many codes as columns, those that dots stand for among them; else none."""
    dots = [at for at, code in enumerate(said) if _DOTS.fullmatch(code)]
    if len(dots) == 1 and dots[0] > 0 and len(said) <= count + 1:
        at = dots[0]
        said = [*said[:at], *[said[at - 1]] * (count - len(said) + 1), *said[at + 1 :]]
    return list(said) if len(said) == count else []
