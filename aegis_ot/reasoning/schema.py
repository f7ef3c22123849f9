"""Checks an answer against the part of JSON Schema that this package's requests use.

Services promise to keep to a schema and do not always; recorded and imported answers come from
anywhere. A validator of our own keeps ``jsonschema`` out of the workstation's dependencies.
Supported: ``type``, ``enum``, ``properties``, ``required``, ``additionalProperties: false``,
``items``: what every service's strict mode understands. Bounds are checked by who asked.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

_TYPES: dict[str, tuple[type, ...]] = {
    "object": (dict,),
    "array": (list,),
    "string": (str,),
    "integer": (int,),
    "number": (int, float),
    "boolean": (bool,),
}


def read_answer(text: str, schema: Mapping[str, Any]) -> tuple[dict[str, Any] | None, str]:
    """The object in ``text``, or ``None`` and what is wrong with it.

    A fence of backticks around the object is taken off: open models like to put one there.
    """
    stripped = text.strip()
    if stripped.startswith("```"):
        stripped = stripped.strip("`").removeprefix("json").strip()
    try:
        value = json.loads(stripped)
    except (ValueError, RecursionError) as error:
        return None, f"it is not JSON ({error})"
    problem = problem_of(value, schema)
    if problem:
        return None, problem
    if not isinstance(value, dict):
        return None, "it is no object"
    return value, ""


def problem_of(value: Any, schema: Mapping[str, Any], path: str = "answer") -> str:
    """The first thing about ``value`` that does not fit, or ``""``."""
    kind = schema.get("type")
    if kind is not None and not _is(value, kind):
        return f"{path}: expected {kind}, got {_shown(value)}"
    if "enum" in schema and value not in schema["enum"]:
        return f"{path}: {_shown(value)} is none of {', '.join(map(str, schema['enum']))}"
    if isinstance(value, list):
        return _list_problem(value, schema, path)
    if isinstance(value, dict):
        return _object_problem(value, schema, path)
    return ""


def _list_problem(value: list[Any], schema: Mapping[str, Any], path: str) -> str:
    items = schema.get("items", {})
    for number, item in enumerate(value):
        problem = problem_of(item, items, f"{path}[{number}]")
        if problem:
            return problem
    return ""


def _object_problem(value: dict[str, Any], schema: Mapping[str, Any], path: str) -> str:
    properties = schema.get("properties", {})
    for name in schema.get("required", ()):
        if name not in value:
            return f"{path}: {name} is missing"
    for name, item in value.items():
        if name in properties:
            problem = problem_of(item, properties[name], f"{path}.{name}")
            if problem:
                return problem
        elif schema.get("additionalProperties") is False:
            return f"{path}: there is no member {name!r}"
    return ""


def _is(value: Any, kind: str) -> bool:
    if isinstance(value, bool):
        return kind == "boolean"
    return isinstance(value, _TYPES[kind])


def _shown(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False, default=str)
    return text if len(text) <= 60 else text[:57] + "..."
