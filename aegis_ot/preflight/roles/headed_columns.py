"""Rows that stand under a heading of columns, one on a line::

Column 1 of the plate:
  A-F  samples
  G    positive control
  H    no template
"""

from __future__ import annotations

import functools
import re

from .well_names import WellNames

_FEWEST = 2
"""One line may begin with "A" for any reason."""


def under_columns(text: str, names: WellNames) -> str:
    """The text with wells in place of such letters: "A1-F1  samples"."""
    heading, entry = _patterns(names)
    lines = text.split("\n")
    for at, line in enumerate(lines):
        head = heading.search(line)
        if head is None:
            continue
        under: dict[int, str] = {}
        last = ""
        for below, written in enumerate(lines[at + 1 :], at + 1):
            match = entry.match(written)
            if match is None or match["low"] <= last:
                break
            last = match["high"] or match["low"]
            wells = names.crossed(match["low"], match["high"] or "", head["columns"])
            under[below] = f"{match['lead']}{wells}{written[match.end() :]}"
        if len(under) >= _FEWEST:
            for below, written in under.items():
                lines[below] = written
    return "\n".join(lines)


@functools.lru_cache(maxsize=8)
def _patterns(names: WellNames) -> tuple[re.Pattern[str], re.Pattern[str]]:
    """A heading, which ends with a colon, and an entry under it."""
    column = rf"\b(?:{names.columns}|{names.column})\.?\s*"
    span = rf"\d{{1,2}}(?:{names.to}\d{{1,2}})?"
    heading = rf"{column}(?P<columns>{span}(?:{names.conjunction}{span})*)(?!\w)[^:\d]{{0,40}}:\s*$"
    entry = rf"(?P<lead>\W*)(?P<low>[A-P])(?:{names.to}(?P<high>[A-P]))?(?![\w.])(?=\s*[:=]|\s+\S)"
    return re.compile(heading), re.compile(entry)
