"""The page for people: the live run, history, camera, and the operator's answers."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any
from urllib.parse import parse_qs

from fastapi import APIRouter, Query, Request
from fastapi import Path as InPath
from starlette.concurrency import run_in_threadpool
from starlette.responses import HTMLResponse, JSONResponse, RedirectResponse, Response

from ..errors import StoreError
from ..reports.audit_html import audit_html
from ..reports.html_page import html_page, shared_file
from ..reports.run_html import ReportedRun, report_run, run_report_html
from ..run_view import run_account
from ..run_view.overview import RunOverview
from ..vocabulary import Outcome
from .bodies import read_body
from .journal import event
from .security import COOKIE_S, LoginThrottle, client_of, same, set_cookie
from .service import Sidecar
from .store.frames import folder_name
from .trends import trends_of
from .views import Wanted, history_view, live_run, run_address, run_page
from .wire import MAX_COUNT, Action, Decision, OrderRequest, WireError, check_run

FOLDER = Path(__file__).parent / "templates"
STATIC = {
    "page.js": "text/javascript",
    "page.css": "text/css",
    "parts.css": "text/css",
    "icon.svg": "image/svg+xml",
    "manifest.webmanifest": "application/manifest+json",
}
HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
        "connect-src 'self'; manifest-src 'self'; worker-src 'self'; media-src 'self'; "
        "form-action 'self'; frame-ancestors 'none'; base-uri 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    # Not "no-referrer": browsers then send forms with "Origin: null", which the door refuses.
    "Referrer-Policy": "same-origin",
    "Cache-Control": "no-store",
}
NAME = "aegis_ot_name"
"""Cookie with the operator's name, so that it is typed once."""

Frames = Callable[[int], "bytes | None"]
"""The JPEG of a keyframe's number; ``None`` where it is missing."""

Well = Annotated[int | None, Query(ge=0, le=MAX_COUNT)]
Number = Annotated[int, InPath(ge=0, le=MAX_COUNT)]


def page_router(sidecar: Sidecar) -> APIRouter:
    """All pages of one sidecar."""
    router = APIRouter(include_in_schema=False)
    _reading(router, sidecar)
    _reports(router, sidecar)
    _files(router, sidecar)
    _answering(router, sidecar)
    _logging_in(router, sidecar)
    return router


def _reading(router: APIRouter, sidecar: Sidecar) -> None:
    @router.get("/")
    async def live(
        request: Request,
        well: Well = None,
        of: Annotated[str, Query(max_length=200)] = "",
        during: Well = None,
    ) -> Response:
        run = await run_in_threadpool(live_run, sidecar)
        if run is None:
            token = sidecar.config.token is not None
            return _show(sidecar, "welcome.html", "live", address=sidecar.address, token=token)
        return await _run_page(sidecar, request, run, Wanted(well, of, during), "/", "live")

    @router.get("/runs")
    def history(
        q: Annotated[str, Query(max_length=200)] = "",
        skip: Annotated[int, Query(ge=0, le=MAX_COUNT)] = 0,
    ) -> Response:
        return _show(sidecar, "history.html", "history", **history_view(sidecar, q, skip))

    @router.get("/trends")
    def trends() -> Response:
        return _show(sidecar, "trends.html", "trends", trends=trends_of(sidecar.store))

    @router.get("/runs/{run}")
    async def one_run(
        request: Request, run: str, well: Well = None, during: Well = None
    ) -> Response:
        wanted, here = Wanted(well, "", during), run_address(check_run(run))
        return await _run_page(sidecar, request, run, wanted, here, "run")


def _reports(router: APIRouter, sidecar: Sidecar) -> None:
    @router.get("/runs/{run}/report.html")
    def report_html(run: str) -> Response:
        page = run_report_html([_report(sidecar, run)])
        return HTMLResponse(page, headers=_download(run, "html"))

    @router.get("/runs/{run}/report.json")
    def report_json(run: str) -> Response:
        account = run_account(sidecar.overview(check_run(run)))
        return JSONResponse(account, headers=_download(run, "json"))

    @router.get("/runs/{run}/audit.html")
    def audit_page(run: str) -> Response:
        page = audit_html(*_audited(sidecar, run))
        return HTMLResponse(page, headers=_download(f"{run}-audit", "html"))

    @router.get("/runs/{run}/audit.json")
    def audit_json(run: str) -> Response:
        _, audit, _ = _audited(sidecar, run)
        return JSONResponse(audit, headers=_download(f"{run}-audit", "json"))


def _files(router: APIRouter, sidecar: Sidecar) -> None:
    @router.get("/camera")
    def camera(number: Annotated[int, Query(ge=0, le=100)] = 0) -> Response:
        return _show(sidecar, "camera.html", "camera", names=sidecar.aim.names, number=number)

    @router.get("/camera/now.jpg")
    def now() -> Response:
        picture = sidecar.aim.picture()
        headers = {"Cache-Control": "no-store"}
        if picture is None:
            return Response(status_code=204, headers=headers)
        return Response(picture, media_type="image/jpeg", headers=headers)

    @router.get("/sw.js")
    def worker() -> Response:
        return _text((FOLDER / "sw.js").read_text("utf-8"), "text/javascript")

    @router.get("/static/{name}")
    def static(name: str) -> Response:
        if name not in STATIC:
            raise WireError(404, "no_such_address", "There is nothing at this address.")
        text = shared_file(name) if name == "parts.css" else (FOLDER / name).read_text("utf-8")
        return _text(text, STATIC[name])


def _text(text: str, kind: str) -> Response:
    return Response(text, media_type=kind, headers={"X-Content-Type-Options": "nosniff"})


def _answering(router: APIRouter, sidecar: Sidecar) -> None:
    @router.post("/runs/{run}/wells/{number}")
    async def answer(request: Request, run: str, number: Number) -> Response:
        return await answered(request, run, number)

    @router.post("/runs/{run}/order")
    async def order(request: Request, run: str) -> Response:
        return await answered(request, run, None)

    async def answered(request: Request, run: str, number: int | None) -> Response:
        form = _form(await read_body(request))
        back = form.get("back") or run_address(check_run(run))
        try:
            by, words = form.get("by", "").strip(), form.get("answer", "").split()
            if not 1 <= len(by) <= 200 or not words:
                raise WireError(422, "by", "Who decides? Write your name.")
            note = form.get("note", "")[:5000]
            await run_in_threadpool(_answer, sidecar, run, number, words, by, note)
        except WireError as error:
            return await _run_page(
                sidecar,
                request,
                run,
                Wanted(number),
                run_address(run),
                "run",
                error.message,
                error.status,
            )
        except StoreError as error:  # a person gets a page, never raw JSON
            return _show(sidecar, "welcome.html", "live", 503, problem=str(error), token=False)
        response = RedirectResponse(back if back.startswith("/runs/") else "/", 303)
        response.set_cookie(NAME, by.encode().hex(), max_age=COOKIE_S, samesite="strict")
        return response


def _answer(
    sidecar: Sidecar, run: str, number: int | None, words: list[str], by: str, note: str
) -> None:
    """``pass`` or ``fail`` says what happened in the well, ``resume``, ``retry`` or ``stop`` what
    to do; without a well, ``pause`` or ``stop`` is for the robot that moves."""
    session = sidecar.session(run)
    for word in words:
        if number is None and word in ("pause", "stop"):
            session.order(OrderRequest(action=word, by=by, note=note))  # type: ignore[arg-type]
        elif number is None:
            raise WireError(422, "answer", f"There is no order {word!r}.")
        elif word in ("pass", "fail"):
            session.decide(number, Decision(outcome=Outcome(word), by=by, note=note))  # type: ignore[arg-type]
        elif word in ("resume", "retry", "stop"):
            session.act(number, Action(action=word, by=by, note=note))  # type: ignore[arg-type]
        else:
            raise WireError(422, "answer", f"There is no answer {word!r}.")


def _logging_in(router: APIRouter, sidecar: Sidecar) -> None:
    throttle = LoginThrottle()

    @router.get("/login")
    def form() -> Response:
        return _login("")

    @router.post("/login")
    async def login(request: Request) -> Response:
        given = _form(await read_body(request)).get("token", "").strip()
        token = sidecar.config.token
        who = client_of(request.scope)
        if token is not None and (wait := throttle.wait(who)) > 0:
            return _login(f"Too many wrong tokens. Try again in {wait:.0f} s.", 429, wait)
        if token is not None and not same(given, token.get_secret_value()):
            throttle.wrong(who)
            event("login", ok=False, address=who)
            return _login("That is not the sidecar's token.", 401)
        answer = RedirectResponse("/", 303)
        if token is not None:
            event("login", ok=True, address=who)
            set_cookie(answer, token.get_secret_value())
        return answer


def _report(sidecar: Sidecar, run: str) -> ReportedRun:
    overview = sidecar.overview(check_run(run))
    return report_run(
        overview, sidecar.store.frames_of(run), clip=lambda number: sidecar.store.clip(run, number)
    )


def _audited(sidecar: Sidecar, run: str) -> tuple[RunOverview, dict[str, Any], Frames]:
    """What the page of a run's audit shows.

    Raises:
        WireError: 404 if there is no such run, or it was not audited.
    """
    overview = sidecar.overview(check_run(run))
    if overview["audit"] is None:
        raise WireError(
            404, "no_audit", f"Run {run!r} was not audited.", f"Audit it: aegis-ot audit {run}."
        )
    return overview, overview["audit"], sidecar.store.frames_of(run)


def _download(run: str, suffix: str) -> dict[str, str]:
    return {"Content-Disposition": f'attachment; filename="{folder_name(run)}.{suffix}"'}


async def _run_page(
    sidecar: Sidecar,
    request: Request,
    run: str,
    wanted: Wanted,
    here: str,
    page: str,
    problem: str = "",
    status: int = 200,
) -> Response:
    values = await run_in_threadpool(run_page, sidecar, run, wanted, here)
    name = _name(request)
    return _show(sidecar, "run.html", page, status, problem=problem, name=name, **values)


def _show(
    sidecar: Sidecar, template: str, page: str, status: int = 200, **values: Any
) -> HTMLResponse:
    shown = {"problem": sidecar.alerts.notifier.trouble, **values}
    shown["problem"] = shown["problem"] or sidecar.alerts.notifier.trouble
    text = html_page(
        "aegis_ot.sidecar",
        template,
        {},
        page=page,
        camera=sidecar.camera_health(),
        camera_kind=sidecar.camera.kind,
        **shown,
    )
    return HTMLResponse(text, status, HEADERS)


def _login(problem: str, status: int = 200, wait: float = 0.0) -> Response:
    text = html_page("aegis_ot.sidecar", "login.html", {}, problem=problem)
    headers = HEADERS | ({"Retry-After": f"{wait:.0f}"} if wait else {})
    return HTMLResponse(text, status, headers)


def _form(body: bytes) -> dict[str, str]:
    try:
        fields = parse_qs(body.decode("utf-8", "replace"), max_num_fields=20)
    except ValueError:
        raise WireError(422, "body", "The form has too many fields.") from None
    return {name: values[0] for name, values in fields.items()}


def _name(request: Request) -> str:
    try:
        return bytes.fromhex(request.cookies.get(NAME, "")).decode()[:200]
    except ValueError:
        return ""
