"""Verdicts of a guarded run, read from its sidecar while it goes on."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import httpx

from ..errors import SidecarGarbled, SidecarRefused, SidecarUnreachable
from ..vocabulary import Outcome, Route, Verdict, from_json

_TIMEOUT_S = 2.0
_EARLY_S = 5.0
"""The sidecar's clock against this machine's, and the time between two requests, s."""


@dataclass(frozen=True)
class WellVerdict:
    """A verdict, with where the liquid went in plain words.

    Attributes:
        recovered: Whether it failed, and the robot put the well right by itself.
    """

    well: str
    verdict: Verdict
    recovered: bool = False

    @property
    def state(self) -> str:
        """How the delivery stands, in one word."""
        if self.recovered:
            return "recovered"
        return "unobserved" if self.verdict.unobserved else self.verdict.outcome.value

    @property
    def is_flagged(self) -> bool:
        """Whether a person should look at it."""
        return self.verdict.outcome is not Outcome.PASS and not self.recovered


def unjudged(run: str, trajectory: int, reason: str) -> Verdict:
    """What a delivery counts as whose verdict never came."""
    return Verdict(run, trajectory, Outcome.UNDECIDED, Route.UNCALIBRATED, reason=reason)


class VerdictReader:
    """Looks into one sidecar for the run that begins now.

    Args:
        url: The sidecar.
        token: Its token, or ``None``.
        protocol: File name of the protocol; of several runs it tells which is meant.
        run: Identifier of the run there, where it is known.
        robot: The robot's name, which tells likewise: others may run the same protocol.

    Attributes:
        run: Identifier of the run there, ``""`` until it is known.
        open: Deliveries without a verdict at the last look, with their wells.
        ended: Whether the run had ended there at the last look.
    """

    def __init__(
        self,
        url: str,
        token: str | None,
        protocol: str = "",
        run: str = "",
        robot: str = "",
    ) -> None:
        self.url = url.rstrip("/")
        self.run = run
        self.open: dict[int, str] = {}
        self.ended = False
        self._protocol = protocol
        self._robot = robot
        self._is_sure = not protocol
        self._since = time.time() - _EARLY_S
        self._seen: dict[int, WellVerdict] = {}
        headers = {"Authorization": f"Bearer {token}"} if token else {}
        self._http = httpx.Client(
            base_url=self.url,
            headers=headers,
            timeout=_TIMEOUT_S,
            trust_env=False,
        )

    def begins(self) -> None:
        """The run begins now: what came before is another one's."""
        self._since = time.time() - _EARLY_S

    def close(self) -> None:
        """Drop the connection."""
        self._http.close()

    def check(self) -> None:
        """Whether it is there and lets us in.

        Raises:
            LinkError: It is not.
        """
        self._ask("/v1/runs")

    def news(self) -> list[WellVerdict]:
        """Verdicts that are new, or that a person or a recovery changed, since the last call.

        Raises:
            LinkError: The sidecar does not answer, or refuses.
        """
        if not self._find():
            return []
        found: list[WellVerdict] = []
        overview = self._ask(f"/v1/runs/{self.run}")
        self.ended = bool(overview.get("finished"))
        self.open = {}
        for trajectory in overview["trajectories"]:
            verdict = self._verdict(trajectory)
            if verdict is None:
                if trajectory.get("abandoned") is None:
                    self.open[trajectory["trajectory"]] = str(trajectory.get("well", ""))
                continue
            recovered = verdict.outcome is Outcome.FAIL and bool(trajectory.get("recovered"))
            known = WellVerdict(str(trajectory.get("well", "")), verdict, recovered)
            before = self._seen.get(verdict.trajectory)
            if before is None or before.state != known.state:
                self._seen[verdict.trajectory] = known
                found.append(known)
        return found

    def _verdict(self, trajectory: Mapping[str, Any]) -> Verdict | None:
        if trajectory.get("verdict") is not None:
            return from_json(Verdict, trajectory["verdict"])
        if reason := trajectory.get("unjudged"):
            return unjudged(self.run, trajectory["trajectory"], str(reason))
        return None

    def close_run(self, outcome: str, detail: str) -> None:
        """Tell how the run ended, where its guard cannot any more. Raises LinkError."""
        if self._find():
            told = {"outcome": outcome, "detail": detail[:2000]}
            if self._get(f"/v1/runs/{self.run}/close", told).is_error:
                raise SidecarGarbled(
                    f"The sidecar at {self.url} did not take down that the run is over; update it."
                )

    def overview(self) -> Mapping[str, Any] | None:
        """All that the sidecar knows of the run, ``None`` if it never came there."""
        return self._ask(f"/v1/runs/{self.run}") if self._find() else None

    def frame(self, sequence: int) -> bytes | None:
        """The frame of a keyframe as JPEG, ``None`` if the sidecar has none.

        Raises:
            LinkError: The sidecar does not answer, or refuses.
        """
        answer = self._get(f"/v1/runs/{self.run}/frames/{sequence}.jpg")
        return answer.content if answer.is_success else None

    def _find(self) -> bool:
        """Whether the run is there. Of several it is that of the robot's name; a run that is the
        only one may be that of a robot which calls itself otherwise.

        Raises:
            LinkError: It cannot be told which one it is.
        """
        if self._is_sure:
            return bool(self.run)
        rows = [
            row
            for row in self._ask("/v1/runs")["runs"]
            if row.get("protocol") == self._protocol and row["registered"] >= self._since
        ]
        own = [row for row in rows if row.get("robot_name") == self._robot]
        if len(rows) > 1 and not own:
            raise SidecarGarbled(
                f"Several runs of {self._protocol} have begun at the sidecar {self.url}, none by "
                f"the name of {self._robot or 'this robot'}: whose verdicts are whose cannot be "
                "told. See the sidecar's page."
            )
        for row in (own or rows)[:1]:
            self.run, self._is_sure = str(row["run"]), bool(own)
        return bool(self.run)

    def _get(self, path: str, told: Mapping[str, Any] | None = None) -> httpx.Response:
        try:
            answer = self._http.request("GET" if told is None else "POST", path, json=told)
        except httpx.HTTPError as error:
            raise SidecarUnreachable(
                f"The sidecar at {self.url} cannot be reached ({error}). Check that it runs and "
                "that the address is right."
            ) from None
        if answer.status_code in (401, 403):
            raise SidecarRefused(f"The sidecar at {self.url} refused the token.")
        return answer

    def _ask(self, path: str) -> Any:
        answer = self._get(path)
        try:
            value = answer.json()
        except ValueError:
            value = None
        if answer.is_error or not isinstance(value, dict):
            raise SidecarGarbled(f"What answers at {self.url} is no aegis-ot sidecar.")
        return value
