"""Reads the bodies of requests, and no more of one than is sensible."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable
from typing import Any, TypeVar

from fastapi import Depends, Request
from pydantic import TypeAdapter, ValidationError
from starlette.requests import ClientDisconnect

from ..vocabulary import Keyframe, to_json
from .wire import MAX_BODY, MAX_COUNT, WireError

T = TypeVar("T")


def body_as(shape: type[T]) -> Any:
    """A dependency that reads the request's body as ``shape``; the description finds it there."""

    async def read(request: Request) -> T:
        return parse(shape, await read_body(request))

    read.shape = shape  # type: ignore[attr-defined]
    return Depends(read)


async def read_body(request: Request, limit: int = MAX_BODY) -> bytes:
    """The body of a request.

    Raises:
        WireError: 413 if it is longer than ``limit`` bytes; 400 if it broke off.
    """
    too_long = WireError(413, "body", f"The body is longer than {limit} bytes.")
    announced = request.headers.get("content-length", "0")
    if not announced.isdecimal() or len(announced) > 12 or int(announced) > limit:
        raise too_long
    body = bytearray()
    try:
        async for chunk in request.stream():
            body += chunk
            if len(body) > limit:
                raise too_long
    except ClientDisconnect:
        raise WireError(400, "body", "The request broke off.") from None
    return bytes(body)


@functools.cache
def _adapter(shape: Any) -> TypeAdapter[Any]:
    """Building one takes milliseconds, using it microseconds."""
    return TypeAdapter(shape)


def parse(shape: Callable[..., T], body: bytes) -> T:
    """Read ``body`` as ``shape``, a pydantic model or a standard dataclass. Strict: no coercion.

    Raises:
        WireError: 422, naming every member that is wrong.
    """
    try:
        value: T = _adapter(shape).validate_json(body, strict=True)
    except ValidationError as error:
        problems = [
            f"{'.'.join(str(part) for part in p['loc']) or 'body'}: {p['msg']}"
            for p in error.errors(include_url=False, include_input=False, include_context=False)
        ]
        shown = "; ".join(problems[:5])
        raise WireError(
            422, "body", f"The body is not a valid {shape.__name__}: {shown}."
        ) from None
    if dataclasses.is_dataclass(value):
        _require_finite(shape.__name__, to_json(value))
    if isinstance(value, Keyframe):
        _check_keyframe(value)
    return value


def _require_finite(name: str, value: Any, path: str = "") -> None:
    if isinstance(value, float) and not math.isfinite(value):
        raise WireError(422, "body", f"{name}.{path} is not a finite number.")
    if isinstance(value, dict):
        for key, item in value.items():
            _require_finite(name, item, f"{path}.{key}" if path else str(key))
    if isinstance(value, list):
        for item in value:
            _require_finite(name, item, path)


def _check_keyframe(keyframe: Keyframe) -> None:
    for name in ("sequence", "trajectory"):
        if not 0 <= getattr(keyframe, name) <= MAX_COUNT:
            raise WireError(422, "body", f"Keyframe.{name} must be from 0 to {MAX_COUNT}.")
    for name in ("commanded_ul", "expected_ul", "capacity_ul"):
        if getattr(keyframe, name) < 0:
            raise WireError(422, "body", f"Keyframe.{name} must not be negative.")
    if not 1 <= keyframe.channels <= 384:
        raise WireError(422, "body", "Keyframe.channels must be from 1 to 384.")
    for name in ("nozzles", "targets", "channels_found"):
        if len(getattr(keyframe, name)) not in (0, keyframe.channels):
            raise WireError(422, "body", f"Keyframe.{name} must be empty, or one per channel.")
