"""The HTTP face: docs/reference/wire.md as a FastAPI application."""

from __future__ import annotations

import contextlib
import functools
import math
import time
from collections.abc import AsyncIterator
from typing import Annotated, Any

from fastapi import Depends, FastAPI, Header, Path, Query, Request
from starlette.concurrency import run_in_threadpool
from starlette.responses import Response

from .._version import __version__
from ..errors import AegisError, CameraError, StoreError
from ..vision.camera import Camera
from ..vision.types import Detector
from ..vocabulary import Keyframe, to_json
from .analysis import Analyser, Unscored
from .auditing import Auditor
from .bodies import body_as
from .cameras import open_cameras
from .cameras.history import HISTORY_S
from .config import SidecarConfig
from .description import ERRORS, describe
from .error_answers import answer_errors, trouble_of
from .pages import page_router
from .reasoning_routes import opinion_router, opinions_of
from .security import Doorkeeper
from .service import Sidecar
from .sessions import RunSession
from .wire import (
    MAX_COUNT,
    MAX_WAIT,
    WIRE,
    AbandonReport,
    Action,
    Decision,
    Finish,
    HoldReport,
    Incident,
    OrderRequest,
    RecoveryReport,
    RunStart,
    WireError,
    check_run,
)

PAGE_WAIT = 20.0
"""Longest wait of the page for news, s."""


async def _run_name(run: Annotated[str, Path()]) -> str:
    return check_run(run)


Run = Annotated[str, Depends(_run_name)]
Number = Annotated[int, Path(ge=0, le=MAX_COUNT)]
After = Annotated[int | None, Query(ge=0, le=2**53)]
Wait = Annotated[float, Query(ge=0, allow_inf_nan=False)]
Within = Annotated[float | None, Query(ge=0, allow_inf_nan=False)]
Ago = Annotated[float, Query(ge=-HISTORY_S, le=HISTORY_S, allow_inf_nan=False)]
"""How long before its arrival the moment of a keyframe was, s; negative: it is still to come."""
Start = Annotated[str, Header(alias="X-Aegis-Start", max_length=200)]
"""The nonce of the start that speaks; empty from a guard that has none."""


def _session(request: Request, run: Run, start: Start = "") -> RunSession:
    session: RunSession = request.app.state.sidecar.session(run, start)
    return session


Session = Annotated[RunSession, Depends(_session)]
"""The run of the address, if it is this start's."""


def create_app(
    config: SidecarConfig,
    camera: Camera | None = None,
    analyser: Analyser | None = None,
    detector: Detector | None = None,
    auditor: Auditor | None = None,
) -> FastAPI:
    """Build the sidecar's application. It holds the camera and store until it is shut down.

    Args:
        config: Settings.
        camera: Instead of the one that ``config.camera.spec`` names.
        analyser: What judges wells; without one every well is undecided.
        detector: With one, a frame counts only if the camera's view tells something.
        auditor: Looks back at each run that has ended.

    Returns:
        The application; ``app.state.sidecar`` is the :class:`~.service.Sidecar` behind it, whose
        ``close()`` must be called where no server runs the application's lifespan.

    Raises:
        ConfigurationError: The camera's or the model's name makes no sense.
        StoreError: The data folder cannot be used.
    """
    opinions = opinions_of(config)
    camera = open_cameras(config) if camera is None else camera
    try:
        judge = Unscored() if analyser is None else analyser
        sidecar = Sidecar(config, camera, judge, detector, auditor)
    except AegisError:
        camera.close()
        raise

    @contextlib.asynccontextmanager
    async def lifespan(_app: FastAPI) -> AsyncIterator[None]:
        yield
        await run_in_threadpool(sidecar.close)

    app = FastAPI(
        title="aegis-ot sidecar",
        version=__version__,
        lifespan=lifespan,
        openapi_url="/v1/openapi.json",
        # The interactive pages load scripts from elsewhere; wire.md is the reference.
        docs_url=None,
        redoc_url=None,
        responses=ERRORS,
    )
    app.openapi = functools.cache(lambda: describe(app))  # type: ignore[method-assign]
    app.state.sidecar = sidecar
    app.add_middleware(Doorkeeper, config=config)
    answer_errors(app)
    _robot_routes(app, sidecar)
    _reader_routes(app, sidecar)
    _person_routes(app, sidecar)
    app.include_router(opinion_router(opinions))
    app.include_router(page_router(sidecar))
    return app


def _robot_routes(app: FastAPI, sidecar: Sidecar) -> None:
    @app.get("/v1/health")
    def health() -> dict[str, Any]:
        camera = sidecar.camera_health()
        return {
            "name": "aegis-ot",
            "version": __version__,
            "wire": WIRE,
            "camera": {"kind": sidecar.camera.kind, "ok": camera.ok, "detail": camera.detail},
        }

    @app.put("/v1/runs/{run}")
    def register(run: Run, start: Annotated[RunStart, body_as(RunStart)]) -> dict[str, Any]:
        _must_match(run, start.run)
        named = sidecar.register(start)
        told = {"nonce": start.nonce} if start.nonce else {}
        return {"run": named, "wire": WIRE, **told}

    @app.post("/v1/runs/{run}/keyframes")
    async def keyframe(
        run: Run,
        arrived: Annotated[float, Depends(_now)],
        keyframe: Annotated[Keyframe, body_as(Keyframe)],
        ago: Ago = 0.0,
        stands: Within = None,
        start: Start = "",
    ) -> dict[str, Any]:
        _must_match(run, keyframe.run)
        moment = arrived - ago
        until = math.inf if stands is None else arrived + stands
        session = await run_in_threadpool(sidecar.session, run, start)
        try:
            captured = await run_in_threadpool(session.capture, keyframe, moment, until)
        except (CameraError, StoreError) as error:
            raise trouble_of(error, **_order(session)) from None
        return {
            "sequence": keyframe.sequence,
            "captured": True,
            "exposed_after_s": captured.exposed_after_s,
        } | _order(session)

    @app.get("/v1/runs/{run}/trajectories/{number}/verdict")
    async def verdict(number: Number, session: Session, wait: Wait = 0.0) -> dict[str, Any]:
        found = await sidecar.bell.until(lambda: session.ask(number), min(wait, MAX_WAIT))
        answer: dict[str, Any] = {"verdict": None if found is None else to_json(found)}
        if found is None and session.verdicts.awaits_operator(number):
            answer["awaiting"] = "operator"
        return answer | _order(session)

    @app.get("/v1/runs/{run}/trajectories/{number}/action")
    async def action(
        number: Number, session: Session, wait: Wait = 0.0, within: Within = None
    ) -> dict[str, Any]:
        found = await sidecar.bell.until(
            lambda: session.action(number, within), min(wait, MAX_WAIT)
        )
        return {"action": found}

    @app.post("/v1/runs/{run}/trajectories/{number}/abandon")
    def abandon(
        number: Number, body: Annotated[AbandonReport, body_as(AbandonReport)], session: Session
    ) -> dict[str, Any]:
        session.abandon(number, body.reason)
        return {}

    @app.post("/v1/runs/{run}/hold")
    def hold(
        run: Run, body: Annotated[HoldReport, body_as(HoldReport)], _: Session
    ) -> dict[str, Any]:
        sidecar.hold(run, body)
        return {}

    @app.post("/v1/runs/{run}/recovery")
    def recovery(
        run: Run, body: Annotated[RecoveryReport, body_as(RecoveryReport)], _: Session
    ) -> dict[str, Any]:
        sidecar.recovery(run, body)
        return {}

    @app.post("/v1/runs/{run}/incident")
    def incident(
        run: Run, body: Annotated[Incident, body_as(Incident)], session: Session
    ) -> dict[str, Any]:
        if body.kind == "layer1":
            sidecar.differs(run, body.text)
        else:
            said = f"The robot was not served for {body.seconds:.0f} s. {body.text}".strip()
            session.record.outage(body.kind, said, body.seconds)
        return {}

    @app.post("/v1/runs/{run}/finish")
    def finish(run: Run, body: Annotated[Finish, body_as(Finish)], _: Session) -> dict[str, Any]:
        sidecar.finish(run, body)
        return {}


def _reader_routes(app: FastAPI, sidecar: Sidecar) -> None:
    """For the page, and programs that follow runs."""

    async def news(after: int | None, wait: float) -> None:
        if after is not None:
            await sidecar.bell.until(
                lambda: True if sidecar.bell.rings != after else None, min(wait, PAGE_WAIT)
            )

    @app.get("/v1/news")
    async def version(after: After = None, wait: Wait = 0.0) -> dict[str, Any]:
        await news(after, wait)
        return {"version": sidecar.bell.rings}

    @app.get("/v1/runs")
    async def runs(
        after: After = None,
        wait: Wait = 0.0,
        search: Annotated[str, Query(max_length=200)] = "",
        most: Annotated[int, Query(ge=1, le=1000)] = 200,
    ) -> dict[str, Any]:
        await news(after, wait)
        version = sidecar.bell.rings
        return {"runs": await run_in_threadpool(sidecar.runs, search, most), "version": version}

    @app.get("/v1/camera/view")
    def view(number: Annotated[int, Query(ge=0, le=100)] = 0) -> dict[str, Any]:
        if number >= len(sidecar.aim.names):
            raise WireError(404, "no_such_camera", f"There is no camera number {number}.")
        return sidecar.aim.look(number).to_json()

    @app.get("/v1/runs/{run}")
    async def overview(run: Run, after: After = None, wait: Wait = 0.0) -> dict[str, Any]:
        await news(after, wait)
        return dict(await run_in_threadpool(sidecar.overview, run))

    @app.get("/v1/runs/{run}/frames/{sequence}.jpg")
    def frame(run: Run, sequence: Number) -> Response:
        jpeg = sidecar.store.frame(run, sequence)
        if jpeg is None:
            raise WireError(404, "no_frame", f"Run {run!r} has no frame {sequence}.")
        return Response(
            jpeg, media_type="image/jpeg", headers={"Cache-Control": "private, max-age=86400"}
        )

    @app.get("/v1/runs/{run}/clips/{number}.webm")
    def clip(run: Run, number: Number) -> Response:
        video = sidecar.store.clip(run, number)
        if video is None:
            raise WireError(404, "no_clip", f"Run {run!r} has no clip of delivery {number}.")
        return Response(video, media_type="video/webm")


def _person_routes(app: FastAPI, sidecar: Sidecar) -> None:
    """What people tell the robot, and say of its wells."""

    @app.post("/v1/runs/{run}/trajectories/{number}/decision")
    def decide(
        run: Run, number: Number, body: Annotated[Decision, body_as(Decision)]
    ) -> dict[str, Any]:
        return {"verdict": to_json(sidecar.session(run).decide(number, body))}

    @app.post("/v1/runs/{run}/trajectories/{number}/action")
    def act(run: Run, number: Number, body: Annotated[Action, body_as(Action)]) -> dict[str, Any]:
        sidecar.session(run).act(number, body)
        return {}

    @app.post("/v1/runs/{run}/close")
    def close(run: Run, body: Annotated[Finish, body_as(Finish)]) -> dict[str, Any]:
        sidecar.close_run(run, body)
        return {}

    @app.post("/v1/runs/{run}/order")
    def order(run: Run, body: Annotated[OrderRequest, body_as(OrderRequest)]) -> dict[str, Any]:
        sidecar.session(run).order(body)
        return {}


def _order(session: RunSession) -> dict[str, Any]:
    """What the moving robot is to do goes with every answer that it waits for."""
    order = session.ordered()
    return {} if order is None else {"order": order}


async def _now() -> float:
    """When the request arrived: the robot stands still since before."""
    return time.monotonic()


def _must_match(path: str, body: str) -> None:
    if path != body:
        raise WireError(422, "run", f"The body names run {body!r}, the address {path!r}.")
