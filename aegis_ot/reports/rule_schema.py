"""The published JSON Schema of rule files, made from the dataclasses that read them."""

from __future__ import annotations

import dataclasses
import inspect
import json
import re
import types
import typing
from collections.abc import Mapping
from typing import Annotated, Any, Literal

from ..preflight.checks import CHECKS
from ..preflight.rules import READABLE, Family, hints_of, is_required, public_fields


def family_schema() -> dict[str, Any]:
    """JSON Schema (draft 2020-12) of a family file, every check with its parameters."""
    schema = json_schema(Family)
    schema["title"] = "aegis_ot assay family"
    schema["properties"]["$schema"] = {"type": "string"}
    schema["properties"]["schema"]["enum"] = list(READABLE)
    schema["$defs"]["RuleSpec"]["properties"]["checks"]["items"] = {"oneOf": _checks()}
    return schema


def _checks() -> list[dict[str, Any]]:
    described = []
    for name, check in sorted(CHECKS.items()):
        schema = json_schema(check)
        schema.pop("$schema")
        schema["properties"]["check"] = {"const": name}
        schema["required"] = ["check", *schema["required"]]
        described.append(schema)
    return described


def schema_text() -> str:
    """The schema as the file ``rules/family.schema.json`` holds it."""
    return json.dumps(family_schema(), indent=1, ensure_ascii=False) + "\n"


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
            schema |= limit.schema
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
    fields, hints, told = public_fields(cls), hints_of(cls), _meanings(cls)
    properties = {}
    for f in fields:
        schema = properties[f.name] = _schema_of(hints[f.name], definitions)
        if f.name in told:
            schema["description"] = told[f.name]
        if f.default not in (dataclasses.MISSING, None, (), ""):
            schema["default"] = f.default
    return {
        "type": "object",
        "description": _summary(cls),
        "properties": properties,
        "required": [f.name for f in fields if is_required(f)],
        "additionalProperties": False,
    }


def _summary(cls: type[Any]) -> str:
    """The first sentence or two: all before the first empty line, on one line."""
    return _plain((inspect.getdoc(cls) or "").split("\n\n")[0])


def _meanings(cls: type[Any]) -> dict[str, str]:
    """For each field under "Attributes" what it means, on one line."""
    _, _, text = (inspect.getdoc(cls) or "").partition("Attributes:\n")
    entries = re.split(r"\n(?=    \S)", text.split("\n\n")[0].rstrip())
    told = (_plain(entry).partition(": ") for entry in entries if entry)
    return {name: meaning for name, _, meaning in told}


def _plain(text: str) -> str:
    return re.sub(r":\w+:`([^`]*)`", r"`\1`", " ".join(text.split())).replace("``", "`")
