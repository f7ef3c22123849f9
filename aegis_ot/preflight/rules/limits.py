"""What a field may hold beyond its type, said where the field is declared.

A field is declared as ``Annotated[float, AtLeast(0)]``; the limit then holds where a file is read
and stands in the published schema, so that the two cannot disagree.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated, Any


@dataclass(frozen=True)
class Matching:
    """A text of a certain form.

    Attributes:
        pattern: A regular expression that Python and JSON Schema read alike; it is searched for.
        meaning: What it asks for, in words: "a text that is not empty".
    """

    pattern: str
    meaning: str

    def refuses(self, value: Any) -> str:
        """What is expected instead of this text, ``""`` if it is fine."""
        return "" if re.search(self.pattern, value) else self.meaning

    def schema(self) -> dict[str, Any]:
        """The same in JSON Schema."""
        return {"pattern": self.pattern}


@dataclass(frozen=True)
class AtLeast:
    """A number that is no smaller."""

    least: float

    def refuses(self, value: Any) -> str:
        """What is expected instead of this number, ``""`` if it is fine."""
        return "" if value >= self.least else f"a number that is at least {self.least:g}"

    def schema(self) -> dict[str, Any]:
        """The same in JSON Schema."""
        return {"minimum": self.least}


@dataclass(frozen=True)
class NotEmpty:
    """A list of at least one."""

    def refuses(self, value: Any) -> str:
        """What is expected instead of this list, ``""`` if it is fine."""
        return "" if value else "at least one"

    def schema(self) -> dict[str, Any]:
        """The same in JSON Schema."""
        return {"minItems": 1}


# Names stand between commas and brackets in options and waivers, and families name pages. In
# Python "$" is also before a last line break, hence what follows it.
Name = Annotated[
    str,
    Matching(
        r"^[A-Za-z0-9_][A-Za-z0-9_.-]*$(?!\n)",
        "a name of letters, digits, '_', '-' and '.', without spaces",
    ),
]
Word = Annotated[str, Matching(r"\S", "a word or phrase")]
