"""The prompt files under ``prompts/``: text under version control, not strings in code."""

from __future__ import annotations

import functools
import re
from importlib import resources

_VERSION = re.compile(r"^<!-- version (?P<version>.+?) -->\n")


@functools.cache
def prompt(name: str) -> str:
    """The text of ``prompts/NAME.md`` without its version line."""
    return _VERSION.sub("", _file(name)).strip()


@functools.cache
def _file(name: str) -> str:
    return (resources.files(__package__) / "prompts" / f"{name}.md").read_text(encoding="utf-8")
