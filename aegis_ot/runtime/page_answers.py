"""What a person answers on the sidecar's page while the robot is paused, and having it done.

A paused protocol can only be resumed or stopped from outside: by the robot's own server, as its
screen and the App do it. The sidecar cannot always reach that server; this process can.
"""

from __future__ import annotations

import http.client
import json
import threading
import time
from collections.abc import Callable, Mapping
from typing import Any

from ..errors import LinkError
from ..http_client import CheckStop, HttpClient
from .sidecar_client import SidecarClient

ROBOT_SERVER = "http://127.0.0.1:31950"
_TIMEOUT_S = 5.0
_EVERY_S = 0.5
_ASK_S = 2.0

_DOES = {"resume": "play", "stop": "stop"}

Announce = Callable[[SidecarClient], None]
"""Tells the sidecar of the pause; raises LinkError where it does not hear."""


class _Answered(Exception):
    """The pause is over; whatever is asked now is of no interest."""


class PageAnswers:
    """Asks about one trajectory in a thread, for as long as the block lasts.

    Args:
        link: Makes a connection of the thread's own.
        run: Identifier of the run at present: a sidecar may give it another.
        number: Of the trajectory that the robot is paused at.
        paused: Whether the robot is paused; an answer given before that would be lost.
        announce: Tried until the sidecar has heard; ``None`` where it was told already.
        headers: Of requests to the robot's own API.

    Attributes:
        given: Whether an answer was carried out.
    """

    def __init__(
        self,
        link: Callable[[CheckStop], SidecarClient],
        run: Callable[[], str],
        number: int,
        paused: Callable[[], bool],
        announce: Announce | None = None,
        headers: Mapping[str, str] | None = None,
    ) -> None:
        self.given = False
        self._run = run
        self._number = number
        self._paused = paused
        self._announce = announce
        self._headers = headers
        self._began = time.monotonic()
        self._over = threading.Event()
        self._link = link(self._check)
        self._thread = threading.Thread(target=self._work, name="page-answers", daemon=True)

    def __enter__(self) -> PageAnswers:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        # Not joined: a stop must not wait for a robot server that answers slowly.
        self._over.set()

    def ask(self, timeout_s: float = _ASK_S) -> str | None:
        """What was told since the pause began: ``"resume"``, ``"stop"``, or ``None``."""
        try:
            if self._announce is not None:
                self._announce(self._link)
                self._announce = None
        except LinkError:
            pass  # its store is full, say: it may answer all the same
        try:
            within = time.monotonic() - self._began
            return self._link.action(self._run(), self._number, within, timeout_s)
        except LinkError:
            return None

    def close(self) -> None:
        """Drop the connection."""
        self._link.close()

    def _check(self) -> None:
        if self._over.is_set():
            raise _Answered

    def _work(self) -> None:
        try:
            while True:
                action = self.ask()
                if action in _DOES and self._paused() and not self._over.is_set():
                    self.given = True
                    self.given = act_on_current_run(_DOES[action], self._headers)
                if self._over.wait(_EVERY_S):
                    return
        except _Answered:
            pass
        finally:
            self.close()


def act_on_current_run(action: str, headers: Mapping[str, str] | None = None) -> bool:
    """Have the robot's server ``"play"``, ``"pause"`` or ``"stop"`` its current run.

    Returns:
        Whether it took the order.
    """
    robot = HttpClient(ROBOT_SERVER, None, headers={"Opentrons-Version": "*", **(headers or {})})
    try:
        current = _ask(robot, "GET", "/runs?pageLength=1")
        href = current["links"]["current"]["href"]
        robot.close()  # on a kept connection that is gone the order would be sent again
        _ask(robot, "POST", f"{href}/actions", {"data": {"actionType": action}})
    except (OSError, http.client.HTTPException, ValueError, KeyError, TypeError):
        return False
    finally:
        robot.close()
    return True


def _ask(robot: HttpClient, method: str, path: str, body: Any = None) -> Any:
    status, answer = robot.request(method, path, body, _TIMEOUT_S)
    if status not in (200, 201):
        raise ValueError(f"status {status}")
    return json.loads(answer)
