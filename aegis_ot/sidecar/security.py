"""Who may speak to the sidecar: the bearer token, and browsers that were led astray."""

from __future__ import annotations

import asyncio
import hashlib
import hmac
import threading
import time
from collections import OrderedDict
from urllib.parse import parse_qsl, quote, urlencode, urlsplit

from starlette.datastructures import Headers
from starlette.responses import JSONResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send

from .config import SidecarConfig, is_loopback
from .connections import MOST_AT_ONCE, let_in
from .journal import event
from .rate_limit import PER_SECOND, RateLimit
from .wire import WireError

COOKIE = "aegis_ot"
COOKIE_S = 30 * 86400
FREE_TRIES = 3
LONGEST_WAIT_S = 60.0
SLOW_S = 1.0
"""How long the answer to a wrong token is kept back, s."""
MOST_SLOWED = 16
"""Wrong tokens that are answered slowly at once; further ones are turned away."""
OPEN = {"/v1/health", "/login"}
OPEN_BELOW = "/static/"


class Doorkeeper:
    """ASGI middleware. Lets through what carries the token: bearer header, cookie, or ``?token=``.

    Without a token only this machine can connect, but a web page that its browser shows could
    still send requests here: so the ``Host`` must be this machine (DNS rebinding) and a foreign
    ``Origin`` may change nothing (cross-site requests).
    """

    def __init__(self, app: ASGIApp, config: SidecarConfig) -> None:
        self._app = app
        self._token = None if config.token is None else config.token.get_secret_value()
        self._url = _netloc(config.url or "")
        self._slowed = 0
        self._inside = 0
        self._rate = RateLimit()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        if scope["type"] != "http":
            return
        refusal = self._judge_rate(scope) or self._judge(scope)
        if refusal is None:
            await self._enter(scope, receive, send)
        else:
            if refusal.status_code == 401:
                refusal = await self._slow(scope, refusal)
            await refusal(scope, receive, send)

    async def _enter(self, scope: Scope, receive: Receive, send: Send) -> None:
        if self._token is None or not _is_open(scope["path"]):
            let_in(scope)
        if self._inside >= MOST_AT_ONCE:
            crowded = _refuse(
                503, "crowded", f"The sidecar answers {MOST_AT_ONCE} requests already.",
                "Look who asks it so much; what was sent can be sent again.",
            )  # fmt: skip
            await crowded(scope, receive, send)
            return
        self._inside += 1
        try:
            await self._app(scope, receive, send)
        finally:
            self._inside -= 1

    async def _slow(self, scope: Scope, refusal: Response) -> Response:
        """Guessing is slow and leaves a trace; asking without a token is neither."""
        if not _given(scope):
            return refusal
        event("login", ok=False, address=client_of(scope), path=scope["path"])
        if self._slowed >= MOST_SLOWED:
            return _refuse(429, "slow", "Too many wrong tokens at once.", "Give the right token.")
        self._slowed += 1
        try:
            await asyncio.sleep(SLOW_S)
        finally:
            self._slowed -= 1
        return refusal

    def _judge_rate(self, scope: Scope) -> Response | None:
        if self._rate.takes(client_of(scope)):
            return None
        answer = _refuse(
            429, "rate", f"More than {PER_SECOND:g} requests a second came from this address.",
            "Ask less often.",
        )  # fmt: skip
        answer.headers["Retry-After"] = "1"
        return answer

    def _judge(self, scope: Scope) -> Response | None:
        headers = Headers(scope=scope)
        path: str = scope["path"]
        changes = scope["method"] not in ("GET", "HEAD", "OPTIONS")
        if changes and self._is_foreign(headers):
            return _refuse(
                403, "origin", "Another web site sent this request; it is refused.",
                "If it was the sidecar's own page, behind a proxy: set url to the address that the "
                "browser shows.",
            )  # fmt: skip
        if self._token is None:
            host = headers.get("host", "")
            if is_loopback(_host_name(host)):
                return None
            return _refuse(
                403,
                "host",
                "Without a token this sidecar answers to 127.0.0.1 and localhost only.",
                "Use that address, or set a token.",
            )
        if _is_open(path):
            return None
        return self._judge_token(scope, headers, self._token)

    def _is_foreign(self, headers: Headers) -> bool:
        """Whether another site's page had the browser send this. Behind a proxy that does not pass
        ``Host`` on, the browser's own word, which no page can forge, or the settings tell."""
        origin = headers.get("origin")
        if origin is None or headers.get("sec-fetch-site") == "same-origin":
            return False
        return _netloc(origin) not in (headers.get("host", "").lower(), self._url or None)

    def _judge_token(self, scope: Scope, headers: Headers, token: str) -> Response | None:
        path: str = scope["path"]
        scheme, _, given = headers.get("authorization", "").partition(" ")
        if scheme.lower() == "bearer" and same(given.strip(), token):
            return None
        if any(same(cookie, cookie_value(token)) for cookie in _cookies(headers)):
            return None
        query = parse_qsl(scope["query_string"].decode("latin-1"), keep_blank_values=True)
        in_query = next((value for name, value in query if name == "token"), "")
        if same(in_query, token):
            if path.startswith("/v1/"):
                return None
            # Keep the token out of the address bar, the history and the referrer.
            rest = urlencode([(name, value) for name, value in query if name != "token"])
            answer = RedirectResponse(
                quote("/" + path.lstrip("/\\")) + (f"?{rest}" if rest else ""), 303
            )
            set_cookie(answer, token)
            return answer
        if path.startswith("/v1/"):
            return _refuse(
                401,
                "token",
                "The token is missing or wrong.",
                "Give the sidecar's token to the guard (token=..., or AEGIS_OT_TOKEN).",
            )
        return RedirectResponse("/login", 303)


class LoginThrottle:
    """Makes who gives wrong tokens wait: 1, 2, 4 ... 60 s after the third."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._wrong: OrderedDict[str, tuple[int, float]] = OrderedDict()

    def wait(self, who: str) -> float:
        """How long this address has to wait still, s."""
        with self._lock:
            times, last = self._wrong.get(who, (0, 0.0))
        if times < FREE_TRIES:
            return 0.0
        pause = min(2.0 ** (times - FREE_TRIES), LONGEST_WAIT_S)
        return max(0.0, last + pause - time.monotonic())

    def wrong(self, who: str) -> None:
        """It gave a wrong token."""
        now = time.monotonic()
        with self._lock:
            times, last = self._wrong.pop(who, (0, now))
            self._wrong[who] = (1 if now - last > 3600 else times + 1, now)
            while len(self._wrong) > 1000:  # a flood of addresses must not fill memory
                self._wrong.popitem(last=False)


def _is_open(path: str) -> bool:
    """Whether nobody needs a token for it."""
    return path in OPEN or path.startswith(OPEN_BELOW)


def client_of(scope: Scope) -> str:
    """The address that a request came from."""
    client = scope.get("client")
    return str(client[0]) if client else "unknown"


def _given(scope: Scope) -> bool:
    """Whether the request brings anything that should be a token."""
    headers = Headers(scope=scope)
    return "authorization" in headers or b"token=" in scope["query_string"]


def same(given: str, wanted: str) -> bool:
    """Compare in constant time."""
    return hmac.compare_digest(
        given.encode("utf-8", "surrogatepass"), wanted.encode("utf-8", "surrogatepass")
    )


def cookie_value(token: str) -> str:
    """What the browser keeps: proof of the token, not the token."""
    return hmac.new(token.encode(), b"aegis-ot page", hashlib.sha256).hexdigest()


def set_cookie(answer: Response, token: str) -> None:
    """Let the browser in from now on."""
    answer.set_cookie(
        COOKIE, cookie_value(token), max_age=COOKIE_S, httponly=True, samesite="strict"
    )


def _cookies(headers: Headers) -> list[str]:
    """The sidecar's cookies. Others come along from whatever else runs at this host's name, well
    formed or not; one of ours may stand beside."""
    parts = (part.partition("=") for part in headers.get("cookie", "").split(";"))
    return [value.strip().strip('"') for name, _, value in parts if name.strip() == COOKIE]


def _netloc(origin: str) -> str:
    try:
        return urlsplit(origin).netloc.lower()
    except ValueError:
        return ""


def _host_name(host: str) -> str:
    """``Host`` without its port: ``127.0.0.1:7645`` or ``[::1]:7645``."""
    if host.startswith("["):
        return host[1:].partition("]")[0]
    return host.partition(":")[0].lower()


def _refuse(status: int, code: str, message: str, hint: str) -> Response:
    error = WireError(status, code, message, hint)
    headers = {"WWW-Authenticate": "Bearer"} if status == 401 else None
    return JSONResponse(error.body(), status, headers)
