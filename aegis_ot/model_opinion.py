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

from .http_client import HttpClient
from .preflight.judging import MODEL, Interpretation, Report
from .preflight.opinion import make_dossier, merge
from .settings import Settings
from .vocabulary import Dossier, Opinion, Undecided, from_json, to_json

LIVE_WAIT_S = 1.0
"""How long a live run waits for an opinion that should be remembered already, s."""

_REQUEST_S = 5.0
_POLL_S = 0.5

_WHO = "the sidecar's model"


def with_opinion(
    report: Report, reading: Interpretation, settings: Settings, protocol: Any
) -> Report:
    """The checks' report with the opinion of the sidecar's model merged into it.

    Never raises: whatever fails here, the checks' report stands. The protocol's context tells
    whether a robot waits.
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
    """Ask the sidecar at ``"http://192.168.1.20:7645"``, and wait ``timeout_s`` at most."""
    deadline = time.monotonic() + timeout_s
    try:
        with closing(HttpClient(address, token)) as client:
            answer = _send(client, "POST", "/v1/opinions", to_json(dossier), deadline)
            while answer.get("opinion") is None:
                left = deadline - time.monotonic()
                if left <= 0:
                    told = f"it has not answered in {timeout_s:g} s; the next run may find it."
                    raise _Refused("timeout", told)
                path = f"/v1/opinions/{answer['digest']}?wait={min(_POLL_S, left):.2f}"
                answer = _send(client, "GET", path, None, deadline)
            return from_json(Opinion, answer["opinion"])
    except TimeoutError:
        state, detail = "timeout", f"the sidecar has not answered in {timeout_s:g} s."
    except (OSError, http.client.HTTPException) as error:
        state = "unavailable"
        detail = f"the sidecar cannot be reached ({type(error).__name__})."
    except _Refused as error:
        state, detail = error.args
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        state, detail = "invalid", f"the sidecar's answer makes no sense ({error})."
    return Opinion(state, _WHO, detail)


def _send(client: HttpClient, method: str, path: str, body: Any, deadline: float) -> dict[str, Any]:
    left = deadline - time.monotonic()
    if left <= 0:
        raise TimeoutError
    status, data = client.request(method, path, body, min(left, _REQUEST_S))
    if status in (401, 403):
        raise _Refused("unauthorized", "the sidecar refused the token.")
    if status != 200:
        too_old = "the sidecar is too old to ask a model."
        told = too_old if status == 404 else f"the sidecar answered with HTTP {status}."
        raise _Refused("unavailable", told)
    answer = json.loads(data)
    if not isinstance(answer, dict):
        raise ValueError("no object")
    return answer


class _Refused(Exception):
    """The state of the opinion, and why."""
