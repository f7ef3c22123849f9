"""Sends the lineage of a run that has ended to an ELN or LIMS, signed. It never stops a run."""

from __future__ import annotations

import hashlib
import hmac
import json
import logging
import threading
import time
from collections.abc import Callable, Sequence
from typing import Any

from ..errors import AegisError
from .background import BackgroundWorker
from .config import WebhookSettings
from .journal import event

log = logging.getLogger(__name__)

RETRIES_S = (2.0, 15.0, 60.0, 300.0)
"""How long to wait before each further try, s."""
TIMEOUT_S = 15.0
_BY_HAND = "aegis-ot runs export --lineage writes it."
ASKS_S = 0.5
"""How often it is asked whether all verdicts of an ended run are in, s."""


def signature(secret: str, timestamp: str, body: bytes) -> str:
    """What ``X-Aegis-Signature`` holds: HMAC-SHA-256 over moment, a dot and body."""
    code = hmac.new(secret.encode(), timestamp.encode() + b"." + body, hashlib.sha256)
    return f"sha256={code.hexdigest()}"


class WebHook(BackgroundWorker[str]):
    """Sends each ended run in a thread of its own, one after the other.

    Args:
        settings: Where to, and the secret; without an address nothing is sent.
        document: Makes what is sent of a run; called in that thread.
        settled: Whether all that a run's robot sent has been judged.
        failed: Told of a run that could not be delivered, and why; likewise.
        retries_s: See :data:`RETRIES_S`.
    """

    def __init__(
        self,
        settings: WebhookSettings,
        document: Callable[[str], dict[str, Any]],
        settled: Callable[[str], bool],
        failed: Callable[[str, str], None],
        retries_s: Sequence[float] = RETRIES_S,
    ) -> None:
        self._settings, self._document = settings, document
        self._settled, self._failed, self._retries_s = settled, failed, tuple(retries_s)
        self._left: list[str] = []  # neither sent nor told of
        self._leaving = threading.Lock()
        super().__init__("webhook", starts=settings.url is not None)

    def add(self, run: str) -> None:
        """A run has ended. Never blocks."""
        if self._thread is not None and not self._closing.is_set():
            with self._leaving:
                self._left.append(run)
            self._tasks.put(run)

    def close(self, timeout: float = 3.0) -> None:
        """Try once what waits, for at most ``timeout`` seconds, and tell of what is left.
        Idempotent."""
        super().close(timeout)
        for run in dict.fromkeys(self._left):
            self._give_up(
                run, f"The sidecar was stopped before the web hook had taken the record. {_BY_HAND}"
            )

    def _settle(self, run: str) -> bool:
        """Whether nobody has told of the run yet; from now on somebody has."""
        with self._leaving:
            is_left = run in self._left
            if is_left:
                self._left.remove(run)
        return is_left

    def _give_up(self, run: str, why: str) -> None:
        if self._settle(run):
            self._failed(run, why)

    def _do(self, task: str) -> None:
        try:
            while not self._settled(task) and not self._closing.wait(ASKS_S):
                pass
            self._deliver(task)
        except AegisError as error:
            self._give_up(task, f"The record was not sent: {error}")
        except Exception as error:
            self._give_up(task, f"The record was not sent ({type(error).__name__}). {_BY_HAND}")
            raise

    def _deliver(self, run: str) -> None:
        body = json.dumps({"event": "run.ended", **self._document(run)}).encode()
        why = ""
        for pause in (0.0, *self._retries_s):
            if pause and self._closing.wait(pause):
                break
            why = self._post(run, body)
            if not why:
                self._settle(run)
                event("webhook", run=run)
                return
        log.warning("The record of run %s was not delivered: %s", run, why)
        self._give_up(run, f"The record was not delivered to the web hook: {why}. {_BY_HAND}")

    def _post(self, run: str, body: bytes) -> str:
        """What went wrong; nothing if it was taken. The address may hold a password: it is not
        said."""
        import httpx

        assert self._settings.url is not None
        assert self._settings.secret is not None
        now = str(int(time.time()))
        headers = {
            "Content-Type": "application/json",
            "X-Aegis-Timestamp": now,
            "X-Aegis-Delivery": hashlib.sha256(run.encode() + body).hexdigest()[:32],
            "X-Aegis-Signature": signature(self._settings.secret.get_secret_value(), now, body),
        }
        url = self._settings.url.get_secret_value()
        try:
            answer = httpx.post(url, content=body, headers=headers, timeout=TIMEOUT_S)
        except (httpx.HTTPError, httpx.InvalidURL, UnicodeError) as error:
            return f"no answer ({type(error).__name__})"
        return "" if answer.is_success else f"it answered {answer.status_code}"
