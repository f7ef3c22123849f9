"""Lists of rows or columns whose lines leave the word out: "A  lot 1", "3-6   doxorubicin"."""

from __future__ import annotations

import functools
import re

from ..rules import Common
from ..text import tokens, words_of
from .headed_columns import under_columns
from .well_names import WellNames, well_names

_FEWEST_LISTED = 3
_FILE = re.compile(r"\w\.[a-z]{3,4}\b(?!\s+[a-z])")
_COLUMN_NUMBERS = re.compile(r"(?m)^\W*1\W+2\b[\s\d|]*$")


def with_rows(text: str, common: Common) -> str:
    """A text with "row" before each letter of its lists of rows, as under "Map (row: content)".

    And with "columns" before the numbers of its lists of columns, one on a line.
    """
    names = well_names(common)
    read, text = _bare_lists(names), under_columns(text, names)
    paragraphs = re.split(r"(\n\s*\n)", text)
    on_paper = words_of(common.on_paper)  # "rows A to C of the sheet"
    said = "\n".join(line for line in text.split("\n") if on_paper.isdisjoint(tokens(line)))
    return "".join(read.with_columns(read.with_rows(each, said)) for each in paragraphs)


class BareLists:
    """Patterns for such lists, and for what says that they are lists of rows or columns."""

    def __init__(self, names: WellNames) -> None:
        self._names = names
        to, listing = names.to, names.conjunction
        column, row = names.any_column, names.any_row
        self._lettered = re.compile(r"(?m)(?:^[^\S\n]*|(?<=\s\s))([A-P])(?=\s{1,4}[:=]?\s*\w)")
        self._row_word = re.compile(rf"\b{row}\b")
        self._row_said = re.compile(rf"\b{row}\s+(?:[A-P]{to})?([A-P])\b")
        self._column_word = re.compile(rf"\b{column}\b")
        self._all_columns = re.compile(rf"(?m)^\W*1{to}(?:\d{{1,2}})\W*$")
        span = rf"\d{{1,2}}(?:{to}\d{{1,2}})?"
        self._listed = re.compile(
            rf"(?m)^(\s*)({span}(?:{listing}{span})*)"
            r"(?=\s*:\s|\s{2,}(?:[^\W\d]|\d[\d.]*\s?[pnuµm]?[Mg]\b))"
        )

    def with_rows(self, paragraph: str, text: str) -> str:
        """A paragraph of a text, see :func:`with_rows`: "A  lot 1   B  lot 2" has two entries.

        The paragraph says "row", or the text says it of the list's last letter: "rows A-D get ...".
        """
        letters = [match[1] for match in self._lettered.finditer(paragraph)]
        counting = [chr(ord("A") + at) for at in range(len(letters))]
        if len(letters) < _FEWEST_LISTED or letters != counting:
            return paragraph
        said = self._row_word.search(paragraph) or letters[-1] in self._row_said.findall(text)
        headed = said or self._all_columns.search(paragraph)
        if _FILE.search(paragraph):
            return paragraph  # "A  map.csv"
        if not headed or self._names.spec.search(paragraph):
            return paragraph
        if _COLUMN_NUMBERS.search(paragraph):
            return paragraph  # drawn as a plate, see :mod:`..evidence.prose_grids`
        row = self._names.first_word_of["row"]
        return self._lettered.sub(lambda match: f" {row} {match[1]} ", paragraph)

    def with_columns(self, paragraph: str) -> str:
        """A paragraph: under "Column layout" a list of "3-6   doxorubicin"."""
        heading, *lines = paragraph.strip("\n").splitlines() or [""]
        said = any(map(self._names.spec.search, lines))
        columns = (
            match["column"] or match["columns"] for match in self._names.spec.finditer(heading)
        )
        said = said or any(columns)  # "by column, rows B to G" heads a list
        if said or len(self._listed.findall(paragraph)) < _FEWEST_LISTED:
            return paragraph
        if not self._column_word.search(paragraph):
            return paragraph
        plural = self._names.plural_columns
        return self._listed.sub(lambda match: f"{match[1]}{plural} {match[2]}", paragraph)


@functools.lru_cache(maxsize=8)
def _bare_lists(names: WellNames) -> BareLists:
    return BareLists(names)
