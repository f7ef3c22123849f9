"""The OpenAPI description of the sidecar: ``GET /v1/openapi.json``, for who holds the token."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from fastapi.routing import APIRoute
from pydantic import TypeAdapter

_REF = "#/components/schemas/"
_ERROR = {
    "type": "object",
    "required": ["error"],
    "properties": {
        "error": {
            "type": "object",
            "required": ["code", "message", "hint"],
            "properties": {name: {"type": "string"} for name in ("code", "message", "hint")},
        },
        "expected": {"type": "integer"},
    },
}
ERRORS: dict[int | str, dict[str, Any]] = {
    status: {
        "description": said,
        "content": {"application/json": {"schema": {"$ref": f"{_REF}Error"}}},
    }
    for status, said in (
        (400, "The request broke off, or is no HTTP."),
        (401, "The token is missing or wrong."),
        (403, "Another web site sent this, or the host is another."),
        (404, "There is no such run, frame or address."),
        (409, "It does not fit what is known: `code` says why."),
        (413, "The body is too long."),
        (422, "A value is wrong: `message` says which."),
        (429, "Too many wrong tokens."),
        (503, "The camera gave no frame, or the disk is in trouble: send it again."),
    )
}


def describe(app: FastAPI) -> dict[str, Any]:
    """The description of the application's routes."""
    described = get_openapi(
        title=app.title,
        version=app.version,
        summary="Between robot, sidecar and people",
        routes=app.routes,
    )
    schemas = described.setdefault("components", {}).setdefault("schemas", {})
    schemas["Error"] = _ERROR
    for path, method, shape in _bodies(app):
        schema = TypeAdapter(shape).json_schema(ref_template=_REF + "{model}")
        schemas |= schema.pop("$defs", {})
        schemas[shape.__name__] = schema
        content = {"application/json": {"schema": {"$ref": f"{_REF}{shape.__name__}"}}}
        described["paths"][path][method]["requestBody"] = {"required": True, "content": content}
    described["components"]["schemas"] = schemas
    described["components"]["securitySchemes"] = {"token": {"type": "http", "scheme": "bearer"}}
    described["security"] = [{"token": []}]
    return described


def _bodies(app: FastAPI) -> Iterator[tuple[str, str, type[Any]]]:
    """Path, method and shape of each body that :func:`~.bodies.body_as` reads."""
    for route in app.routes:
        if isinstance(route, APIRoute) and route.include_in_schema:
            for dependency in route.dependant.dependencies:
                if (shape := getattr(dependency.call, "shape", None)) is not None:
                    yield from ((route.path_format, m.lower(), shape) for m in route.methods or ())
