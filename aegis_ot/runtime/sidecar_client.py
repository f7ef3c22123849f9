"""The robot's side of ``docs/reference/wire.md``, with the standard library alone.

One connection is kept open. Every request may be sent again without harm: the sidecar
recognises a keyframe by run and sequence number and counts it once.
"""

from __future__ import annotations

import http.client
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any
from urllib.parse import quote

from ..errors import LinkError, SidecarGarbled, SidecarRefused, SidecarUnreachable
from ..http_client import CheckStop, HttpClient
from ..vocabulary import Keyframe, Verdict, from_json, to_json

WIRE_VERSION = 1
_WAY_S = 0.5
"""A request may be on its way for so long, s."""


class RunUnknown(LinkError):
    """The sidecar does not know this start: it was restarted without its store, or has another run
    of this name."""


class SequenceGap(LinkError):
    """409: keyframes are missing on the sidecar's side.

    Attributes:
        expected: The sequence number to go on from.
    """

    def __init__(self, message: str, expected: int) -> None:
        super().__init__(message)
        self.expected = expected


class CameraSilent(LinkError):
    """503: the sidecar is there, but its camera gave no frame that tells anything, or its store is
    full; the keyframe may be sent again."""


class SidecarBusy(LinkError):
    """429, or a 503 that is not the camera's or the store's: the sidecar, or a proxy before it, has
    too much to do for this request."""


@dataclass(frozen=True)
class Acknowledgement:
    """Acknowledgement of one keyframe.

    Attributes:
        sequence: Which one.
        exposed_after_s: Time from the request to the exposure, s; ``None`` if not said.
    """

    sequence: int
    exposed_after_s: float | None


@dataclass(frozen=True)
class Order:
    """What a person tells a robot that moves, on the sidecar's page.

    Attributes:
        action: ``"pause"`` or ``"stop"``.
        by: Who.
        at: When, on the sidecar's clock: an order has a moment of its own.
    """

    action: str
    by: str
    at: float


class SidecarClient:
    """Speaks to one sidecar about one run.

    Args:
        url: ``http://host:port`` or ``https://host:port``.
        token: Bearer token, or ``None``.
        check_stop: Called at least every 0.15 s during every wait; whatever it raises ends the
            request and reaches the caller.
        nonce: Drawn anew for each start of a run: tells it from another one of the same name.

    Attributes:
        order: The last one that came with an answer.

    Every method raises :class:`SidecarUnreachable`, :class:`SidecarRefused` or
    :class:`SidecarGarbled`, with the address, what happened and what to do.
    """

    def __init__(self, url: str, token: str | None, check_stop: CheckStop, nonce: str = "") -> None:
        self.url = url
        self.order: Order | None = None
        self.nonce = nonce
        headers = {"X-Aegis-Start": nonce} if nonce else {}
        self._http = HttpClient(url, token, check_stop, headers)

    def health(self, timeout_s: float) -> dict[str, Any]:
        """What the sidecar says of itself."""
        return self._request("GET", "/v1/health", None, timeout_s)

    def start(self, run: str, about: Mapping[str, Any], timeout_s: float) -> str:
        """Register the run; the same start twice is the same run.

        Returns:
            What it is called from now on: another name where another start has this one.
        """
        body = {**about, "run": run, "nonce": self.nonce}
        answer = self._request("PUT", f"/v1/runs/{quote(run, safe='')}", body, timeout_s)
        wire = answer.get("wire")
        if wire != WIRE_VERSION:
            raise self._garbled(
                f"it speaks wire version {wire!r}, this robot {WIRE_VERSION}",
                "install the same version of aegis-ot on both machines",
            )
        own = self.nonce[:8]
        if answer.get("nonce", "") != self.nonce and own not in run:
            # An older sidecar takes all starts of a name for one.
            return self.start(f"{run}-{own}", about, timeout_s)
        return str(answer.get("run") or run)

    def keyframe(self, keyframe: Keyframe, timeout_s: float, ago_s: float = 0.0) -> Acknowledgement:
        """Have one keyframe captured.

        Args:
            keyframe: Which.
            timeout_s: How long it may take.
            ago_s: How long ago its moment was, where the robot has not waited for this, s.

        Raises:
            CameraSilent: The camera gave no frame in time.
            SequenceGap: Earlier keyframes have to be sent first.
            RunUnknown: The run has to be registered again.
        """
        path = f"/v1/runs/{quote(keyframe.run, safe='')}/keyframes"
        if ago_s:
            path += f"?ago={ago_s:.4f}"
        elif not keyframe.late:  # whoever waits for the answer stands still, but the way takes time
            path += f"?stands={timeout_s - min(_WAY_S, timeout_s / 4):.3f}"
        answer = self._request("POST", path, to_json(keyframe), timeout_s)
        if answer.get("captured") is not True or answer.get("sequence") != keyframe.sequence:
            raise self._garbled(f"it did not acknowledge keyframe {keyframe.sequence}")
        delay: Any = answer.get("exposed_after_s")
        known = isinstance(delay, (int, float)) and not isinstance(delay, bool)
        return Acknowledgement(keyframe.sequence, float(delay) if known else None)

    def verdict(self, run: str, number: int, wait_s: float, timeout_s: float) -> Verdict | None:
        """The verdict on one trajectory, ``None`` if it is not in after ``wait_s``."""
        path = f"{_trajectory(run, number)}/verdict?wait={wait_s:g}"
        answer = self._request("GET", path, None, timeout_s)
        if "verdict" not in answer:
            raise self._garbled(f"its answer for trajectory {number} holds no verdict field")
        if answer["verdict"] is None:
            return None
        try:
            verdict = from_json(Verdict, answer["verdict"])
        except ValueError as error:
            raise self._garbled(f"its verdict on trajectory {number} is wrong ({error})") from None
        if (verdict.run, verdict.trajectory) != (run, number):
            raise self._garbled(f"it sent another trajectory's verdict for trajectory {number}")
        return verdict

    def action(self, run: str, number: int, within_s: float, timeout_s: float) -> str | None:
        """What a person told the robot that has been paused at a trajectory for ``within_s``
        seconds: ``"resume"``, ``"stop"``, or ``None`` as long as nobody did."""
        path = f"{_trajectory(run, number)}/action?within={within_s:.2f}"
        answer = self._request("GET", path, None, timeout_s)
        action = answer.get("action")
        return str(action.get("action")) if isinstance(action, dict) else None

    def report(self, run: str, what: str, body: Mapping[str, Any], timeout_s: float) -> None:
        """Report of a run ``"hold"``: how long the robot held, and what ended it; ``"recovery"``:
        how it puts a failed delivery right, or why it does not; ``"incident"``: for how long there
        was no link, or what the run does otherwise than its rehearsal;
        ``"trajectories/3/abandon"``: that one will have no further keyframes."""
        self._request("POST", f"/v1/runs/{quote(run, safe='')}/{what}", dict(body), timeout_s)

    def finish(
        self,
        run: str,
        outcome: str,
        detail: str,
        timeout_s: float,
        told: Mapping[str, Any] | None = None,
    ) -> None:
        """Say how the run ended, and what else of it is ``told`` (docs/reference/wire.md)."""
        body: dict[str, Any] = {"outcome": outcome, "detail": detail, **(told or {})}
        self._request("POST", f"/v1/runs/{quote(run, safe='')}/finish", body, timeout_s)

    def close(self) -> None:
        """Drop the connection; the next request opens another."""
        self._http.close()

    def _request(
        self, method: str, path: str, body: dict[str, Any] | None, timeout_s: float
    ) -> dict[str, Any]:
        try:
            status, data = self._http.request(method, path, body, timeout_s)
        except TimeoutError as error:
            raise SidecarUnreachable(
                f"The sidecar at {self.url} is slow: no answer within {timeout_s:.2g} s. See on "
                "the workstation whether it runs and what keeps the machine busy."
            ) from error
        except (http.client.RemoteDisconnected, http.client.IncompleteRead) as error:
            raise self._unreachable("closed the connection without an answer") from error
        except (http.client.HTTPException, ValueError) as error:  # a chunk of negative length, say
            raise self._garbled(f"its answer is no HTTP ({type(error).__name__})") from error
        except OSError as error:
            raise self._unreachable(f"cannot be reached ({error.strerror or error})") from error
        return self._understand(status, data)

    def _understand(self, status: int, data: bytes) -> dict[str, Any]:
        try:
            answer = json.loads(data)
        except (ValueError, RecursionError):
            answer = None
        self.order = _order_of(answer) or self.order
        said = _error_text(answer)
        if status == 401 or status == 403:
            raise SidecarRefused(
                f"The sidecar at {self.url} refused the token{said}. Set the guard's token "
                "(AEGIS_OT_TOKEN) to the one that the sidecar was started with."
            )
        if status == 404:
            raise RunUnknown(f"The sidecar at {self.url} does not know this run{said}.")
        if status == 409 and _error_code(answer) == "other_start":
            raise RunUnknown(f"The sidecar at {self.url} has another run of this name{said}.")
        if status == 409:
            raise self._gap(answer, said)
        if status == 503 and _error_code(answer) == "camera":
            raise CameraSilent(
                f"The sidecar at {self.url} got no usable frame from its camera{said}. Its page "
                "shows what the camera sees."
            )
        if status == 429 or (status == 503 and _error_code(answer) not in ("store", "trouble")):
            raise SidecarBusy(
                f"The sidecar at {self.url} is there, but too busy to serve this robot{said}. "
                "See who else sends it requests: its log says from which address."
            )
        if status == 503:
            raise CameraSilent(
                f"The sidecar at {self.url} cannot take what it is sent{said}. Look at the "
                "workstation, and at the sidecar's page."
            )
        if status in (400, 405, 413, 415, 422):
            raise SidecarRefused(
                f"The sidecar at {self.url} refused the request with status {status}{said}. "
                "Install the same version of aegis-ot on both machines."
            )
        if status != 200 and status != 201:
            raise self._garbled(f"it answered with status {status}{said}")
        if not isinstance(answer, dict):
            raise self._garbled("its answer is no JSON object")
        return answer

    def _gap(self, answer: Any, said: str) -> LinkError:
        expected = answer.get("expected") if isinstance(answer, dict) else None
        if expected is None and isinstance(answer, dict) and isinstance(answer.get("error"), dict):
            expected = answer["error"].get("expected")
        if not isinstance(expected, int) or isinstance(expected, bool) or expected < 0:
            return self._garbled(f"it reports a gap without saying where{said}")
        return SequenceGap(f"The sidecar at {self.url} misses keyframe {expected}.", expected)

    def _unreachable(self, what: str) -> SidecarUnreachable:
        return SidecarUnreachable(
            f"The sidecar at {self.url} {what}. Check that it runs, that the address is right, "
            "and that robot and workstation are in the same network."
        )

    def _garbled(
        self, what: str, remedy: str = "check that the address is that of an aegis-ot sidecar"
    ) -> SidecarGarbled:
        return SidecarGarbled(f"The sidecar at {self.url} makes no sense: {what}; {remedy}.")


def _order_of(answer: Any) -> Order | None:
    """An order, if the answer brings one that makes sense."""
    told = answer.get("order") if isinstance(answer, dict) else None
    if not isinstance(told, dict) or told.get("action") not in ("pause", "stop"):
        return None
    at: Any = told.get("at")
    known = isinstance(at, (int, float)) and not isinstance(at, bool)
    return Order(told["action"], str(told.get("by", ""))[:200], float(at) if known else 0.0)


def _trajectory(run: str, number: int) -> str:
    return f"/v1/runs/{quote(run, safe='')}/trajectories/{number}"


def _error_code(answer: Any) -> Any:
    error = answer.get("error") if isinstance(answer, dict) else None
    return error.get("code") if isinstance(error, dict) else None


def _error_text(answer: Any) -> str:
    error = answer.get("error") if isinstance(answer, dict) else None
    if isinstance(error, dict):
        error = error.get("message")
    return f" ({str(error)[:400].rstrip('.')})" if error else ""
