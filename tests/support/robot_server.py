"""A robot server for the tests: Opentrons' own engine behind the HTTP shapes of the real one.

Shapes as observed on Opentrons' robot server 8.1 with simulated hardware. Protocols are analysed
and run by the real engine on its hardware simulator; what is ours is the HTTP around it.
"""

from __future__ import annotations

import asyncio
import contextlib
import hashlib
import json
import tempfile
import threading
import time
import uuid
from collections.abc import Callable
from datetime import datetime, timedelta, timezone
from email import message_from_bytes
from email.utils import format_datetime
from pathlib import Path
from typing import Any

import uvicorn
from fastapi import FastAPI, Request
from fastapi.responses import JSONResponse, Response
from opentrons.hardware_control import API
from opentrons.hardware_control.modules import SimulatingModule
from opentrons.protocol_engine import LabwareOffsetCreate, LegacyLabwareOffsetCreate
from opentrons.protocol_engine.commands.command_unions import CommandCreateAdapter
from opentrons.protocol_reader import ProtocolFilesInvalidError, ProtocolReader
from opentrons.protocol_runner.create_simulating_orchestrator import create_simulating_orchestrator
from opentrons.protocol_runner.run_orchestrator import ParseMode

from .live_engine import make_hardware, make_live

IDLE, ENDED = "idle", ("succeeded", "failed", "stopped")
SUMMARY = (
    "id", "key", "commandType", "createdAt", "startedAt", "completedAt", "status", "error",
    "params", "intent", "notes", "failedCommandId",
)  # fmt: skip
Fault = Callable[[Request], "Response | None"]


class RobotServer:
    """Serves on loopback, in a thread of its own; a context manager.

    Attributes:
        clock_offset_s: How far this robot's clock is ahead of the machine's, s.
        fault: Asked before each request; an answer of its own goes out instead.
        protocols, runs: What was uploaded and made, by id.
        requests: ``"METHOD /path"`` of every request.
        store: Its labware offsets; ``None`` on a robot that has no such store.
        modules, fixtures: Temperature modules that are plugged in; deck configuration of a Flex.
        recover: Opentrons' policy of error recovery; never to recover if ``None``.
    """

    def __init__(
        self,
        pipette: str = "p300_single_gen2",
        model: str = "p300_single_v2.1",
        robot: str = "OT-2",
    ) -> None:
        self.robot = robot
        self.store: list[dict[str, Any]] | None = None
        self.modules: list[str] = []
        self.fixtures = {f"cutout{row}{column}": "single" for row in "ABCD" for column in "123"}
        self.fixtures["cutoutA3"] = "trashBinAdapter"
        self.recover: Any = None
        self.data: dict[str, Path] = {}
        self.clock_offset_s = 0.0
        self.fault: Fault | None = None
        self.protocols: dict[str, dict[str, Any]] = {}
        self.runs: dict[str, _Run] = {}
        self.current: str | None = None
        self.requests: list[str] = []
        self.attached = {"model": model, "id": "left", "name": pipette}
        self.folder = tempfile.TemporaryDirectory()
        self._server = uvicorn.Server(
            uvicorn.Config(_app(self), host="127.0.0.1", port=0, log_level="error", lifespan="off")
        )
        self._thread = threading.Thread(target=self._server.run, daemon=True)

    def __enter__(self) -> RobotServer:
        self._thread.start()
        while not self._server.started:
            assert self._thread.is_alive()
            time.sleep(0.01)
        port = self._server.servers[0].sockets[0].getsockname()[1]
        self.url = f"http://127.0.0.1:{port}"
        return self

    def __exit__(self, *_: object) -> None:
        for run in self.runs.values():
            run.stop_soon()
        self._server.should_exit = True
        self._thread.join(60)
        self.folder.cleanup()

    def shifted(self, value: Any) -> Any:
        """A JSON value with this robot's clock in its times."""
        if isinstance(value, dict):
            return {
                key: self._later(item)
                if key.endswith("At") and isinstance(item, str)
                else self.shifted(item)
                for key, item in value.items()
            }
        return [self.shifted(item) for item in value] if isinstance(value, list) else value

    def now(self) -> datetime:
        return datetime.now(timezone.utc) + timedelta(seconds=self.clock_offset_s)

    def _later(self, text: str) -> str:
        moment = datetime.fromisoformat(text.replace("Z", "+00:00"))
        return (moment + timedelta(seconds=self.clock_offset_s)).isoformat()

    async def analyse(
        self, protocol: dict[str, Any], values: Any = None, files: Any = None
    ) -> None:
        analysis: dict[str, Any] = {"id": str(uuid.uuid4()), "status": "pending"}
        protocol["analyses"].append(analysis)
        source = protocol["source"]
        orchestrator = await create_simulating_orchestrator(source.robot_type, source.config)
        try:
            await orchestrator.load(source, values or None, self.paths(files), ParseMode.NORMAL)
            result = await orchestrator.run(deck_configuration=[])
        except Exception as error:
            found = [{"errorType": type(error).__name__, "errorCode": "4000", "detail": str(error)}]
            declared = [_plain(one) for one in orchestrator.get_run_time_parameters()]
            analysis.update(
                status="completed",
                result="not-ok",
                commands=[],
                errors=found,
                runTimeParameters=declared,
            )
            return
        summary = result.state_summary
        analysis.update(
            status="completed",
            result="not-ok" if summary.errors else "ok",
            robotType=source.robot_type,
            runTimeParameters=[_plain(one) for one in orchestrator.get_run_time_parameters()],
            commands=[_plain(command) for command in result.commands],
            errors=[_plain(error) for error in summary.errors],
            pipettes=[_plain(pipette) for pipette in summary.pipettes],
        )

    def paths(self, files: Any) -> dict[str, Path]:
        return {name: self.data[identifier] for name, identifier in (files or {}).items()}


class _Run:
    """One live run; all its methods run on the server's event loop."""

    def __init__(self, server: RobotServer, protocol: dict[str, Any]) -> None:
        self.id = str(uuid.uuid4())
        self.protocol = protocol
        self.created = datetime.now(timezone.utc)
        self.actions: list[dict[str, Any]] = []
        self.lost = False  # the server was restarted meanwhile
        self._server = server
        self._task: asyncio.Task[Any] | None = None

    async def load(self, values: Any, files: Any, offsets: Any = ()) -> None:
        self.offsets: list[dict[str, Any]] = []  # further ones that it is said to have had
        source = self.protocol["source"]
        self._loop = asyncio.get_running_loop()
        robot = self._server.robot
        if robot == "OT-2":
            hardware = await API.build_hardware_simulator(
                attached_instruments={_left(): dict(self._server.attached)},
                attached_modules={
                    "tempdeck": [
                        SimulatingModule(serial_number=m, model=m) for m in self._server.modules
                    ]
                },
            )
            hardware._em_simulate = False  # wait and be cancelled as on a robot
        else:
            hardware = await make_hardware(robot)
        recover = self._server.recover
        self.orchestrator = (await make_live(hardware, source.config, robot, recover)).orchestrator
        self._hardware = hardware
        await self.orchestrator.load(source, values, self._server.paths(files), ParseMode.NORMAL)
        for offset in offsets or ():
            kind = (
                LabwareOffsetCreate if "locationSequence" in offset else LegacyLabwareOffsetCreate
            )
            self.orchestrator.add_labware_offset(kind.model_validate(offset))

    @property
    def status(self) -> str:
        return str(self.orchestrator.get_run_status().value)

    async def act(self, kind: str) -> dict[str, Any]:
        if kind == "play":
            if self._task is None:
                self._task = asyncio.create_task(self._run())
            else:
                self.orchestrator.play()
        elif kind == "pause":
            self.orchestrator.pause()
        elif kind == "resume-from-recovery":
            self.orchestrator.resume_from_recovery(False)
        else:
            await self.orchestrator.stop()
        created = datetime.now(timezone.utc).isoformat()
        action = {"id": str(uuid.uuid4()), "createdAt": created, "actionType": kind}
        self.actions.append(action)
        return action

    def stop_soon(self) -> None:
        if self._task is not None and self.status not in ENDED:
            with contextlib.suppress(Exception):
                asyncio.run_coroutine_threadsafe(self.orchestrator.stop(), self._loop).result(30)

    async def _run(self) -> None:
        try:
            await self.orchestrator.run(deck_configuration=[])
        finally:
            await self._hardware.clean_up()

    async def fix(self, asked: Any, failed: str) -> dict[str, Any]:
        added = await self.orchestrator.add_command_and_wait_for_interval(
            CommandCreateAdapter.validate_python(asked), failed_command_id=failed
        )
        return self.command(added.id)

    def view(self) -> dict[str, Any]:
        summary = self.orchestrator.get_state_summary()
        if self.lost:
            empty: dict[str, Any] = {
                name: [] for name in ("labware", "pipettes", "actions", "errors")
            }
            return {"id": self.id, "ok": False, "status": "stopped", "current": False, **empty}
        return {
            "id": self.id,
            "ok": True,
            "createdAt": self.created.isoformat(),
            "status": self.status,
            "current": self._server.current == self.id,
            "actions": self.actions,
            "errors": [_plain(error) for error in summary.errors],
            "hasEverEnteredErrorRecovery": False,
            "pipettes": [_plain(pipette) for pipette in summary.pipettes],
            "modules": [],
            "labware": [_plain(labware) for labware in summary.labware],
            "liquids": [_plain(liquid) for liquid in summary.liquids],
            "labwareOffsets": [_plain(one) for one in summary.labwareOffsets] + self.offsets,
            "runTimeParameters": [],
            "protocolId": self.protocol["id"],
        }

    def commands(self, cursor: int | None, length: int) -> dict[str, Any]:
        found = self.orchestrator.get_command_slice(cursor, length, include_fixit_commands=True)
        data = [
            {k: v for k, v in _plain(command).items() if k in SUMMARY} for command in found.commands
        ]
        return {
            "data": data,
            "links": self._links(),
            "meta": {"cursor": found.cursor, "totalLength": found.total_length},
        }

    def command(self, command: str) -> dict[str, Any]:
        return _plain(self.orchestrator.get_command(command))

    def _links(self) -> dict[str, Any]:
        found = {
            "current": self.orchestrator.get_current_command(),
            "currentlyRecoveringFrom": self.orchestrator.get_command_recovery_target(),
        }
        return {name: self._link(one) for name, one in found.items() if one is not None}

    def _link(self, pointer: Any) -> dict[str, Any]:
        meta = {
            "runId": self.id,
            "commandId": pointer.command_id,
            "index": pointer.index,
            "key": pointer.command_key,
            "createdAt": pointer.created_at.isoformat(),
        }
        return {"href": f"/runs/{self.id}/commands/{pointer.command_id}", "meta": meta}


def _left() -> Any:
    from opentrons.types import Mount

    return Mount.LEFT


def _plain(model: Any) -> dict[str, Any]:
    value: dict[str, Any] = json.loads(model.model_dump_json(exclude_none=True))
    return value


def _error(status: int, kind: str, title: str, detail: str) -> JSONResponse:
    error = {"id": kind, "title": title, "detail": detail, "errorCode": "4000"}
    return JSONResponse({"errors": [error]}, status)


def _app(robot: RobotServer) -> FastAPI:
    app = FastAPI(openapi_url=None)

    @app.middleware("http")
    async def every(request: Request, call_next: Any) -> Any:
        robot.requests.append(f"{request.method} {request.url.path}")
        answer = robot.fault(request) if robot.fault is not None else None
        if answer is None and not request.headers.get("opentrons-version"):
            text = "header.opentrons-version: field required"
            answer = JSONResponse({"message": text, "errorCode": "4000"}, 422)
        if answer is None:
            answer = await call_next(request)
        answer.headers["Date"] = format_datetime(robot.now().replace(microsecond=0), usegmt=True)
        return answer

    def body(data: Any, status: int = 200) -> JSONResponse:
        return JSONResponse(robot.shifted(data), status)

    @app.get("/health")
    async def health() -> Any:
        return body(
            {
                "name": "test-robot",
                "robot_model": "OT-2 Standard" if robot.robot == "OT-2" else "OT-3 Standard",
                "api_version": "8.1.0",
                "fw_version": "Virtual Smoothie",
                "maximum_protocol_api_version": [2, 20],
                "minimum_protocol_api_version": [2, 0],
                "robot_serial": "simulator",
            }
        )

    @app.get("/system/time")
    async def system_time() -> Any:
        return body({"data": {"systemTime": robot.now().isoformat(), "id": "time"}, "links": {}})

    @app.get("/pipettes")
    async def pipettes() -> Any:
        none = {"model": None, "name": None, "id": None}
        return {"left": none, "right": none | {"name": "p300_single_gen2"}}

    @app.get("/modules")
    async def modules() -> Any:
        return body({"data": [{"moduleModel": model} for model in robot.modules]})

    @app.get("/deck_configuration")
    async def deck() -> Any:
        placed = [{"cutoutId": c, "cutoutFixtureId": f} for c, f in robot.fixtures.items()]
        return body({"data": {"cutoutFixtures": placed}})

    @app.get("/labwareOffsets")
    async def offsets() -> Any:
        if robot.store is None:
            return JSONResponse({"detail": "Not Found"}, 404)
        return body({"data": robot.store})

    @app.post("/dataFiles")
    async def data_file(request: Request) -> Any:
        ((name, text, _),) = await _parts(request)
        path = Path(robot.folder.name) / name
        path.write_bytes(text)
        robot.data[name] = path
        return body({"data": {"id": name, "name": name}}, 201)

    _protocol_routes(app, robot, body)
    _run_routes(app, robot, body)
    return app


async def _parts(request: Request) -> list[tuple[str, bytes, str]]:
    """Of a multipart body: file name, content and field name of each."""
    head = f"Content-Type: {request.headers['content-type']}\r\n\r\n".encode()
    parts: Any = message_from_bytes(head + await request.body()).get_payload()
    return [
        (
            p.get_filename() or "",
            p.get_payload(decode=True),
            str(p.get_param("name", header="content-disposition")),
        )
        for p in parts
    ]


def _protocol_routes(app: FastAPI, robot: RobotServer, body: Any) -> None:
    def view(protocol: dict[str, Any]) -> dict[str, Any]:
        shown = {k: v for k, v in protocol.items() if k not in ("source", "analyses")}
        summaries = [{"id": a["id"], "status": a["status"]} for a in protocol["analyses"]]
        return {"data": {**shown, "analyses": [], "analysisSummaries": summaries}}

    @app.post("/protocols")
    async def upload(request: Request) -> Any:
        parts = await _parts(request)
        files = [(name, text) for name, text, _ in parts if name]
        fields = {field: json.loads(text) for name, text, field in parts if not name}
        values = [fields.get(f"runTimeParameter{what}") for what in ("Values", "Files")]
        key = hashlib.sha256(repr(files).encode()).hexdigest()
        for known in robot.protocols.values():
            if known["key"] == key:
                if any(values):
                    _begin(robot.analyse(known, *values))
                    await asyncio.sleep(0)
                return body(view(known), 200)
        folder = Path(robot.folder.name) / key[:8]
        folder.mkdir(exist_ok=True)
        for name, text in files:
            (folder / name).write_bytes(text)
        try:
            source = await ProtocolReader().read_saved(
                [folder / name for name, _ in files], directory=None
            )
        except ProtocolFilesInvalidError as error:
            return _error(422, "ProtocolFilesInvalid", "Protocol File(s) Invalid", str(error))
        protocol = {
            "id": str(uuid.uuid4()),
            "createdAt": datetime.now(timezone.utc).isoformat(),
            "files": [{"name": source.main_file.name, "role": "main"}],
            "protocolType": "python",
            "robotType": source.robot_type,
            "metadata": source.metadata,
            "key": key,
            "source": source,
            "analyses": [],
        }
        robot.protocols[protocol["id"]] = protocol
        _begin(robot.analyse(protocol, *values))
        await asyncio.sleep(0)
        return body(view(protocol), 201)

    @app.get("/protocols/{protocol}")
    async def one(protocol: str) -> Any:
        if protocol not in robot.protocols:
            detail = f"Protocol {protocol} not found"
            return _error(404, "ProtocolNotFound", "Protocol Not Found", detail)
        return body(view(robot.protocols[protocol]))

    @app.get("/protocols/{protocol}/analyses")
    async def analyses(protocol: str) -> Any:
        if protocol not in robot.protocols:
            detail = f"Protocol {protocol} not found"
            return _error(404, "ProtocolNotFound", "Protocol Not Found", detail)
        return body({"data": robot.protocols[protocol]["analyses"], "meta": {}})

    @app.get("/protocols/{protocol}/analyses/{analysis}")
    async def analysis(protocol: str, analysis: str) -> Any:
        for found in robot.protocols[protocol]["analyses"]:
            if found["id"] == analysis:
                return body({"data": found})
        return _error(404, "AnalysisNotFound", "Protocol Analysis Not Found", analysis)

    @app.post("/protocols/{protocol}/analyses")
    async def analyse_again(protocol: str, request: Request) -> Any:
        asked = (await request.json()).get("data", {})
        found = robot.protocols[protocol]
        if asked.get("forceReAnalyze"):
            _begin(robot.analyse(found, asked.get("runTimeParameterValues")))
            await asyncio.sleep(0)
        summaries = [{"id": a["id"], "status": a["status"]} for a in found["analyses"]]
        return body({"data": summaries, "meta": {"cursor": 0}}, 201)


_TASKS: set[asyncio.Task[Any]] = set()


def _begin(work: Any) -> None:
    task = asyncio.create_task(work)
    _TASKS.add(task)
    task.add_done_callback(_TASKS.discard)


def _run_routes(app: FastAPI, robot: RobotServer, body: Any) -> None:
    def unknown(run: str) -> JSONResponse:
        return _error(404, "RunNotFound", "Run Not Found", f"Run {run} was not found.")

    @app.get("/runs")
    async def runs(pageLength: int = 20) -> Any:
        data = [run.view() for run in list(robot.runs.values())[-pageLength:]]
        links = {"current": {"href": f"/runs/{robot.current}"}} if robot.current else {}
        meta = {"cursor": 0, "totalLength": len(robot.runs)}
        return body({"data": data, "links": links, "meta": meta})

    @app.post("/runs")
    async def create(request: Request) -> Any:
        data = (await request.json())["data"]
        asked = data["protocolId"]
        if asked not in robot.protocols:
            detail = f"'Protocol {asked} was not found.'"
            return _error(404, "ProtocolNotFound", "Protocol Not Found", detail)
        current = robot.runs.get(robot.current or "")
        if current is not None and current.status not in (IDLE, *ENDED):
            detail = "Current run is not idle or stopped."
            return _error(409, "RunAlreadyActive", "Run Already Active", detail)
        run = _Run(robot, robot.protocols[asked])
        values, files = data.get("runTimeParameterValues"), data.get("runTimeParameterFiles")
        await run.load(values, files, data.get("labwareOffsets"))
        robot.runs[run.id] = run
        robot.current = run.id
        return body({"data": run.view()}, 201)

    @app.get("/runs/{run}")
    async def one(run: str) -> Any:
        return body({"data": robot.runs[run].view()}) if run in robot.runs else unknown(run)

    @app.get("/runs/{run}/loaded_labware_definitions")
    async def definitions(run: str) -> Any:
        found = robot.runs[run].orchestrator.get_loaded_labware_definitions()
        return body({"data": [_plain(definition) for definition in found]})

    @app.get("/runs/{run}/commands")
    async def commands(run: str, cursor: int | None = None, pageLength: int = 20) -> Any:
        if run not in robot.runs:
            return unknown(run)
        return body(robot.runs[run].commands(cursor, pageLength))

    @app.get("/runs/{run}/commands/{command}")
    async def command(run: str, command: str) -> Any:
        if run not in robot.runs:
            return unknown(run)
        return body({"data": robot.runs[run].command(command)})

    @app.post("/runs/{run}/commands")
    async def add(run: str, request: Request, failedCommandId: str) -> Any:
        asked = (await request.json())["data"]
        return body({"data": await robot.runs[run].fix(asked, failedCommandId)}, 201)

    @app.post("/runs/{run}/actions")
    async def act(run: str, request: Request) -> Any:
        if run not in robot.runs:
            return unknown(run)
        kind = (await request.json())["data"]["actionType"]
        found = robot.runs[run]
        refusal = ""
        if found.status in ENDED:
            refusal = "The run has already stopped."
        elif kind == "pause" and found.status != "running":
            refusal = "Cannot pause a run that is not running."
        if refusal:
            return _error(409, "RunActionNotAllowed", "Run Action Not Allowed", refusal)
        return body({"data": await found.act(kind)}, 201)
