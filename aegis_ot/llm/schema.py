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

from ..vocabulary import one_line

_TYPES: dict[str, tuple[type, ...]] = {
    "object": (dict,),
    "array": (list,),
    "string": (str,),
    "integer": (int,),
    "number": (int, float),
    "boolean": (bool,),
}


def read_answer(given: Any, schema: Mapping[str, Any]) -> tuple[dict[str, Any] | None, str]:
    """The object that answers, or ``None`` and what is wrong with it.

    Args:
        given: The object, or the text that holds it. A fence of backticks around it is taken
            off: open models like to put one there.
        schema: What it must fit.
    """
    if isinstance(given, str):
        stripped = given.strip()
        if not stripped:
            return None, "it is empty"
        if stripped.startswith("```"):
            stripped = stripped.strip("`").removeprefix("json").strip()
        try:
            given = json.loads(stripped)
        except ValueError as error:
            return None, f"it is not JSON ({error})"
        except RecursionError:
            return None, "it is nested too deeply"
    problem = problem_of(given, schema)
    if problem:
        return None, problem
    if not isinstance(given, dict):
        return None, "it is no object"
    return given, ""


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
            return f"{path}: there is no member {one_line(name, 60)!r}"
    return ""


def _is(value: Any, kind: str) -> bool:
    if isinstance(value, bool):
        return kind == "boolean"
    return isinstance(value, _TYPES[kind])


def _shown(value: Any) -> str:
    if isinstance(value, dict):
        return "an object"
    if isinstance(value, list):
        return "a list"
    return one_line(json.dumps(value, ensure_ascii=False), 60)
