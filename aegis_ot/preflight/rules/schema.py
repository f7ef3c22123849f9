"""Writes the JSON Schema of dataclasses that are read from JSON."""

from __future__ import annotations

import dataclasses
import types
import typing
from collections.abc import Mapping
from typing import Annotated, Any, Literal

from .described import meanings, summary
from .reading import hints_of, is_required, public_fields


def json_schema(cls: type[Any]) -> dict[str, Any]:
    """JSON Schema (draft 2020-12) of a dataclass, with its own documentation."""
    definitions: dict[str, Any] = {}
    root = _schema_of(cls, definitions)
    definitions_used = {name: value for name, value in definitions.items() if value}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **definitions_used.pop(cls.__name__, root),
        **({"$defs": definitions_used} if definitions_used else {}),
    }


def _schema_of(hint: Any, definitions: dict[str, Any]) -> dict[str, Any]:
    origin = typing.get_origin(hint)
    arguments = typing.get_args(hint)
    if origin is Annotated:
        schema = _schema_of(arguments[0], definitions)
        for limit in arguments[1:]:
            schema |= limit.schema()
        return schema
    if origin is Literal:
        return {"enum": list(arguments)}
    if origin in (typing.Union, types.UnionType):
        return {"anyOf": [_schema_of(argument, definitions) for argument in arguments]}
    if hint is type(None):
        return {"type": "null"}
    if origin is tuple:
        return {"type": "array", "items": _schema_of(arguments[0], definitions)}
    if origin is not None and issubclass(origin, Mapping):
        schema = {"type": "object", "additionalProperties": _schema_of(arguments[1], definitions)}
        names = _schema_of(arguments[0], definitions)
        return schema if names == {"type": "string"} else schema | {"propertyNames": names}
    if dataclasses.is_dataclass(hint) and isinstance(hint, type):
        if hint.__name__ not in definitions:
            definitions[hint.__name__] = {}
            definitions[hint.__name__] = _object_schema(hint, definitions)
        return {"$ref": f"#/$defs/{hint.__name__}"}
    simple = {str: "string", int: "integer", float: "number", bool: "boolean"}
    return {"type": simple[hint]} if hint in simple else {}


def _object_schema(cls: type[Any], definitions: dict[str, Any]) -> dict[str, Any]:
    fields, hints, told = public_fields(cls), hints_of(cls), meanings(cls)
    properties = {}
    for f in fields:
        schema = properties[f.name] = _schema_of(hints[f.name], definitions)
        if f.name in told:
            schema["description"] = told[f.name]
        if f.default not in (dataclasses.MISSING, None, (), ""):
            schema["default"] = f.default
    return {
        "type": "object",
        "description": summary(cls),
        "properties": properties,
        "required": [f.name for f in fields if is_required(f)],
        "additionalProperties": False,
    }
