"""Fields of rule files of schema 1 that are gone, each with what to write instead."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...errors import RuleError

_NAME = "name such wells in the protocol, load a liquid, or give them in the guard's `roles`"
_LEAVE = "leave it out"

DROPPED: Mapping[str, str] = {
    "single_with": _NAME,
    "single_beside": _NAME,
    "used_like": _NAME,
    "gets": _NAME,
    "in_place_of": _NAME,
    "common_to": _NAME,
    "called_alike_beside": _NAME,
    "passed_on": _NAME,
    "holds": "load the liquid, and list its role in `receives`",
    "undosed": "give the wells of dose 0 a name of their own",
    "replicated": "name the wells of each plate",
    "receives_with": f"{_LEAVE}: `receives` alone decides",
    "feeds_beside": f"{_LEAVE}: `feeds` alone decides",
}


def refuse_dropped(data: Mapping[str, Any], file: str) -> None:
    """Refuse a family that uses what schema 2 no longer has.

    Args:
        data: The file, as it was parsed.
        file: Its name, for the message.

    Raises:
        RuleError: With file, role, field, and what to write instead.
    """
    roles = data.get("roles")
    for name, role in roles.items() if isinstance(roles, dict) else ():
        for field in role if isinstance(role, dict) else ():
            if field in DROPPED:
                raise RuleError(
                    f"{file}: roles.{name}: {field!r} is no field since schema 2: {DROPPED[field]}"
                )
