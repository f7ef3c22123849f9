"""The lines of a protocol's text, numbered as Python numbers them."""

from __future__ import annotations

import re


def source_lines(text: str) -> list[str]:
    """Split at ends of lines. ``str.splitlines`` would also split at form feeds and the like,
    which Python does not count: all later findings would show a wrong line."""
    lines = re.split(r"\r\n|\r|\n", text)
    return lines[:-1] if lines[-1] == "" else lines
