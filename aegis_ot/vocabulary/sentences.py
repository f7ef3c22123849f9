"""Small words for reports: numbers of things, and texts from outside made fit to be shown."""

from __future__ import annotations


def one_line(text: object, limit: int = 300) -> str:
    """``text`` on one line, at most ``limit`` characters long.

    Characters that do not print become spaces: an escape sequence could repaint the terminal
    that a report is read on, and half a surrogate pair cannot be written anywhere.
    """
    printable = "".join(c if c.isprintable() else " " for c in str(text or ""))
    flat = " ".join(printable.split())
    return flat if len(flat) <= limit else flat[: limit - 3] + "..."


def counted(number: int, singular: str, plural: str = "") -> str:
    """``1 finding``, ``2 findings``."""
    return f"{number} {singular if number == 1 else plural or singular + 's'}"
