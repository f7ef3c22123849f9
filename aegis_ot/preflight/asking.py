"""The robot asks the sidecar what its model makes of the protocol. Standard library only.

The sidecar asks the model once per dossier and remembers. An analysis waits for the answer as
long as it is configured to; a live run takes what is remembered and waits no longer than a
moment, since nothing may keep a robot from being stopped. Whatever goes wrong is an opinion
that says so: the checks' verdict stands, and the question stays open.
"""

from __future__ import annotations

import http.client
import json
import threading
import time
from dataclasses import replace
from typing import Any
from urllib.parse import urlsplit

from ..settings import Settings
from ..vocabulary import Undecided, from_json
from .judging import MODEL, Reading, Report
from .opinion import Dossier, Opinion, make_dossier, merge

LIVE_WAIT_S = 1.0
"""How long a live run waits for an opinion that should be remembered already, s."""

_REQUEST_S = 5.0
_POLL_S = 0.5
_GRACE_S = 0.25
"""A socket's own timeout comes first, and says more."""

_LONGEST_ANSWER = 1 << 20


def with_opinion(report: Report, reading: Reading, settings: Settings, protocol: Any) -> Report:
    """The checks' report with the opinion of the sidecar's model merged into it.

    Never raises: whatever fails here, the checks' report stands.

    Args:
        report: From :func:`~aegis_ot.preflight.judging.judge_reading`, of the same reading.
        reading: What the report judges.
        settings: The guard's.
        protocol: The context, for whether a robot waits.
    """
    if settings.sidecar is None or not settings.sidecar.startswith("http"):
        return report
    try:
        dossier = make_dossier(reading, report)
        wait_s = settings.opinion_timeout_s
        if not protocol.is_simulating():
            wait_s = min(wait_s, LIVE_WAIT_S)
        opinion = ask_sidecar(settings.sidecar, settings.token, dossier, wait_s)
        return merge(report, opinion, dossier, reading)
    except Exception as error:
        reason = f"The model's opinion could not be had ({type(error).__name__}: {error})."
        return replace(report, undecided=(*report.undecided, Undecided(MODEL, reason)))


def ask_sidecar(address: str, token: str | None, dossier: Dossier, timeout_s: float) -> Opinion:
    """Ask, and wait no longer than ``timeout_s``.

    Args:
        address: Of the sidecar, ``"http://192.168.1.20:7645"``.
        token: It expects, if any.
        dossier: What to ask about.
        timeout_s: Longest wait, s.
    """
    heard: list[Opinion] = []
    thread = threading.Thread(
        target=lambda: heard.append(_exchange(address, token, dossier, timeout_s)),
        name="aegis-ot-opinion",
        daemon=True,
    )
    thread.start()
    # Names that do not resolve and answers that drip outlast every timeout of a socket.
    thread.join(timeout_s + _GRACE_S)
    return heard[0] if heard else _too_late(timeout_s)


def _too_late(timeout_s: float) -> Opinion:
    detail = f"the sidecar has not answered in {timeout_s:g} s."
    return Opinion("timeout", "the sidecar's model", detail)


def _exchange(address: str, token: str | None, dossier: Dossier, timeout_s: float) -> Opinion:
    deadline = time.monotonic() + timeout_s
    line: _Line | None = None
    try:
        line = _Line(address, token)
        answer = line.send("POST", "/v1/opinions", dossier.to_json(), deadline)
        while answer.get("opinion") is None:
            left = deadline - time.monotonic()
            if left <= 0:
                detail = f"it has not answered in {timeout_s:g} s; the next run may find it."
                return Opinion("timeout", "the sidecar's model", detail)
            wait = min(_POLL_S, left)
            path = f"/v1/opinions/{answer['digest']}?wait={wait:.2f}"
            answer = line.send("GET", path, None, deadline)
        return from_json(Opinion, answer["opinion"])
    except TimeoutError:
        return _too_late(timeout_s)
    except (OSError, http.client.HTTPException) as error:
        detail = f"the sidecar cannot be reached ({type(error).__name__})."
        return Opinion("unavailable", "the sidecar's model", detail)
    except _Refused as error:
        return Opinion(error.state, "the sidecar's model", str(error))
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        detail = f"the sidecar's answer makes no sense ({error})."
        return Opinion("invalid", "the sidecar's model", detail)
    finally:
        if line is not None:
            line.close()


class _Refused(Exception):
    def __init__(self, state: str, message: str) -> None:
        super().__init__(message)
        self.state = state


class _Line:
    """One connection to the sidecar."""

    def __init__(self, address: str, token: str | None) -> None:
        parts = urlsplit(address)
        secure = parts.scheme == "https"
        make = http.client.HTTPSConnection if secure else http.client.HTTPConnection
        self._connection = make(parts.hostname or "", parts.port)
        self._base = parts.path.rstrip("/")
        self._headers = {"Content-Type": "application/json"}
        if token:
            self._headers["Authorization"] = f"Bearer {token}"

    def send(self, method: str, path: str, body: Any, deadline: float) -> dict[str, Any]:
        connection = self._connection
        left = deadline - time.monotonic()
        if left <= 0:
            raise TimeoutError
        connection.timeout = min(left, _REQUEST_S)
        if connection.sock is not None:
            connection.sock.settimeout(connection.timeout)
        text = None if body is None else json.dumps(body).encode("utf-8")
        connection.request(method, self._base + path, text, self._headers)
        response = connection.getresponse()
        data = response.read(_LONGEST_ANSWER)
        if response.status in (401, 403):
            raise _Refused("unauthorized", "the sidecar refused the token.")
        if response.status == 404:
            raise _Refused("unavailable", "the sidecar is too old to ask a model.")
        if response.status != 200:
            raise _Refused("unavailable", f"the sidecar answered with HTTP {response.status}.")
        answer = json.loads(data)
        if not isinstance(answer, dict):
            raise ValueError("no object")
        return answer

    def close(self) -> None:
        self._connection.close()
