"""The published JSON Schema of a family file, made from the dataclasses that read it."""

from __future__ import annotations

import json
from typing import Any

from ..checks import CHECKS
from ..rules import READABLE, Family, json_schema


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
    for name, check in CHECKS.items():
        schema = json_schema(check)
        schema.pop("$schema")
        schema["properties"]["check"] = {"const": name}
        schema["required"] = ["check", *schema["required"]]
        described.append(schema)
    return described


def schema_text() -> str:
    """The schema as the file ``rules/family.schema.json`` holds it."""
    return json.dumps(family_schema(), indent=1, ensure_ascii=False) + "\n"
