"""Rows that stand under a heading of columns, one on a line, or several that are called so::

Column 1 of the plate:
  A-F  samples
  G    positive control
  H    no template

Columns 4, 8, controls of the assay on their left:
  rows A-D standard, rows E-H no template

Or behind it in brackets: "column 2 vehicle (rows A-B DMSO, rows C-D ethanol)".
"""

from __future__ import annotations

import functools
import re

from ..text import tokens
from .well_names import WellNames

_FEWEST = 2
"""One line may begin with "A" for any reason."""


def under_columns(text: str, names: WellNames) -> str:
    """The text with wells in place of such letters: "A1-F1  samples".

    Below a heading one empty line may stand.
    """
    heading, entry, row = _patterns(names)
    text = _bracketed(names).sub(lambda match: _crossed(match, row, names), text)
    lines = text.split("\n")
    for at, line in enumerate(lines):
        head = heading.search(line)
        if head is None:
            continue
        under: dict[int, str] = {}
        last, count = "", 0
        for below, written in enumerate(lines[at + 1 :], at + 1):
            if below == at + 1 and not written.strip():
                continue  # an empty line may set the heading apart
            rows = list(row.finditer(written))
            begins = bool(rows) and not tokens(written[: rows[0].start()])
            entries = rows if begins else list(entry.finditer(written))
            first = entries[0] if entries else None
            if first is None or tokens(written[: first.start()]) or first["low"] <= last:
                break
            # "A  sample 1     E  sample 5": the letters go on down either side.
            last, count = first["high"] or first["low"], count + len(entries)
            for match in reversed(entries):
                wells = names.crossed(match["low"], match["high"] or "", head["columns"])
                written = written[: match.start("at")] + wells + written[match.end("at") :]
            under[below] = written
        if count >= _FEWEST:
            for below, written in under.items():
                lines[below] = written
    return "\n".join(lines)


def _crossed(match: re.Match[str], row: re.Pattern[str], names: WellNames) -> str:
    """A clause of columns with the rows in its brackets as wells of these columns.

    One row alone may be an exception of all columns: "(row A untreated)".
    """
    wells, count = row.subn(
        lambda m: names.crossed(m["low"], m["high"] or "", match["columns"]), match["rows"]
    )
    return f"{match['clause']}({wells})" if count > 1 else match[0]


def _columns(names: WellNames) -> str:
    """A pattern for "columns 4, 8"."""
    span = rf"\d{{1,2}}(?:{names.to}\d{{1,2}})?"
    listed = rf"(?P<columns>{span}(?:{names.conjunction}{span})*)(?!\w)"
    return rf"{_column_word(names)}{listed}"


def _column_word(names: WellNames) -> str:
    return rf"\b{names.any_column}\.?\s*"


@functools.lru_cache(maxsize=8)
def _bracketed(names: WellNames) -> re.Pattern[str]:
    """A clause of columns with a bracket behind it that begins with a row."""
    return re.compile(
        rf"(?P<clause>{_columns(names)}(?:(?!{_column_word(names)}\d)[^()\n]){{0,120}})"
        rf"\((?P<rows>{names.any_row}\s+[A-P]\b[^()\n]*)\)"
    )


@functools.lru_cache(maxsize=8)
def _patterns(names: WellNames) -> tuple[re.Pattern[str], re.Pattern[str], re.Pattern[str]]:
    """A heading, which ends with a colon, and an entry under it, without or with "row"."""
    heading = rf"{_columns(names)}[^:\d]{{0,40}}:\s*$"
    letters = rf"(?P<low>[A-P])(?:(?:{names.to}|\s?[/&]\s?)(?P<high>[A-P]))?(?![\w.])"
    entry = rf"(?:^\W*|(?<=\s\s\s))(?P<at>{letters})(?=\s*[:=]|\s+\S)"
    row = rf"(?P<at>\b{names.any_row}\s+{letters})"
    return re.compile(heading), re.compile(entry), re.compile(row)
