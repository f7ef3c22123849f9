"""The robot asks the sidecar what its model makes of the protocol. Standard library only.

The sidecar asks the model once per dossier and remembers. An analysis waits for the answer as
long as it is configured to; a live run takes what is remembered and waits no longer than a
moment, since nothing may keep a robot from being stopped. Whatever goes wrong is an opinion
that says so: the checks' verdict stands, and the question stays open.
"""

from __future__ import annotations

import http.client
import json
import time
from contextlib import closing
from dataclasses import replace
from typing import Any

from ..http_client import HttpClient
from ..settings import Settings
from ..vocabulary import Undecided, from_json, to_json
from .judging import MODEL, Reading, Report
from .opinion import Dossier, Opinion, make_dossier, merge

LIVE_WAIT_S = 1.0
"""How long a live run waits for an opinion that should be remembered already, s."""

_REQUEST_S = 5.0
_POLL_S = 0.5

_WHO = "the sidecar's model"


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
        return merge(report, opinion, reading)
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
    try:
        with closing(HttpClient(address, token)) as client:
            return _exchange(client, dossier, timeout_s)
    except TimeoutError:
        state, detail = "timeout", f"the sidecar has not answered in {timeout_s:g} s."
    except (OSError, http.client.HTTPException) as error:
        state = "unavailable"
        detail = f"the sidecar cannot be reached ({type(error).__name__})."
    except _Refused as error:
        state, detail = error.state, str(error)
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        state, detail = "invalid", f"the sidecar's answer makes no sense ({error})."
    return Opinion(state, _WHO, detail)


def _exchange(client: HttpClient, dossier: Dossier, timeout_s: float) -> Opinion:
    deadline = time.monotonic() + timeout_s
    answer = _send(client, "POST", "/v1/opinions", to_json(dossier), deadline)
    while answer.get("opinion") is None:
        left = deadline - time.monotonic()
        if left <= 0:
            detail = f"it has not answered in {timeout_s:g} s; the next run may find it."
            return Opinion("timeout", _WHO, detail)
        path = f"/v1/opinions/{answer['digest']}?wait={min(_POLL_S, left):.2f}"
        answer = _send(client, "GET", path, None, deadline)
    return from_json(Opinion, answer["opinion"])


def _send(client: HttpClient, method: str, path: str, body: Any, deadline: float) -> dict[str, Any]:
    left = deadline - time.monotonic()
    if left <= 0:
        raise TimeoutError
    status, data = client.request(method, path, body, min(left, _REQUEST_S))
    if status in (401, 403):
        raise _Refused("unauthorized", "the sidecar refused the token.")
    if status == 404:
        raise _Refused("unavailable", "the sidecar is too old to ask a model.")
    if status != 200:
        raise _Refused("unavailable", f"the sidecar answered with HTTP {status}.")
    answer = json.loads(data)
    if not isinstance(answer, dict):
        raise ValueError("no object")
    return answer


class _Refused(Exception):
    def __init__(self, state: str, message: str) -> None:
        super().__init__(message)
        self.state = state
