"""The page for people: runs, wells, frames, and the operator's decision."""

from __future__ import annotations

from pathlib import Path
from urllib.parse import parse_qs

from fastapi import APIRouter, Request
from jinja2 import Environment, FileSystemLoader, select_autoescape
from starlette.responses import FileResponse, HTMLResponse, RedirectResponse, Response

from .._version import __version__
from .security import same, set_cookie
from .wire import MAX_BODY, WireError

FOLDER = Path(__file__).parent / "page"
STATIC = {"page.js": "text/javascript", "page.css": "text/css"}
HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
        "connect-src 'self'; form-action 'self'; frame-ancestors 'none'; base-uri 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
}

router = APIRouter()
_templates = Environment(
    loader=FileSystemLoader(FOLDER), autoescape=select_autoescape(default=True)
)


@router.get("/")
def index() -> Response:
    """The page; it fetches its contents by itself."""
    return _render("index.html")


@router.get("/static/{name}")
def static(name: str) -> Response:
    """The page's script and style."""
    if name not in STATIC:
        raise WireError(404, "no_such_address", "There is nothing at this address.")
    return FileResponse(
        FOLDER / name, media_type=STATIC[name], headers={"X-Content-Type-Options": "nosniff"}
    )


@router.get("/login")
def login_form() -> Response:
    """Asks for the token."""
    return _render("login.html", wrong=False)


@router.post("/login")
async def login(request: Request) -> Response:
    """Checks the token and lets the browser in."""
    body = bytearray()
    async for chunk in request.stream():
        body += chunk
        if len(body) > MAX_BODY:
            raise WireError(413, "body", f"The body is longer than {MAX_BODY} bytes.")
    given = parse_qs(body.decode("utf-8", "replace")).get("token", [""])[0].strip()
    token = request.app.state.sidecar.config.token
    if token is not None and not same(given, token.get_secret_value()):
        return _render("login.html", 401, wrong=True)
    answer = RedirectResponse("/", 303)
    if token is not None:
        set_cookie(answer, token.get_secret_value())
    return answer


def _render(name: str, status: int = 200, **values: object) -> Response:
    text = _templates.get_template(name).render(version=__version__, **values)
    return HTMLResponse(text, status, HEADERS)
