"""One connection to one server, kept open, for small JSON bodies."""

from __future__ import annotations

import http.client
import json
from collections.abc import Mapping
from typing import Any
from urllib.parse import urlsplit

from .interruptible_socket import CheckStop, InterruptibleSocket, Waiter, connect

_LONGEST_ANSWER = 4_000_000


class HttpClient:
    """Sends requests that may be sent again without harm.

    No wait outlasts its deadline: neither for a name that does not resolve nor for an answer
    that drips. Proxies are ignored.

    Args:
        url: ``http://host:port`` or ``https://host:port``, with or without a path.
        token: Bearer token, or ``None``.
        check_stop: Called at least every 0.15 s during every wait; whatever it raises ends the
            request and reaches the caller.
        headers: Sent with each request.
    """

    def __init__(
        self,
        url: str,
        token: str | None,
        check_stop: CheckStop = lambda: None,
        headers: Mapping[str, str] | None = None,
    ) -> None:
        parts = urlsplit(url)
        self._host = parts.hostname or ""
        self._tls = parts.scheme == "https"
        self._port = parts.port or (443 if self._tls else 80)
        self._path = parts.path.rstrip("/")
        self._headers = {
            "Accept": "application/json",
            "Connection": "keep-alive",
            **(headers or {}),
        }
        if token:
            self._headers["Authorization"] = f"Bearer {token}"
        self._waiter = Waiter(check_stop)
        self._sock: InterruptibleSocket | None = None

    def request(self, method: str, path: str, body: Any, timeout_s: float) -> tuple[int, bytes]:
        """Status and body of the answer.

        Args:
            method: ``"GET"``, ``"POST"``...
            path: Below the client's address, with a leading slash.
            body: Sent as JSON unless ``None``.
            timeout_s: For the whole exchange, s.

        Raises:
            TimeoutError: It took longer.
            OSError: The server cannot be reached.
            http.client.HTTPException, ValueError: What came is no HTTP.
        """
        self._waiter.begin(timeout_s)
        fresh = self._sock is None
        try:
            try:
                return self._exchange(method, path, body)
            except (OSError, http.client.HTTPException):
                # A kept connection may have been closed meanwhile: once more on a new one.
                if fresh or self._waiter.left <= 0:
                    raise
                self.close()
                return self._exchange(method, path, body)
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Drop the connection; the next request opens another."""
        if self._sock is not None:
            self._sock.close()
            self._sock = None

    def _exchange(self, method: str, path: str, body: Any) -> tuple[int, bytes]:
        if self._sock is None:
            self._sock = connect(self._host, self._port, self._tls, self._waiter)
        connection = http.client.HTTPConnection(self._host, self._port)
        connection.auto_open = 0
        connection.sock = self._sock
        headers = dict(self._headers)
        payload = None
        if body is not None:
            payload = json.dumps(body).encode()
            headers["Content-Type"] = "application/json"
        connection.request(method, self._path + path, body=payload, headers=headers)
        # Not by the connection: it closes the socket of an answer that is the last one at once, and
        # the body may still be on its way.
        response = http.client.HTTPResponse(self._sock, method=method)  # type: ignore[arg-type]
        response.begin()
        data = response.read(_LONGEST_ANSWER + 1)
        if len(data) > _LONGEST_ANSWER:
            raise http.client.HTTPException("endless answer")
        if response.will_close:
            self.close()
        return response.status, data
