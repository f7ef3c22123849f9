"""Requests to the robot's own server, and in plain words why one failed."""

from __future__ import annotations

import json
from typing import Any, TypeVar

import httpx

from ..errors import RobotError, RobotRefused, RobotUnreachable
from ..settings import load_settings
from .address import robot_url

_TIMEOUT_S = 10.0
_Connection = TypeVar("_Connection", bound="RobotConnection")


class RobotConnection:
    """Asks one robot's server, with the settings ``robot_token`` and ``robot_reason``.

    Args:
        host: As for :func:`~.address.robot_url`.
        transport: Instead of the network, for tests.

    Every method raises :class:`RobotUnreachable` (no answer in time), :class:`RobotRefused` (by
    the server) or :class:`RobotError` (its answer makes no sense).
    """

    def __init__(self, host: str, transport: httpx.BaseTransport | None = None) -> None:
        self.url = robot_url(host)
        self._http = httpx.Client(
            base_url=self.url,
            headers=load_settings().robot_headers(),
            timeout=_TIMEOUT_S,
            transport=transport,
            trust_env=False,  # a proxy for the internet does not lead to a robot on the bench
        )

    def __enter__(self: _Connection) -> _Connection:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Drop the connection."""
        self._http.close()

    def ask(self, method: str, path: str, **options: Any) -> Any:
        """The answer's JSON."""
        return self.read(self.send(method, path, options))

    def _refusal(self, answer: httpx.Response, asked: str) -> str:
        said = _why(answer)
        known = "Authorization" in self._http.headers
        if answer.status_code == 401 or (answer.status_code == 403 and not known):
            return (
                f"Access to the robot at {self.url} is controlled, and it does not know who asks. "
                f"Give its token as AEGIS_OT_ROBOT_TOKEN. It says: {said}"
            )
        if answer.status_code == 403:
            return (
                f"The token given for the robot at {self.url} does not allow this ({asked}). It "
                f"says: {said}"
            )
        if answer.status_code == 451 or "Opentrons-User-Notes" in said:
            return (
                f"The robot at {self.url} wants a reason for this ({asked}). Give it as "
                f"AEGIS_OT_ROBOT_REASON, beside AEGIS_OT_ROBOT_TOKEN. It says: {said}"
            )
        if answer.status_code == 409 and asked == "POST /runs":
            return (
                f"The robot at {self.url} takes no new run: another one has not ended. End it in "
                f"the Opentrons App or on the robot's screen, then start again. It says: {said}"
            )
        if answer.status_code == 409:
            return f"The robot cannot do that now. It says: {said}"
        return f"The robot at {self.url} refused {asked}: {said}"

    def read(self, answer: httpx.Response) -> Any:
        """The JSON of an answer."""
        try:
            return answer.json()
        except json.JSONDecodeError:
            raise RobotError(
                f"What answers at {self.url} is no robot of Opentrons. Check the address and the "
                "port."
            ) from None

    def send(self, method: str, path: str, options: dict[str, Any]) -> httpx.Response:
        """The answer itself; ``options`` as ``httpx`` takes them."""
        try:
            answer = self._http.request(method, path, **options)
        except httpx.TimeoutException:
            raise RobotUnreachable(f"The robot at {self.url} gave no answer in time.") from None
        except httpx.HTTPError as error:
            raise RobotUnreachable(
                f"The robot at {self.url} cannot be reached ({error}). Check that it is on, that "
                "the address is the one that the Opentrons App shows, and that this computer is "
                "in the same network."
            ) from None
        if answer.is_error:
            raise RobotRefused(self._refusal(answer, f"{method} {path}"), answer.status_code)
        return answer


def _why(answer: httpx.Response) -> str:
    try:
        body = answer.json()
        told = body.get("errors") or [{"detail": body.get("message")}]
        text = str(told[0].get("detail") or told[0].get("title"))
    except (ValueError, AttributeError, IndexError, TypeError):
        text = answer.reason_phrase
    return f"{text.rstrip('.')} (status {answer.status_code})."
