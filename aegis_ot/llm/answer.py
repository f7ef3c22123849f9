"""The form in which a model answers about a protocol.

Equal for all protocols, so that it stands in the cached prefix; which rules, wells and lines
exist is checked afterwards (:mod:`.read_answer`). Every member is required and nothing else
allowed: what the strict modes of the services ask for.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def strict_object(**properties: Any) -> dict[str, Any]:
    """Schema of an object in which every property is required and no other allowed."""
    return {
        "type": "object",
        "properties": properties,
        "required": list(properties),
        "additionalProperties": False,
    }


def _list(items: Mapping[str, Any]) -> dict[str, Any]:
    return {"type": "array", "items": items}


SAID = ("holds", "violated", "cannot_tell", "not_applicable")
"""What may be answered to an open question."""

_TEXT = {"type": "string"}
_WELLS = _list(_TEXT)
_LINES = _list({"type": "integer"})

ANSWER_SCHEMA: dict[str, Any] = strict_object(
    family=_TEXT,
    roles=_list(
        strict_object(
            role=_TEXT,
            wells=_WELLS,
            levels=_list(_TEXT),
            citations=_list(strict_object(line={"type": "integer"}, quote=_TEXT)),
        )
    ),
    answers=_list(
        strict_object(
            rule=_TEXT,
            answer={"type": "string", "enum": list(SAID)},
            reason=_TEXT,
            wells=_WELLS,
            lines=_LINES,
        )
    ),
    findings=_list(
        strict_object(rule=_TEXT, message=_TEXT, wells=_WELLS, lines=_LINES, why=_TEXT, fix=_TEXT)
    ),
    summary=_TEXT,
)
