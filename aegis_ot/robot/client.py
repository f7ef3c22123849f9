"""What this package asks of the robot's own server (port 31950)."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping, Sequence
from email.utils import parsedate_to_datetime
from pathlib import Path
from typing import Any

from ..errors import RobotError, RobotRefused
from .connection import RobotConnection
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

UPLOAD_TIMEOUT_S = 60.0
"""The server parses and starts to analyse before it answers."""
PAGE = 100
"""Commands asked for at once; long pages hold the server up."""
_ANALYSIS_POLL_S = 0.25


class RobotClient(RobotConnection):
    """What this package asks of one robot; see :class:`.RobotConnection` for errors."""

    def health(self) -> Mapping[str, Any]:
        """Name, model and versions of the robot."""
        found: Mapping[str, Any] = self.ask("GET", "/health")
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
        answer = self.send(
            "POST", "/protocols", {"files": sent, "data": data, "timeout": UPLOAD_TIMEOUT_S}
        )
        return str(self.read(answer)["data"]["id"]), answer.status_code == 200

    def upload_data(self, path: Path) -> str:
        """Upload a file for a runtime parameter (CSV); its identifier. Raises OSError."""
        sent = {"file": (path.name, path.read_bytes())}
        try:
            answer = self.ask("POST", "/dataFiles", files=sent, timeout=UPLOAD_TIMEOUT_S)
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
        self.ask("POST", path, json={"data": asked}, timeout=UPLOAD_TIMEOUT_S)

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
            found = self.ask("GET", f"/protocols/{protocol}/analyses", timeout=UPLOAD_TIMEOUT_S)
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
        answer = self.ask("POST", "/runs", json={"data": asked | _parameters(values, files)})
        return str(answer["data"]["id"])

    def act(self, run: str, kind: str) -> None:
        """``"play"``, ``"pause"``, ``"stop"`` or ``"resume-from-recovery"``."""
        self.ask("POST", f"/runs/{run}/actions", json={"data": {"actionType": kind}})

    def try_again(self, run: str) -> str:
        """Have the step done once more that a run in ``awaiting-recovery`` failed at.

        Returns:
            Identifier of the new command; when it is over, the run still waits.
        """
        found = self.ask("GET", f"/runs/{run}/commands", params={"pageLength": 1})
        failed = (found.get("links") or {}).get("currentlyRecoveringFrom")
        if not failed:
            raise RobotError("The robot does not say which step failed; recover it in the App.")
        known = self.ask("GET", str(failed["href"]))["data"]
        again = {"commandType": known["commandType"], "params": known["params"], "intent": "fixit"}
        path, failed_at = f"/runs/{run}/commands", {"failedCommandId": known["id"]}
        answer = self.ask("POST", path, params=failed_at, json={"data": again})
        return str(answer["data"]["id"])

    def current_run(self) -> str | None:
        """Identifier of the run that has the robot, ended or not; ``None`` without one."""
        links = self.ask("GET", "/runs", params={"pageLength": 1}).get("links") or {}
        href = (links.get("current") or {}).get("href")
        return str(href).rpartition("/")[2] if href else None

    def runs(self) -> Sequence[Mapping[str, Any]]:
        """The runs that the robot keeps, as it tells them."""
        found: Sequence[Mapping[str, Any]] = self.ask("GET", "/runs")["data"]
        return found

    def stored_offsets(self) -> Sequence[Mapping[str, Any]] | None:
        """The robot's own store of labware offsets (8.4 and newer); an older one has ``None``."""
        try:
            found: Sequence[Mapping[str, Any]] = self.ask("GET", "/labwareOffsets")["data"]
        except RobotRefused as error:
            if error.status != 404:
                raise
            return None
        return found

    def pipettes(self) -> Mapping[str, str]:
        """Name of the pipette on each mount that has one (``"left"``, ``"right"``)."""
        found = self.ask("GET", "/pipettes")
        return {
            mount: str(found[mount]["name"])
            for mount in ("left", "right")
            if (found.get(mount) or {}).get("name")
        }

    def modules(self) -> Sequence[Mapping[str, Any]]:
        """The modules that are plugged in, as the robot tells them."""
        found: Sequence[Mapping[str, Any]] = self.ask("GET", "/modules")["data"]
        return found

    def deck_configuration(self) -> Mapping[str, str]:
        """Which fixture a Flex has in each cutout (``"cutoutA3"``: ``"trashBinAdapter"``); none
        where it is not told."""
        try:
            told = self.ask("GET", "/deck_configuration")["data"]["cutoutFixtures"]
        except RobotRefused as error:
            if error.status != 404:
                raise
            return {}
        return {str(one["cutoutId"]): str(one["cutoutFixtureId"]) for one in told}

    def run(self, run: str) -> RunSnapshot:
        """A run as it stands."""
        return read_run(self.ask("GET", f"/runs/{run}")["data"])

    def protocol_name(self, run: str) -> str:
        """File name of the protocol of a run, ``""`` where it cannot be told."""
        try:
            found = self.ask("GET", f"/protocols/{self.run(run).protocol}")["data"]["files"]
        except RobotRefused:
            return ""
        return str(found[0]["name"]) if found else ""

    def api_level(self, run: str) -> Sequence[int] | None:
        """Of the protocol of a run; ``None`` where it cannot be told."""
        try:
            found = self.ask("GET", f"/protocols/{self.run(run).protocol}")["data"]["metadata"]
            return [int(part) for part in str(found["apiLevel"]).split(".")]
        except (RobotRefused, KeyError, ValueError):
            return None

    def commands(self, run: str, cursor: int) -> Page:
        """Commands from number ``cursor`` on; none where there are not so many."""
        params = {"cursor": cursor, "pageLength": PAGE}
        answer = self.ask("GET", f"/runs/{run}/commands", params=params)
        meta = answer.get("meta") or {}
        # The server answers a cursor beyond the end with its last command.
        first, total = int(meta.get("cursor", cursor)), int(meta.get("totalLength", 0))
        found = [read_command(first + n, data) for n, data in enumerate(answer["data"])]
        return Page(tuple(command for command in found if command.index >= cursor), total)

    def result(self, run: str, command: str) -> Mapping[str, Any]:
        """What a command that succeeded gave; lists of commands leave it out."""
        found = self.ask("GET", f"/runs/{run}/commands/{command}")["data"]
        result: Mapping[str, Any] = found.get("result") or {}
        return result

    def labware_definitions(self, run: str) -> dict[str, Mapping[str, Any]]:
        """Definitions of the labware of a run, by URI."""
        found = self.ask("GET", f"/runs/{run}/loaded_labware_definitions")["data"]
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
            told = read_time(self.ask("GET", "/system/time")["data"]["systemTime"])
        except RobotRefused:
            told = None
        if told is not None:
            return told
        date = self.send("GET", "/health", {}).headers.get("Date", "")
        try:
            return parsedate_to_datetime(date).timestamp() + 0.5
        except ValueError:
            raise RobotError(f"The robot at {self.url} does not tell its time.") from None


def _parameters(values: Values | None, files: Values | None) -> dict[str, dict[str, Any]]:
    given = {"runTimeParameterValues": values, "runTimeParameterFiles": files}
    return {name: dict(one) for name, one in given.items() if one}
