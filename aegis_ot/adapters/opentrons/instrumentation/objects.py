"""What the protocol's own objects and Enums hold, read from where Python keeps it.

Nothing that the protocol wrote is called: no property, no ``__getattr__``, no ``__str__``.
"""

from __future__ import annotations

from contextlib import suppress
from enum import Enum, EnumMeta
from types import MemberDescriptorType
from typing import Any

_LONGEST_VALUE = 100


def attributes(value: Any) -> list[tuple[str, Any]]:
    """The attributes of an object, those in slots included, without those of its class."""
    found: dict[str, Any] = {}
    for made in reversed(type.__getattribute__(type(value), "__mro__")[:-1]):  # all but object
        for name, slot in dict(type.__getattribute__(made, "__dict__")).items():
            if type(slot) is MemberDescriptorType:
                try:
                    found[name] = slot.__get__(value)
                except AttributeError:  # not assigned yet
                    continue
    with suppress(AttributeError):  # it has nothing but slots
        found.update(object.__getattribute__(value, "__dict__"))
    return [(name, item) for name, item in found.items() if not name.startswith("__")]


def is_member(value: Any) -> bool:
    """Whether this is a member of an Enum."""
    return issubclass(type(value), Enum)


def is_enum(value: Any) -> bool:
    """Whether this is an Enum itself."""
    return issubclass(type(value), EnumMeta)


def word_of(member: Any) -> str:
    """What a member says: its name, and its value where that is words that say more.

    ``NTC = "water"`` says "NTC water", ``VEHICLE = "vehicle control"`` no more than its value.
    """
    name, value = _told(member)
    if not isinstance(value, str) or not 0 < len(value) <= _LONGEST_VALUE:
        return name
    return value if _plain(name) in _plain(value) else f"{name} {value}"


def value_of(member: Any) -> Any:
    """The value of a member."""
    return _told(member)[1]


def members(enum: Any) -> list[tuple[str, Any]]:
    """Names and values of the members of an Enum."""
    found = type.__getattribute__(enum, "__dict__").get("_member_map_")
    if not issubclass(type(found), dict):
        return []
    return [_told(member) for member in dict.values(found) if is_member(member)]


def _told(member: Any) -> tuple[str, Any]:
    held = object.__getattribute__(member, "__dict__")
    return str(held.get("_name_", "")), held.get("_value_")


def _plain(text: str) -> str:
    return text.lower().replace("_", " ")
