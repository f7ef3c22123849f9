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
from ..settings import load_settings
from .address import robot_url
from .server_answers import (
    Analysis,
    Page,
    RunSnapshot,
    read_analysis,
    read_command,
    read_run,
    read_time,
)

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
        token: Of a robot whose access is controlled; the setting ``robot_token`` if ``None``. With
            it goes the setting ``robot_reason``.

    Every method raises :class:`RobotUnreachable` where no answer comes in time,
    :class:`RobotRefused` where the server refuses, :class:`RobotError` where its answer makes no
    sense.
    """

    def __init__(
        self, host: str, transport: httpx.BaseTransport | None = None, token: str | None = None
    ) -> None:
        self.url = robot_url(host)
        settings = load_settings(**({"robot_token": token} if token else {}))
        self._http = httpx.Client(
            base_url=self.url,
            headers=settings.robot_headers(),
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
        self,
        protocol: Path,
        labware: Sequence[Path] = (),
        values: Values | None = None,
        files: Values | None = None,
    ) -> tuple[str, bool]:
        """Upload a protocol file.

        Args:
            protocol: The file.
            labware: Files with custom labware definitions that it needs.
            values: Of its runtime parameters.
            files: Of its runtime parameters, as :meth:`upload_data` named them.

        Returns:
            Its identifier, and whether the server knew the very same files: then it keeps the old
            analysis, else it begins one.

        Raises:
            OSError: A file cannot be read.
        """
        sent = [("files", (path.name, path.read_bytes())) for path in (protocol, *labware)]
        data = {name: json.dumps(given) for name, given in _parameters(values, files).items()}
        answer = self._send(
            "POST", "/protocols", {"files": sent, "data": data, "timeout": UPLOAD_TIMEOUT_S}
        )
        return str(self._read(answer)["data"]["id"]), answer.status_code == 200

    def upload_data(self, path: Path) -> str:
        """Upload a file for a runtime parameter (CSV); its identifier. Raises OSError."""
        sent = {"file": (path.name, path.read_bytes())}
        try:
            answer = self._ask("POST", "/dataFiles", files=sent, timeout=UPLOAD_TIMEOUT_S)
        except RobotRefused as error:
            if error.status != 404:
                raise
            raise RobotError(
                f"The software of the robot at {self.url} takes no files for runtime parameters; "
                "8.0 and newer does. Update the robot."
            ) from None
        return str(answer["data"]["id"])

    def analyse_again(self, protocol: str) -> None:
        """Begin a new analysis: the server keeps the old one of the same file whatever changed."""
        asked = {"forceReAnalyze": True, "runTimeParameterValues": {}}
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

    def create_run(
        self,
        protocol: str,
        values: Values | None = None,
        files: Values | None = None,
        offsets: Sequence[Mapping[str, Any]] = (),
    ) -> str:
        """Make a run of an uploaded protocol; its identifier. Nothing moves yet.

        Args:
            protocol: Identifier.
            values, files: As for :meth:`upload`.
            offsets: Of its labware, as the server takes them.
        """
        asked = {"protocolId": protocol, "labwareOffsets": list(offsets)}
        answer = self._ask("POST", "/runs", json={"data": asked | _parameters(values, files)})
        return str(answer["data"]["id"])

    def act(self, run: str, kind: str) -> None:
        """``"play"``, ``"pause"``, ``"stop"`` or ``"resume-from-recovery"``."""
        self._ask("POST", f"/runs/{run}/actions", json={"data": {"actionType": kind}})

    def try_again(self, run: str) -> str:
        """Have the step done once more that a run in ``awaiting-recovery`` failed at.

        Returns:
            Identifier of the new command; when it is over, the run still waits.
        """
        found = self._ask("GET", f"/runs/{run}/commands", params={"pageLength": 1})
        failed = (found.get("links") or {}).get("currentlyRecoveringFrom")
        if not failed:
            raise RobotError("The robot does not say which step failed; recover it in the App.")
        known = self._ask("GET", str(failed["href"]))["data"]
        again = {"commandType": known["commandType"], "params": known["params"], "intent": "fixit"}
        path, failed_at = f"/runs/{run}/commands", {"failedCommandId": known["id"]}
        answer = self._ask("POST", path, params=failed_at, json={"data": again})
        return str(answer["data"]["id"])

    def current_run(self) -> str | None:
        """Identifier of the run that has the robot, ended or not; ``None`` without one."""
        links = self._ask("GET", "/runs", params={"pageLength": 1}).get("links") or {}
        href = (links.get("current") or {}).get("href")
        return str(href).rpartition("/")[2] if href else None

    def runs(self) -> Sequence[Mapping[str, Any]]:
        """The runs that the robot keeps, as it tells them."""
        found: Sequence[Mapping[str, Any]] = self._ask("GET", "/runs")["data"]
        return found

    def stored_offsets(self) -> Sequence[Mapping[str, Any]] | None:
        """The robot's own store of labware offsets (8.4 and newer); an older one has ``None``."""
        try:
            found: Sequence[Mapping[str, Any]] = self._ask("GET", "/labwareOffsets")["data"]
        except RobotRefused as error:
            if error.status != 404:
                raise
            return None
        return found

    def pipettes(self) -> Mapping[str, str]:
        """Name of the pipette on each mount that has one (``"left"``, ``"right"``)."""
        found = self._ask("GET", "/pipettes")
        return {
            mount: str(found[mount]["name"])
            for mount in ("left", "right")
            if (found.get(mount) or {}).get("name")
        }

    def modules(self) -> Sequence[Mapping[str, Any]]:
        """The modules that are plugged in, as the robot tells them."""
        found: Sequence[Mapping[str, Any]] = self._ask("GET", "/modules")["data"]
        return found

    def deck_configuration(self) -> Mapping[str, str]:
        """Which fixture a Flex has in each cutout (``"cutoutA3"``: ``"trashBinAdapter"``); none
        where it is not told."""
        try:
            told = self._ask("GET", "/deck_configuration")["data"]["cutoutFixtures"]
        except RobotRefused as error:
            if error.status != 404:
                raise
            return {}
        return {str(one["cutoutId"]): str(one["cutoutFixtureId"]) for one in told}

    def run(self, run: str) -> RunSnapshot:
        """A run as it stands."""
        return read_run(self._ask("GET", f"/runs/{run}")["data"])

    def protocol_name(self, run: str) -> str:
        """File name of the protocol of a run, ``""`` where it cannot be told."""
        try:
            found = self._ask("GET", f"/protocols/{self.run(run).protocol}")["data"]["files"]
        except RobotRefused:
            return ""
        return str(found[0]["name"]) if found else ""

    def api_level(self, run: str) -> Sequence[int] | None:
        """Of the protocol of a run; ``None`` where it cannot be told."""
        try:
            found = self._ask("GET", f"/protocols/{self.run(run).protocol}")["data"]["metadata"]
            return [int(part) for part in str(found["apiLevel"]).split(".")]
        except (RobotRefused, KeyError, ValueError):
            return None

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
            raise RobotRefused(self._refusal(answer, f"{method} {path}"), answer.status_code)
        return answer


def _parameters(values: Values | None, files: Values | None) -> dict[str, dict[str, Any]]:
    given = {"runTimeParameterValues": values, "runTimeParameterFiles": files}
    return {name: dict(one) for name, one in given.items() if one}


def _why(answer: httpx.Response) -> str:
    try:
        body = answer.json()
        told = body.get("errors") or [{"detail": body.get("message")}]
        text = str(told[0].get("detail") or told[0].get("title"))
    except (ValueError, AttributeError, IndexError, TypeError):
        text = answer.reason_phrase
    return f"{text.rstrip('.')} (status {answer.status_code})."
