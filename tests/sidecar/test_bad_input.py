"""Garbage never yields a traceback, and always the wire's error shape."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from aegis_ot.sidecar import SidecarConfig, create_app
from aegis_ot.sidecar.wire import MAX_BODY
from aegis_ot.vocabulary import to_json

from .helpers import Robot, StubAnalyser, StubCamera, make_keyframe

POSTS = ("keyframes", "trajectories/0/abandon", "trajectories/0/decision", "hold", "finish")


class InProcess:
    """The same application without a socket."""

    def __init__(self, folder: Path) -> None:
        self.app = create_app(SidecarConfig(data=folder), StubCamera(), StubAnalyser())
        self.loop = asyncio.new_event_loop()
        transport = httpx.ASGITransport(self.app, raise_app_exceptions=True)
        self.http = httpx.AsyncClient(transport=transport, base_url="http://127.0.0.1")
        assert self.request("PUT", "/v1/runs/r", content=b'{"run": "r"}').status_code == 200

    def request(self, method: str, path: str, **more: Any) -> httpx.Response:
        return self.loop.run_until_complete(self.http.request(method, path, **more))

    def close(self) -> None:
        self.loop.run_until_complete(self.http.aclose())
        self.loop.close()
        self.app.state.sidecar.close()


@pytest.fixture(scope="module")
def inside(tmp_path_factory: pytest.TempPathFactory) -> Iterator[InProcess]:
    inside = InProcess(tmp_path_factory.mktemp("data"))
    yield inside
    inside.close()


def assert_told(answer: httpx.Response) -> None:
    assert 400 <= answer.status_code < 500
    error = answer.json()["error"]
    assert set(error) == {"code", "message", "hint"}
    assert error["message"]


SLOW = settings(
    max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)

anything = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=8), inner),
    max_leaves=8,
)


@SLOW
@given(path=st.sampled_from(POSTS), body=st.binary(max_size=200))
def test_bytes_that_are_no_json(inside: InProcess, path: str, body: bytes) -> None:
    try:
        json.loads(body)
    except ValueError:
        assert_told(inside.request("POST", f"/v1/runs/r/{path}", content=body))


@SLOW
@given(path=st.sampled_from(POSTS), body=anything)
def test_json_of_another_shape(inside: InProcess, path: str, body: Any) -> None:
    if isinstance(body, dict) and path.endswith("abandon"):
        return  # every member of an abandon may be left out
    assert_told(inside.request("POST", f"/v1/runs/r/{path}", content=json.dumps(body)))


@SLOW
@given(data=st.data())
def test_a_keyframe_with_one_member_spoiled(inside: InProcess, data: st.DataObject) -> None:
    keyframe = to_json(make_keyframe("r", 0))
    name = data.draw(st.sampled_from(sorted(keyframe)))
    keyframe[name] = data.draw(anything)
    answer = inside.request("POST", "/v1/runs/r/keyframes", content=json.dumps(keyframe))
    if answer.status_code == 409:  # valid, but another keyframe's number
        assert answer.json()["error"]["code"] in ("gap", "taken")
    elif answer.status_code != 200:
        assert_told(answer)


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e999", "-1", '"1"', "true"])
@pytest.mark.parametrize("name", ["commanded_ul", "expected_ul"])
def test_volumes_are_finite_numbers(inside: InProcess, name: str, number: str) -> None:
    body = json.dumps(to_json(make_keyframe("r", 0)) | {name: "HERE"}).replace('"HERE"', number)
    answer = inside.request("POST", "/v1/runs/r/keyframes", content=body)
    assert answer.status_code == 422
    assert_told(answer)


def test_positions_are_finite_numbers(inside: InProcess) -> None:
    body = json.dumps(to_json(make_keyframe("r", 0, position=(1.0, float("nan"), 2.0))))
    answer = inside.request("POST", "/v1/runs/r/keyframes", content=body)
    assert answer.status_code == 422
    assert "position" in answer.json()["error"]["message"]


def test_a_body_for_another_run_is_refused(inside: InProcess) -> None:
    body = json.dumps(to_json(make_keyframe("other", 0)))
    assert_told(inside.request("POST", "/v1/runs/r/keyframes", content=body))


@pytest.mark.parametrize(
    ("method", "path", "status"),
    [
        ("GET", "/v1/nowhere", 404),
        ("GET", "/static/../app.py", 404),
        ("DELETE", "/v1/runs/r", 405),
        ("GET", "/v1/runs/r/trajectories/x/verdict", 422),
        ("GET", "/v1/runs/r/trajectories/-1/verdict", 422),
        ("GET", f"/v1/runs/r/trajectories/{10**30}/verdict", 422),
        ("GET", "/v1/runs/r/trajectories/0/verdict?wait=nan", 422),
        ("GET", "/v1/runs/r/trajectories/0/verdict?wait=-1", 422),
        ("GET", "/v1/runs/r/frames/..%2F.jpg", 404),
    ],
)
def test_addresses_that_make_no_sense(
    inside: InProcess, method: str, path: str, status: int
) -> None:
    answer = inside.request(method, path)
    assert answer.status_code == status
    assert_told(answer)


def test_a_body_that_is_too_long_is_refused_with_and_without_a_length(robot: Robot) -> None:
    long = b'{"reason": "' + b"x" * MAX_BODY + b'"}'
    path = "/v1/runs/run-1/trajectories/0/abandon"
    for content in (long, (part for part in (long[:1000], long[1000:]))):
        answer = robot.http.post(path, content=content)
        assert answer.status_code == 413
        assert_told(answer)
