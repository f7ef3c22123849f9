"""Compiles ``rules/*.json`` into a Python module: ``python -m scripts.compile_rules``.

The robot judges by the module and reads no JSON; run this after each change of a rule file. A
test holds the module to the files.
"""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

from aegis_ot.preflight.rule_set import RuleSet, read_shipped

MODULE = Path(__file__).parents[1] / "aegis_ot" / "preflight" / "rule_set" / "shipped.py"

_HEAD = '''\
"""Compiled from ``rules/*.json`` by ``python -m scripts.compile_rules``. Do not edit."""


from ..rules import {names}

'''
_BROKEN = ("families", "signals", "roles", "rules", "shapes", "known_by")
"""Fields whose items stand on lines of their own: a change of one rule is a change of one line."""


def module_text(rule_set: RuleSet) -> str:
    """The module's text."""
    used: set[str] = set()
    common = _literal(rule_set.common, used)
    families = _lines(rule_set.families, used)
    head = _HEAD.format(names=", ".join(sorted(used)))
    return f"{head}COMMON = {common}\n\nFAMILIES = {families}\n"


def _literal(value: Any, used: set[str]) -> str:
    if dataclasses.is_dataclass(value):
        used.add(type(value).__name__)
        given = ", ".join(_fields(value, used))
        return f"{type(value).__name__}({given})"
    if isinstance(value, tuple):
        return "(" + "".join(f"{_literal(item, used)}, " for item in value).rstrip(" ") + ")"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{k!r}: {_literal(v, used)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(_literal(item, used) for item in value) + "]"
    return repr(value)


def _fields(value: Any, used: set[str]) -> list[str]:
    """Those that differ from what a dataclass says by itself."""
    given = []
    for field in dataclasses.fields(value):
        item = getattr(value, field.name)
        default = field.default
        if field.default_factory is not dataclasses.MISSING:
            default = field.default_factory()
        if field.metadata.get("internal") or (
            default is not dataclasses.MISSING and item == default
        ):
            continue
        broken = field.name in _BROKEN and not isinstance(item, str) and item
        text = _lines(item, used) if broken else _literal(item, used)
        given.append(f"{field.name}={text}")
    return given


def _lines(items: Any, used: set[str]) -> str:
    if isinstance(items, dict):
        return "{\n" + "".join(f"{k!r}: {_literal(v, used)},\n" for k, v in items.items()) + "}"
    if all(isinstance(item, str) for item in items):
        return _literal(items, used)
    return "(\n" + "".join(f"{_literal(item, used)},\n" for item in items) + ")"


if __name__ == "__main__":
    MODULE.write_text(module_text(read_shipped()), encoding="utf-8")
