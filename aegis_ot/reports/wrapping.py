"""Lines of a report, folded at the width of a terminal."""

from __future__ import annotations

import re

from rich.cells import cell_len

_COLOUR = re.compile(r"\x1b\[[\d;]*m")
_SOURCE = re.compile(r"^ *\d* \|")
_OFFERED = re.compile(r"^ {4}\S.*: @guard\(")
_HANG = re.compile(r"^ *(?:= )?")
_NARROWEST = 40


def wrapped(text: str, width: int) -> str:
    """A report folded at ``width`` cells; source lines and lines to paste stay whole."""
    if width < _NARROWEST:
        return text
    return "\n".join(_folded(line, width) for line in text.split("\n"))


def _folded(line: str, width: int) -> str:
    bare = _COLOUR.sub("", line)
    if cell_len(bare) <= width or _SOURCE.match(bare) or _OFFERED.match(bare):
        return line
    start = _HANG.match(bare)
    hang = " " * (2 + (len(start[0]) if start else 0))
    rows, row, used = [], "", 0
    for word in re.split(r"(?<=\S) (?=\S)", line):
        length = cell_len(_COLOUR.sub("", word))
        if row and used + 1 + length > width:
            rows.append(row)
            row, used = hang + word, len(hang) + length
        else:
            used += length + bool(row)
            row = f"{row} {word}" if row else word
    return "\n".join([*rows, row])
