"""What the SARIF 2.1.0 standard demands of the objects that we write, as a JSON Schema.

Written from the standard's text, only for the properties in use; anything else is refused, so
that a new property has to be looked up first.
"""

from __future__ import annotations

from typing import Any


def _object(required: list[str], **properties: Any) -> dict[str, Any]:
    return {
        "type": "object",
        "required": required,
        "properties": properties,
        "additionalProperties": False,
    }


def _list(items: dict[str, Any], **more: Any) -> dict[str, Any]:
    return {"type": "array", "items": items, **more}


TEXT = {"type": "string"}
MESSAGE = _object(["text"], text=TEXT)
LEVEL = {"enum": ["none", "note", "warning", "error"]}
INDEX = {"type": "integer", "minimum": -1}
# A URI reference: no spaces, no raw non-ASCII; a relative one does not start with a slash.
ARTIFACT = _object(["uri"], uri={"type": "string", "pattern": r"^(file:///|[^/])[!-~]*$"})
REGION = _object(["startLine"], startLine={"type": "integer", "minimum": 1}, snippet=MESSAGE)
LOCATION = _object(
    ["physicalLocation"],
    id=INDEX,
    message=MESSAGE,
    physicalLocation=_object(["artifactLocation"], artifactLocation=ARTIFACT, region=REGION),
)
RULE = _object(
    ["id"],
    id=TEXT,
    name=TEXT,
    shortDescription=MESSAGE,
    fullDescription=MESSAGE,
    help=MESSAGE,
    helpUri=TEXT,
    defaultConfiguration=_object([], level=LEVEL),
)
STEPS = _object(["locations"], locations=_list(_object([], location=LOCATION), minItems=1))
RESULT = _object(
    ["message"],
    ruleId=TEXT,
    ruleIndex=INDEX,
    level=LEVEL,
    message=MESSAGE,
    locations=_list(LOCATION),
    relatedLocations=_list(LOCATION, uniqueItems=True),
    codeFlows=_list(_object(["threadFlows"], threadFlows=_list(STEPS, minItems=1))),
    partialFingerprints={"type": "object", "additionalProperties": TEXT},
    suppressions=_list(
        _object(["kind"], kind={"enum": ["inSource", "external"]}, justification=TEXT),
        uniqueItems=True,
    ),
    properties={"type": "object"},
)
NOTIFICATION = _object(
    ["message"],
    level=LEVEL,
    message=MESSAGE,
    locations=_list(LOCATION, uniqueItems=True),
    associatedRule=_object([], id=TEXT, index=INDEX),
)
INVOCATION = _object(
    ["executionSuccessful"],
    executionSuccessful={"type": "boolean"},
    exitCode={"type": "integer"},
    toolExecutionNotifications=_list(NOTIFICATION),
)
DRIVER = _object(
    ["name"],
    name=TEXT,
    semanticVersion={"type": "string", "pattern": r"^\d+\.\d+\.\d+"},
    rules=_list(RULE, uniqueItems=True),
)
RUN = _object(
    ["tool"],
    tool=_object(["driver"], driver=DRIVER),
    columnKind={"enum": ["utf16CodeUnits", "unicodeCodePoints"]},
    invocations=_list(INVOCATION),
    artifacts=_list(_object([], location=ARTIFACT), uniqueItems=True),
    results=_list(RESULT),
)
SARIF = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    **_object(
        ["version", "runs"],
        **{"$schema": TEXT},
        version={"const": "2.1.0"},
        runs=_list(RUN),
    ),
}
