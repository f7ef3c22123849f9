"""What a field may hold beyond its type, said where the field is declared.

A field is declared as ``Annotated[float, at_least(0)]``; the limit then holds where a file is read
and stands in the published schema, so that the two cannot disagree.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Annotated, Any


@dataclass(frozen=True, eq=False)
class Limit:
    """A limit of a field.

    Attributes:
        allows: Whether a value of the field's type is fine.
        expected: What is expected instead of another: "a text that is not empty".
        schema: The same in JSON Schema.
    """

    allows: Callable[[Any], bool]
    expected: str
    schema: Mapping[str, Any]


def at_least(least: float) -> Limit:
    """A number that is no smaller."""
    told = f"a number that is at least {least:g}"
    return Limit(lambda value: bool(value >= least), told, {"minimum": least})


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
