"""Reads the bodies of requests, and no more of one than is sensible."""

from __future__ import annotations

from typing import Any, TypeVar

from fastapi import Depends, Request
from starlette.requests import ClientDisconnect

from .wire import MAX_BODY, WireError, parse

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
