"""What the fields of a dataclass mean, from its own documentation: for the schema and the pages."""

from __future__ import annotations

import inspect
import re
from typing import Any


def summary(cls: type[Any]) -> str:
    """The first sentence or two: all before the first empty line, on one line."""
    return _plain((inspect.getdoc(cls) or "").split("\n\n")[0])


def meanings(cls: type[Any]) -> dict[str, str]:
    """For each field under "Attributes" what it means, on one line."""
    _, _, text = (inspect.getdoc(cls) or "").partition("Attributes:\n")
    entries = re.split(r"\n(?=    \S)", text.split("\n\n")[0].rstrip())
    told = (_plain(entry).partition(": ") for entry in entries if entry)
    return {name: meaning for name, _, meaning in told}


def _plain(text: str) -> str:
    return re.sub(r":\w+:`([^`]*)`", r"`\1`", " ".join(text.split())).replace("``", "`")
