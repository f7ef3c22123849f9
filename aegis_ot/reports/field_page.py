"""The page on what a rule file may hold, in Markdown, from the dataclasses that read it."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping
from typing import Any

from ..preflight.rules import (
    Example,
    Examples,
    Family,
    RoleSignal,
    RoleSpec,
    RuleSpec,
    SeriesSpec,
    ShapeSignal,
    Signal,
)
from .rule_schema import json_schema

_PARTS: dict[type[Any], str] = {
    Family: "Family",
    RoleSpec: "Role",
    RuleSpec: "Rule",
    Examples: "Examples",
    Example: "Example",
    Signal: "Signal",
    ShapeSignal: "Shape",
    RoleSignal: "Known by",
    SeriesSpec: "Series",
}
"""What each is called on the page; the headings to which fields link."""


_KINDS = {
    "string": "text",
    "number": "number",
    "integer": "whole number",
    "boolean": "`true` or `false`",
}


def field_page(head: str) -> str:
    """Every field of a family and of all that it holds: kind, default and meaning."""
    sections = (_section(cls, title) for cls, title in _PARTS.items())
    return f"{head}\n{_HEAD}{''.join(sections)}"


def parameters(cls: type[Any]) -> dict[str, tuple[str, str]]:
    """For each field ``(what holds if it is left out, what it means)``, in Markdown.

    The former is "required" for a field that must be given, and "none" for an empty one.
    """
    schema = json_schema(cls)
    return {
        name: (
            "required" if name in schema["required"] else _default(field),
            field.get("description", ""),
        )
        for name, field in schema["properties"].items()
    }


_HEAD = """
# Fields of a rule file

A rule file is a JSON object with the fields of a [family](#family). `$schema` may name \
`family.schema.json`, for editors. Roles are named as the family's `roles` name them. \
[Checks](checks.md) have a page of their own.
"""


def _section(cls: type[Any], title: str) -> str:
    schema = json_schema(cls)
    roles = {f.name for f in dataclasses.fields(cls) if f.metadata.get("roles")}
    rows = ""
    for name, (default, meaning) in parameters(cls).items():
        kind = "list of roles" if name in roles else _kind(schema["properties"][name])
        rows += f"| `{name}` | {kind} | {default} | {_cell(meaning)} |\n"
    return f"""
## {title}

{schema["description"]}

| field | holds | default | meaning |
|---|---|---|---|
{rows}"""


def _kind(field: Mapping[str, Any]) -> str:
    if "enum" in field:
        *most, last = [f"`{choice}`" for choice in field["enum"] if choice]
        return f"{', '.join(most)} or {last}"
    if "anyOf" in field:
        return _kind(field["anyOf"][0])
    if "$ref" in field:
        return _link(field["$ref"])
    if field["type"] == "array":
        return f"list: {_kind(field['items'])}"
    if "additionalProperties" in field:
        inner = field["additionalProperties"]
        return f"by name: {_kind(inner)}" if inner else "[check](checks.md) with its parameters"
    return _KINDS[field["type"]]


def _link(reference: str) -> str:
    """As GitHub makes it of a heading."""
    (title,) = (t for cls, t in _PARTS.items() if cls.__name__ == reference.rpartition("/")[2])
    return f"[{title.lower()}](#{title.lower().replace(' ', '-')})"


def _default(field: Mapping[str, Any]) -> str:
    if "default" in field:
        return f"`{json.dumps(field['default'])}`"
    return "none"


def _cell(text: str) -> str:
    return text.replace("|", "\\|")
