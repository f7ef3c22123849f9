"""Reads dataclasses from JSON with messages for people, and writes their JSON Schema.

The robot has no pydantic and no jsonschema; a rule file must still be refused with the file,
the rule and the field that is wrong.
"""

from __future__ import annotations

import dataclasses
import types
import typing
from collections.abc import Mapping
from typing import Any, TypeVar

from ...errors import RuleError

T = TypeVar("T")
_HINTS: dict[type[Any], dict[str, Any]] = {}
_WORDS = {str: "a text", int: "a whole number", float: "a number", bool: "true or false"}


def read_dataclass(cls: type[T], data: Any, where: str) -> T:
    """Build ``cls`` from a JSON object.

    Raises:
        RuleError: If a field is missing, unknown or of the wrong kind; the message begins
            with ``where`` and names the field (and the rule's id, inside a list of rules).
    """
    if not isinstance(data, dict):
        raise RuleError(f"{where}: expected an object, found {_kind(data)}")
    hints = _hints(cls)
    fields = {f.name: f for f in _public_fields(cls)}
    unknown = [key for key in data if key not in fields]
    if unknown:
        raise RuleError(f"{where}: unknown field {unknown[0]!r}; known are {', '.join(fields)}")
    values: dict[str, Any] = {}
    for name, f in fields.items():
        if name in data:
            values[name] = _read(hints[name], data[name], f"{where}: {name}")
        elif f.default is dataclasses.MISSING and f.default_factory is dataclasses.MISSING:
            raise RuleError(f"{where}: field {name!r} is missing")
    return cls(**values)


def _hints(cls: type[Any]) -> dict[str, Any]:
    """Kept: compiling them from texts anew is most of the cost of reading a rule."""
    if cls not in _HINTS:
        _HINTS[cls] = typing.get_type_hints(cls)
    return _HINTS[cls]


def _public_fields(cls: type[Any]) -> list[dataclasses.Field[Any]]:
    """The fields that a file may hold."""
    return [f for f in dataclasses.fields(cls) if not f.metadata.get("internal")]


def _read(hint: Any, value: Any, where: str) -> Any:
    origin = typing.get_origin(hint)
    arguments = typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        if value is None and type(None) in arguments:
            return None
        return _read(next(a for a in arguments if a is not type(None)), value, where)
    if origin is tuple:
        if not isinstance(value, list):
            raise RuleError(f"{where}: expected a list, found {_kind(value)}")
        return tuple(
            _read(arguments[0], item, f"{where}{_item(item, number)}")
            for number, item in enumerate(value)
        )
    if origin is not None and issubclass(origin, Mapping):
        if not isinstance(value, dict):
            raise RuleError(f"{where}: expected an object, found {_kind(value)}")
        return {key: _read(arguments[1], item, f"{where}.{key}") for key, item in value.items()}
    if hint is Any:
        return value
    if dataclasses.is_dataclass(hint) and isinstance(hint, type):
        return read_dataclass(hint, value, where)
    if hint is float and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    if isinstance(hint, type) and isinstance(value, hint):
        if hint is int and isinstance(value, bool):
            raise RuleError(f"{where}: expected a whole number, found true or false")
        return value
    raise RuleError(f"{where}: expected {_WORDS.get(hint, str(hint))}, found {_kind(value)}")


def _item(item: Any, number: int) -> str:
    if isinstance(item, dict) and isinstance(item.get("id"), str):
        return f" {item['id']}"
    return f"[{number}]"


def _kind(value: Any) -> str:
    if value is None:
        return "null"
    if isinstance(value, dict):
        return "an object"
    if isinstance(value, list):
        return "a list"
    return f"{_WORDS.get(type(value), type(value).__name__)} ({value!r})"


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
    if origin in (typing.Union, types.UnionType):
        return {"anyOf": [_schema_of(argument, definitions) for argument in arguments]}
    if hint is type(None):
        return {"type": "null"}
    if origin is tuple:
        return {"type": "array", "items": _schema_of(arguments[0], definitions)}
    if origin is not None and issubclass(origin, Mapping):
        return {"type": "object", "additionalProperties": _schema_of(arguments[1], definitions)}
    if dataclasses.is_dataclass(hint) and isinstance(hint, type):
        if hint.__name__ not in definitions:
            definitions[hint.__name__] = {}
            definitions[hint.__name__] = _object_schema(hint, definitions)
        return {"$ref": f"#/$defs/{hint.__name__}"}
    simple = {str: "string", int: "integer", float: "number", bool: "boolean"}
    return {"type": simple[hint]} if hint in simple else {}


def _object_schema(cls: type[Any], definitions: dict[str, Any]) -> dict[str, Any]:
    hints = _hints(cls)
    required = [
        f.name
        for f in _public_fields(cls)
        if f.default is dataclasses.MISSING and f.default_factory is dataclasses.MISSING
    ]
    return {
        "type": "object",
        "description": (cls.__doc__ or "").split("\n\n")[0].replace("\n", " ").strip(),
        "properties": {f.name: _schema_of(hints[f.name], definitions) for f in _public_fields(cls)},
        "required": required,
        "additionalProperties": False,
    }
