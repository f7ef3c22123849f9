"""An HTTP client for the robot's own server (port 31950), as far as this package needs it."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping, Sequence
from email.utils import parsedate_to_datetime
from pathlib import Path
from typing import Any

import httpx

from ..errors import RobotError, RobotRefused, RobotUnreachable
from .address import robot_url
from .shapes import Analysis, Page, RunView, read_analysis, read_command, read_run, read_time

Values = Mapping[str, Any]
"""Runtime parameters by variable name: numbers, texts, flags."""

TIMEOUT_S = 10.0
UPLOAD_TIMEOUT_S = 60.0
"""The server parses and starts to analyse before it answers."""
PAGE = 100
"""Commands asked for at once; long pages hold the server up."""
_ANALYSIS_POLL_S = 0.25


class RobotClient:
    """Speaks to one robot.

    Args:
        host: As for :func:`~.address.robot_url`.
        transport: Instead of the network, for tests.

    Every method raises :class:`RobotUnreachable` where no answer comes in time,
    :class:`RobotRefused` where the server refuses, :class:`RobotError` where its answer makes no
    sense.
    """

    def __init__(self, host: str, transport: httpx.BaseTransport | None = None) -> None:
        self.url = robot_url(host)
        self._http = httpx.Client(
            base_url=self.url,
            headers={"Opentrons-Version": "*"},
            timeout=TIMEOUT_S,
            transport=transport,
            trust_env=False,  # a proxy for the internet does not lead to a robot on the bench
        )

    def __enter__(self) -> RobotClient:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Drop the connection."""
        self._http.close()

    def health(self) -> Mapping[str, Any]:
        """Name, model and versions of the robot."""
        found: Mapping[str, Any] = self._ask("GET", "/health")
        return found

    def upload(
        self, protocol: Path, labware: Sequence[Path] = (), values: Values | None = None
    ) -> tuple[str, bool]:
        """Upload a protocol file.

        Args:
            protocol: The file.
            labware: Files with custom labware definitions that it needs.
            values: Of its runtime parameters.

        Returns:
            Its identifier, and whether the server knew the very same files: then it keeps the old
            analysis, else it begins one.

        Raises:
            OSError: A file cannot be read.
        """
        files = [("files", (path.name, path.read_bytes())) for path in (protocol, *labware)]
        data = {"runTimeParameterValues": json.dumps(dict(values))} if values else {}
        answer = self._send(
            "POST", "/protocols", {"files": files, "data": data, "timeout": UPLOAD_TIMEOUT_S}
        )
        return str(self._read(answer)["data"]["id"]), answer.status_code == 200

    def analyse_again(self, protocol: str, values: Values | None = None) -> None:
        """Begin a new analysis: the server keeps the old one of the same file whatever changed."""
        asked = {"forceReAnalyze": True, "runTimeParameterValues": dict(values or {})}
        path = f"/protocols/{protocol}/analyses"
        self._ask("POST", path, json={"data": asked}, timeout=UPLOAD_TIMEOUT_S)

    def analysis(
        self, protocol: str, timeout_s: float, waiting: Callable[[float], None] = lambda s: None
    ) -> Analysis:
        """The newest analysis of a protocol, once it is completed.

        Args:
            protocol: Identifier.
            timeout_s: How long to wait for it.
            waiting: Told now and then how many seconds have gone by.
        """
        began = time.monotonic()
        while True:
            found = self._ask("GET", f"/protocols/{protocol}/analyses", timeout=UPLOAD_TIMEOUT_S)
            newest = read_analysis(found["data"][-1]) if found["data"] else None
            if newest is not None and newest.done:
                return newest
            seconds = time.monotonic() - began
            if seconds > timeout_s:
                raise RobotError(
                    f"The robot at {self.url} has not analysed the protocol in {timeout_s:g} s. "
                    "Wait longer (--analysis-timeout), or look at it in the Opentrons App."
                )
            waiting(seconds)
            time.sleep(_ANALYSIS_POLL_S)

    def create_run(self, protocol: str, values: Values | None = None) -> str:
        """Make a run of an uploaded protocol; its identifier. Nothing moves yet."""
        asked = {"protocolId": protocol}
        more = {"runTimeParameterValues": dict(values)} if values else {}
        answer = self._ask("POST", "/runs", json={"data": asked | more})
        return str(answer["data"]["id"])

    def act(self, run: str, kind: str) -> None:
        """``"play"``, ``"pause"`` or ``"stop"``."""
        self._ask("POST", f"/runs/{run}/actions", json={"data": {"actionType": kind}})

    def current_run(self) -> str | None:
        """Identifier of the run that has the robot, ended or not; ``None`` without one."""
        links = self._ask("GET", "/runs", params={"pageLength": 1}).get("links") or {}
        href = (links.get("current") or {}).get("href")
        return str(href).rpartition("/")[2] if href else None

    def runs(self) -> Sequence[Mapping[str, Any]]:
        """The runs that the robot keeps, as it tells them."""
        found: Sequence[Mapping[str, Any]] = self._ask("GET", "/runs")["data"]
        return found

    def stored_offsets(self) -> Sequence[Mapping[str, Any]]:
        """The robot's own store of labware offsets (8.4 and newer); none on an older one."""
        try:
            found: Sequence[Mapping[str, Any]] = self._ask("GET", "/labwareOffsets")["data"]
        except RobotRefused:
            return ()
        return found

    def run(self, run: str) -> RunView:
        """A run as it stands."""
        return read_run(self._ask("GET", f"/runs/{run}")["data"])

    def protocol_name(self, run: str) -> str:
        """File name of the protocol of a run, ``""`` where it cannot be told."""
        try:
            found = self._ask("GET", f"/protocols/{self.run(run).protocol}")["data"]["files"]
        except RobotRefused:
            return ""
        return str(found[0]["name"]) if found else ""

    def commands(self, run: str, cursor: int, length: int = PAGE) -> Page:
        """Commands from number ``cursor`` on; none where there are not so many."""
        params = {"cursor": cursor, "pageLength": length}
        answer = self._ask("GET", f"/runs/{run}/commands", params=params)
        meta = answer.get("meta") or {}
        # The server answers a cursor beyond the end with its last command.
        first, total = int(meta.get("cursor", cursor)), int(meta.get("totalLength", 0))
        found = [read_command(first + n, data) for n, data in enumerate(answer["data"])]
        return Page(tuple(command for command in found if command.index >= cursor), total)

    def result(self, run: str, command: str) -> Mapping[str, Any]:
        """What a command that succeeded gave; lists of commands leave it out."""
        found = self._ask("GET", f"/runs/{run}/commands/{command}")["data"]
        result: Mapping[str, Any] = found.get("result") or {}
        return result

    def labware_definitions(self, run: str) -> dict[str, Mapping[str, Any]]:
        """Definitions of the labware of a run, by URI."""
        found = self._ask("GET", f"/runs/{run}/loaded_labware_definitions")["data"]
        return {
            f"{d.get('namespace')}/{d['parameters']['loadName']}/{d.get('version')}": d
            for d in found
        }

    def clock(self) -> float:
        """Seconds since the epoch on the robot's clock, now.

        From ``/system/time``; where there is none, within half a second from the ``Date`` of an
        answer.
        """
        try:
            told = read_time(self._ask("GET", "/system/time")["data"]["systemTime"])
        except RobotRefused:
            told = None
        if told is not None:
            return told
        date = self._send("GET", "/health", {}).headers.get("Date", "")
        try:
            return parsedate_to_datetime(date).timestamp() + 0.5
        except ValueError:
            raise RobotError(f"The robot at {self.url} does not tell its time.") from None

    def _ask(self, method: str, path: str, **options: Any) -> Any:
        return self._read(self._send(method, path, options))

    def _read(self, answer: httpx.Response) -> Any:
        try:
            return answer.json()
        except json.JSONDecodeError:
            raise RobotError(
                f"What answers at {self.url} is no robot of Opentrons. Check the address and the "
                "port."
            ) from None

    def _send(self, method: str, path: str, options: dict[str, Any]) -> httpx.Response:
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
            raise RobotRefused(
                f"The robot at {self.url} refused {method} {path}: {_why(answer)}",
                answer.status_code,
            )
        return answer


def _why(answer: httpx.Response) -> str:
    try:
        body = answer.json()
        told = body.get("errors") or [{"detail": body.get("message")}]
        text = str(told[0].get("detail") or told[0].get("title"))
    except (ValueError, AttributeError, IndexError, TypeError):
        text = answer.reason_phrase
    return f"{text.rstrip('.')} (status {answer.status_code})."
