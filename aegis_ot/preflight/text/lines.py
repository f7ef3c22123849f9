"""The lines of a protocol's text, numbered as Python numbers them."""

from __future__ import annotations

import re

_WIDEST_GAP = 40
"""Columns that are drawn in line stand no further apart."""
_GAP = re.compile(rf"[^\S\n]{{{_WIDEST_GAP + 1},}}")


def without_gaps(text: str) -> str:
    """A text without the long runs of spaces on which patterns would take for ages."""
    return _GAP.sub(" " * _WIDEST_GAP, text)


def source_lines(text: str) -> list[str]:
    """Split at ends of lines. ``str.splitlines`` would also split at form feeds and the like,
    which Python does not count: all later findings would show a wrong line."""
    lines = re.split(r"\r\n|\r|\n", text)
    return lines[:-1] if lines[-1] == "" else lines
