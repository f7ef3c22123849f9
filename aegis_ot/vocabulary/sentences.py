"""Small words for reports: numbers of things, and texts from outside made fit to be shown."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable

_COMMAND = re.compile(r"^(\s*):(?=:)", re.MULTILINE)
"""How a line begins that GitHub's runner takes for a command to itself."""

_FORMULA = ("=", "+", "-", "@", "\t", "\r", "'")


def one_line(text: object, limit: int = 300) -> str:
    """``text`` on one line, at most ``limit`` characters long.

    Characters that do not print become spaces: an escape sequence could repaint the terminal
    that a report is read on, and half a surrogate pair cannot be written anywhere.
    """
    flat = " ".join(printable(str(text or "")).split())
    return flat if len(flat) <= limit else flat[: limit - 3] + "..."


def printable(text: str, keep: str = "") -> str:
    """``text`` with a space for each character that does not print, but for those of ``keep``.

    A name may hold an escape sequence, or a newline after which the log of a CI would take what
    follows for a command.
    """
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() or c in keep else " " for c in text)


def no_commands(text: str) -> str:
    """``text`` of several lines, none of which GitHub's runner takes for a workflow command."""
    return _COMMAND.sub(r"\1: ", text).replace("##[", "## [")


def csv_cell(value: object) -> object:
    """A value for a cell of a CSV file: a text that a spreadsheet would take for a formula, and
    run, gets an apostrophe before it. :func:`from_csv_cell` takes it away again."""
    if not isinstance(value, str) or not value.startswith(_FORMULA):
        return value
    try:
        float(value)
    except ValueError:
        return f"'{value}"
    return value


def from_csv_cell(text: str) -> str:
    """What :func:`csv_cell` was given."""
    return text[1:] if text.startswith("'") and text[1:].startswith(_FORMULA) else text


def nearest(name: str, names: Iterable[str]) -> str:
    """`` (did you mean 'A1'?)``, or nothing where no name is like it."""
    by_key = {known.casefold(): known for known in names}
    near = difflib.get_close_matches(name.strip().casefold(), by_key, n=2, cutoff=0.6)
    return f" (did you mean {' or '.join(repr(by_key[key]) for key in near)}?)" if near else ""


def counted(number: int, singular: str, plural: str = "") -> str:
    """``1 finding``, ``2 findings``."""
    return f"{number} {singular if number == 1 else plural or singular + 's'}"
