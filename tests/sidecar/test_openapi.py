"""The description of the sidecar is whole, and nothing that fits it, or not, makes it fail."""

from __future__ import annotations

from urllib.parse import quote

import httpx
import pytest

schemathesis = pytest.importorskip("schemathesis")

from hypothesis import HealthCheck, Phase, given, settings  # noqa: E402
from hypothesis import strategies as st  # noqa: E402
from hypothesis.errors import Unsatisfiable  # noqa: E402
from starlette.testclient import TestClient  # noqa: E402

GenerationMode = schemathesis.GenerationMode

from aegis_ot.sidecar import SidecarConfig, create_app, running_sidecar  # noqa: E402
from aegis_ot.sidecar.config import CameraSettings  # noqa: E402
from aegis_ot.sidecar.pages import page_router  # noqa: E402

from .helpers import Robot, StubAnalyser, StubCamera  # noqa: E402

EXAMPLES = 15
"""Requests an operation; all of them take about 20 s. With 8, numbers without bounds pass."""


@pytest.fixture(scope="module")
def schema(tmp_path_factory: pytest.TempPathFactory):
    pattern = CameraSettings(spec="pattern")
    config = SidecarConfig(port=0, data=tmp_path_factory.mktemp("fuzz"), camera=pattern)
    with running_sidecar(config) as url:
        with Robot(url, "known") as robot:
            robot.register()
            robot.cycle(0)
            robot.verdict(0)
        yield schemathesis.openapi.from_url(f"{url}/v1/openapi.json")


@pytest.mark.parametrize("mode", list(GenerationMode), ids=lambda mode: mode.value)
def test_no_request_makes_the_sidecar_fail(schema, mode) -> None:
    operations = [found.ok() for found in schema.get_all_operations()]
    assert len(operations) >= 15
    for operation in operations:
        _fuzz(operation, mode)


def _fuzz(operation, mode) -> None:
    @given(case=operation.as_strategy(generation_mode=mode), known=st.booleans())
    @settings(
        max_examples=EXAMPLES,
        deadline=None,
        derandomize=True,
        database=None,
        phases=(Phase.explicit, Phase.generate),
        suppress_health_check=list(HealthCheck),
    )
    def ask(case, known: bool) -> None:
        if known and "run" in (case.path_parameters or {}):
            case.path_parameters["run"] = "known"
        if "wait" in (case.query or {}):
            case.query["wait"] = 0
        answer = case.call(timeout=60)
        assert answer.status_code < 500, f"{operation.label}: {answer.text}"
        if answer.status_code >= 400 and case.method != "TRACE":
            assert set(answer.json()["error"]) == {"code", "message", "hint"}

    try:
        ask()
    except Unsatisfiable:
        assert mode is GenerationMode.NEGATIVE  # nothing can be wrong with it


VALUES = st.one_of(st.text(max_size=20), st.integers().map(str))
QUERY = st.dictionaries(st.sampled_from(["well", "q", "skip", "number", "token"]), VALUES)
FORM = st.dictionaries(
    st.sampled_from(["by", "answer", "note", "back", "token"]),
    st.one_of(VALUES, st.sampled_from(["pass resume", "fail", "stop", "pause", "Ada"])),
)


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory):
    """The application without a socket, with a run that holds a well."""
    config = SidecarConfig(port=0, data=tmp_path_factory.mktemp("pages"))
    app = create_app(config, StubCamera(), StubAnalyser(fails=[0]))
    with TestClient(
        app, "http://127.0.0.1", raise_server_exceptions=False, follow_redirects=False
    ) as client:
        robot = Robot("http://127.0.0.1", "known")
        robot.http = client
        robot.register()
        robot.cycle(0)
        robot.verdict(0)
        yield app, client


def test_no_page_makes_the_sidecar_fail(pages) -> None:
    app, client = pages
    routes = page_router(app.state.sidecar).routes
    asked = sorted((method, route.path) for route in routes for method in route.methods)
    assert len(asked) >= 11
    for method, path in asked:
        _fuzz_page(client, method, path)


def _fuzz_page(client, method: str, path: str) -> None:
    @given(run=VALUES | st.just("known"), number=VALUES | st.just("0"), query=QUERY, form=FORM)
    @settings(max_examples=2 * EXAMPLES, deadline=None, derandomize=True, database=None)
    def ask(run: str, number: str, query: dict[str, str], form: dict[str, str]) -> None:
        given = {"{run}": run, "{name}": run, "{number}": number}
        address = path
        for name, value in given.items():
            address = address.replace(name, quote(value, safe=""))
        answer = client.request(method, address, params=query, data=form or None)
        assert answer.status_code < 500, f"{method} {address} {query} {form}: {answer.text[:400]}"

    ask()


def test_every_reference_leads_somewhere(url: str) -> None:
    described = httpx.get(f"{url}/v1/openapi.json", trust_env=False).json()
    schemas = described["components"]["schemas"]
    text = str(described)
    for name in schemas:
        text = text.replace(f"'#/components/schemas/{name}'", "")
    assert "#/components/schemas/" not in text
    assert "#/$defs" not in text
    assert {
        "RunStart",
        "Keyframe",
        "HoldReport",
        "Finish",
        "Decision",
        "Action",
        "OrderRequest",
    } <= schemas.keys()
