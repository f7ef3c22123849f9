"""The prompt files under ``prompts/``: text under version control, not strings in code."""

from __future__ import annotations

import functools
import re
from importlib import resources

_VERSION = re.compile(r"^<!-- version (?P<version>.+?) -->\n")


@functools.cache
def prompt(name: str, package: str = __name__.rpartition(".")[0]) -> str:
    """The text of ``prompts/NAME.md`` of a package, without its version line."""
    file = resources.files(package) / "prompts" / f"{name}.md"
    return _VERSION.sub("", file.read_text(encoding="utf-8")).strip()
