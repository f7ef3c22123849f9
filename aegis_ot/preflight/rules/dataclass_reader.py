"""Reads dataclasses from the JSON of rule files, with messages for people.

The robot has no pydantic and no jsonschema; a rule file must still be refused with the file,
the rule and the field that is wrong. What is refused here is refused by the published schema
(:mod:`aegis_ot.reports.rule_schema`) as well: both go by the types of the fields and by what is
said beside these: ``Annotated[str, matching(...)]``.
"""

from __future__ import annotations

import dataclasses
import json
import math
import re
import types
import typing
from collections import Counter
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Annotated, Any, Literal, TypeVar

from ...errors import RuleError


@dataclass(frozen=True, eq=False)
class Limit:
    """What a field may hold beyond its type.

    Attributes:
        allows: Whether a value of the field's type is fine.
        expected: What is expected instead of another: "a text that is not empty".
        schema: The same in JSON Schema.
    """

    allows: Callable[[Any], bool]
    expected: str
    schema: Mapping[str, Any]


def matching(pattern: str, meaning: str) -> Limit:
    """A text in which a pattern is found that Python and JSON Schema read alike."""
    return Limit(lambda text: bool(re.search(pattern, text)), meaning, {"pattern": pattern})


NOT_EMPTY = Limit(bool, "at least one", {"minItems": 1})

# Names stand between commas and brackets in options and waivers, and families name pages. In
# Python "$" is also before a last line break, hence what follows it.
Name = Annotated[
    str,
    matching(
        r"^[A-Za-z0-9_][A-Za-z0-9_.-]*$(?!\n)",
        "a name of letters, digits, '_', '-' and '.', without spaces",
    ),
]
Word = Annotated[str, matching(r"\S", "a word or phrase")]

T = TypeVar("T")
_HALF = re.compile("[\ud800-\udfff]")
"""JSON can hold half of a pair that makes one character; no file or terminal takes it."""

_HINTS: dict[type[Any], dict[str, Any]] = {}
_WORDS = {str: "a text", int: "a whole number", float: "a number", bool: "true or false"}


class JsonObject(dict[str, Any]):
    """A JSON object that knows which of its fields were written twice.

    Python keeps the last value of a field and forgets the others; whoever edits the first one
    would wonder why nothing changes. Which rule it stands in is known only where it is read.
    """

    def __init__(self, pairs: list[tuple[str, Any]]) -> None:
        super().__init__(pairs)
        times = Counter(name for name, _ in pairs)
        self.doubled = [name for name in self if times[name] > 1]


def parse_json(text: bytes) -> Any:
    """The value of a JSON text in UTF-8, with or without the mark that Windows puts first.

    Raises:
        ValueError: With what is wrong, in words.
    """
    try:
        return json.loads(text.decode("utf-8-sig"), object_pairs_hook=JsonObject)
    except UnicodeDecodeError as error:
        raise ValueError(f"it is not UTF-8 text ({error.reason} at byte {error.start})") from None
    except RecursionError:
        raise ValueError("its lists or objects are nested too deeply") from None


def read_dataclass(cls: type[T], data: Any, where: str) -> T:
    """Build ``cls`` from a JSON object.

    Raises:
        RuleError: If a field is missing, unknown or of the wrong kind; the message begins
            with ``where`` and names the field (and the rule's id, inside a list of rules).
    """
    _require_object(data, where)
    hints = hints_of(cls)
    fields = {f.name: f for f in public_fields(cls)}
    unknown = [key for key in data if key not in fields]
    if unknown:
        if instead := getattr(cls, "DROPPED", {}).get(unknown[0]):
            raise RuleError(f"{where}: {unknown[0]!r} is no field any more: {instead}")
        raise RuleError(f"{where}: unknown field {unknown[0]!r}; known are {', '.join(fields)}")
    values: dict[str, Any] = {}
    for name, f in fields.items():
        if name in data:
            values[name] = _read(hints[name], data[name], f"{where}: {name}")
        elif is_required(f):
            raise RuleError(f"{where}: field {name!r} is missing")
    return cls(**values)


def hints_of(cls: type[Any]) -> dict[str, Any]:
    """The types of the fields, with their limits.

    Kept: compiling them from texts anew is most of the cost of reading a rule.
    """
    if cls not in _HINTS:
        _HINTS[cls] = typing.get_type_hints(cls, include_extras=True)
    return _HINTS[cls]


def public_fields(cls: type[Any]) -> list[dataclasses.Field[Any]]:
    """The fields that a file may hold."""
    return [f for f in dataclasses.fields(cls) if not f.metadata.get("internal")]


def is_required(field: dataclasses.Field[Any]) -> bool:
    """Whether a file must give it."""
    return field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING


def _read(hint: Any, value: Any, where: str) -> Any:
    if hint is str or hint in (int, float, bool):  # first: most values are texts
        return _read_plain(hint, value, where)
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin is None:
        return value if hint is Any else read_dataclass(hint, value, where)
    if origin is Annotated:
        result = _read(arguments[0], value, where)
        for limit in arguments[1:]:
            if not limit.allows(result):
                raise RuleError(f"{where}: expected {limit.expected}, found {_shown(value)}")
        return result
    if origin is Literal:
        if isinstance(value, str) and value in arguments:
            return value
        raise RuleError(f"{where}: expected {_either(arguments)}, found {_shown(value)}")
    if origin in (typing.Union, types.UnionType):
        if value is None and type(None) in arguments:
            return None
        return _read(next(a for a in arguments if a is not type(None)), value, where)
    if origin is tuple:
        if not isinstance(value, list):
            raise RuleError(f"{where}: expected a list, found {_kind(value)}")
        return tuple(
            _read(arguments[0], item, _item_place(where, item, number))
            for number, item in enumerate(value)
        )
    assert issubclass(origin, Mapping)
    _require_object(value, where)
    return {
        _read(arguments[0], key, where): _read(arguments[1], item, f"{where}.{key}")
        for key, item in value.items()
    }


def _read_plain(hint: type[Any], value: Any, where: str) -> Any:
    if isinstance(value, bool) and hint is not bool:
        raise RuleError(f"{where}: expected {_WORDS[hint]}, found true or false")
    if hint is float and isinstance(value, int | float):
        with suppress(OverflowError):
            if math.isfinite(number := float(value)):
                return number
        raise RuleError(f"{where}: expected a finite number, found {json.dumps(value)}")
    if not isinstance(value, hint):
        raise RuleError(f"{where}: expected {_WORDS[hint]}, found {_kind(value)}")
    if hint is str and _HALF.search(value):
        raise RuleError(f"{where}: expected a text, found half of a character in {value!r}")
    return value


def _require_object(value: Any, where: str) -> None:
    if not isinstance(value, dict):
        raise RuleError(f"{where}: expected an object, found {_kind(value)}")
    if isinstance(value, JsonObject) and value.doubled:
        raise RuleError(f"{where}: field {value.doubled[0]!r} is written twice")


def _item_place(where: str, item: Any, number: int) -> str:
    """Where an item of a list stands; a rule by its identifier: "pcr.json: rule PCR-1"."""
    name = item.get("id") if isinstance(item, dict) else None
    if isinstance(name, str) and name:
        return f"{where.removesuffix('s')} {name}"
    return f"{where}[{number}]"


def _either(choices: tuple[str, ...]) -> str:
    """``a, b or c``."""
    *most, last = [choice or "an empty text" for choice in sorted(choices, key=lambda c: not c)]
    return f"{', '.join(most)} or {last}"


def _shown(value: Any) -> str:
    """What was found where the kind is right and the value is not."""
    if value == [] and isinstance(value, list):
        return "an empty list"
    return repr(value) if isinstance(value, str) else _kind(value)


def _kind(value: Any) -> str:
    if value is None:
        return "null"
    if isinstance(value, dict):
        return "an object"
    if isinstance(value, list):
        return "a list"
    return f"{_WORDS.get(type(value), type(value).__name__)} ({value!r})"
