"""Lines of a text that go on in the next one."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from ..rules import Common
from ..text import words_of
from .well_names import well_names


def whole_lines(lines: Sequence[str], common: Common) -> Iterator[tuple[int, str]]:
    """Lines by number; one that ends with "in" or the like goes on in the next.

    Not where both begin with wells of their own: "1-2 untreated, nothing goes in". A list behind
    a heading goes on where a comma ends the line and a well begins the next one.
    """
    leading = words_of((*common.joints, *common.toward))
    spec = well_names(common).spec
    begun, first = "", 0
    for number, line in enumerate(lines):
        first = first if begun else number
        begun = f"{begun} {line.strip()}" if begun else line
        goes_on = begun.rstrip().rpartition(" ")[2].lower() in leading and number + 1 < len(lines)
        if goes_on and spec.match(begun.lstrip()):
            goes_on = spec.match(lines[number + 1].lstrip()) is None
        elif begun.rstrip().endswith(",") and number + 1 < len(lines):
            entries = begun.partition(":")[2].lstrip()
            listed = ":" not in entries and spec.match(entries)
            goes_on = bool(listed and spec.match(lines[number + 1].lstrip()))
            goes_on = goes_on or _has_more_rows(begun, lines[number + 1], spec)
        if not goes_on:
            yield first, begun
            begun = ""


def _has_more_rows(written: str, below: str, spec: re.Pattern[str]) -> bool:
    """Whether a line of columns and rows in them goes on with rows in the next, further right."""
    first, after = spec.match(written.lstrip()), spec.match(below.lstrip())
    columns = first and (first["columns"] or first["column"])
    rows = after and (after["rows"] or after["row"])
    indents = (len(line) - len(line.lstrip()) for line in (written, below))
    return bool(columns and rows and next(indents) < next(indents))
