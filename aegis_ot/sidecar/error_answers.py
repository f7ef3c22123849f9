"""Every error is answered in the wire's shape: code, one sentence, what to do."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.responses import JSONResponse, Response

from ..errors import AegisError, CameraError, StoreError
from .wire import WireError


def trouble_of(error: AegisError, **extra: Any) -> WireError:
    """Trouble of the workstation as an answer, with further members of it."""
    code, hint = "trouble", "Run aegis-ot doctor."
    if isinstance(error, CameraError):
        code, hint = "camera", "Check the camera; the keyframe can be resent."
    elif isinstance(error, StoreError):
        code, hint = "store", "Check the workstation; the keyframe can be resent."
    return WireError(503, code, str(error), hint, **extra)


def answer_errors(app: FastAPI) -> None:
    """Every error in the wire's shape."""

    def answer(make: Callable[[Any], WireError]) -> Callable[[Request, Any], Awaitable[Response]]:
        async def handle(_request: Request, error: Any) -> Response:
            told = make(error)
            return JSONResponse(told.body(), told.status)

        return handle

    def invalid(error: RequestValidationError) -> WireError:
        problems = (f"{'.'.join(map(str, p['loc']))}: {p['msg']}" for p in error.errors())
        return WireError(422, "request", "; ".join(problems))

    def http(error: HTTPException) -> WireError:
        if error.status_code == 404:
            return WireError(404, "no_such_address", "There is nothing at this address.")
        return WireError(error.status_code, "http", str(error.detail))

    app.add_exception_handler(WireError, answer(lambda error: error))
    for kind in (CameraError, StoreError, AegisError):
        app.add_exception_handler(kind, answer(trouble_of))
    app.add_exception_handler(RequestValidationError, answer(invalid))
    app.add_exception_handler(HTTPException, answer(http))
    app.add_exception_handler(
        Exception,
        answer(
            lambda error: WireError(
                500,
                "internal",
                f"The sidecar failed: {type(error).__name__}.",
                "Its log says more; please report it.",
            )
        ),
    )
