"""A dry run that a person follows on the live page, and answers there like at a robot."""

from __future__ import annotations

import json
import time
import urllib.request
from typing import Any

from ..adapters.opentrons.instrumentation import Operation, OperationKind
from ..errors import RunAborted
from ..sidecar import Judged
from ..vocabulary import Outcome

_LOOPBACK = urllib.request.build_opener(urllib.request.ProxyHandler({}))

_ASK_S = 1.0
"""Longest wait of one request, s."""

_STEP_S = {OperationKind.ASPIRATE: 0.4, OperationKind.DISPENSE: 0.4}
"""What a robot's stroke takes about, s: at a simulator's own speed nobody could follow."""


class PageOperator:
    """Plays the robot that stands still until somebody answers on the page.

    A simulation has no pause: the guard says that it would be one, and goes on. This one stands
    between the guard and the simulator's next move.

    Args:
        url: The sidecar's address; it wants no token.
        run: Identifier of the run.
    """

    def __init__(self, url: str, run: str) -> None:
        self._run = f"{url}/v1/runs/{run}"
        self._nonce = ""
        self._bad: list[int] = []

    def judged(self, judged: Judged) -> None:
        """A verdict is in (called from the sidecar's worker)."""
        if judged[0].outcome is not Outcome.PASS:
            self._bad.append(judged[0].trajectory)

    def moves(self, operation: Operation) -> None:
        """Before the simulator's next move.

        Raises:
            RunAborted: Somebody stopped the run on the page.
        """
        for number in list(self._bad):
            hold = self._pause_at(number)
            if hold is not None:
                self._bad.remove(number)
                self._wait(number, hold)
        time.sleep(_STEP_S.get(operation.kind, 0.0))

    def _pause_at(self, number: int) -> dict[str, Any] | None:
        run = self._ask("")
        self._nonce, entries = str(run["nonce"]), run["trajectories"]
        holds: list[dict[str, Any]] = next(
            (one["holds"] for one in entries if one["trajectory"] == number), []
        )
        paused = [hold for hold in holds if hold["policy"] == "pause"]
        return paused[-1] if paused else None

    def _wait(self, number: int, hold: dict[str, Any]) -> None:
        began = time.monotonic()
        told = None
        while told is None:
            told = self._ask(f"/trajectories/{number}/action?wait={_ASK_S}")["action"]
        if told["action"] == "stop":
            raise RunAborted(f"{told['by']} ended the run on the sidecar's page.")
        lasted = {"paused_s": round(time.monotonic() - began, 3), "answered": "page"}
        self._tell("/hold", {k: v for k, v in hold.items() if k != "at"} | lasted)

    def _ask(self, path: str) -> Any:
        headers = {"X-Aegis-Start": self._nonce}
        request = urllib.request.Request(self._run + path, headers=headers)
        with _LOOPBACK.open(request, timeout=10) as answer:
            return json.loads(answer.read())

    def _tell(self, path: str, body: Any) -> None:
        data, headers = json.dumps(body).encode(), {"X-Aegis-Start": self._nonce}
        request = urllib.request.Request(self._run + path, data=data, headers=headers)
        with _LOOPBACK.open(request, timeout=10):
            pass
