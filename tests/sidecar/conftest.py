from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from aegis_ot.sidecar import SidecarConfig, running_sidecar

from .helpers import Robot, StubAnalyser, StubCamera


@pytest.fixture
def config(tmp_path: Path) -> SidecarConfig:
    return SidecarConfig(port=0, data=tmp_path / "data")


@pytest.fixture
def camera() -> StubCamera:
    return StubCamera()


@pytest.fixture
def analyser() -> StubAnalyser:
    return StubAnalyser(fails=[1], unsure=[2])


@pytest.fixture
def url(config: SidecarConfig, camera: StubCamera, analyser: StubAnalyser) -> Iterator[str]:
    with running_sidecar(config, camera, analyser) as url:
        yield url


@pytest.fixture
def robot(url: str) -> Iterator[Robot]:
    with Robot(url) as robot:
        assert robot.register().status_code == 200
        yield robot
