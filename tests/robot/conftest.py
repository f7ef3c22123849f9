from __future__ import annotations

from collections.abc import Iterator

import pytest

from aegis_ot.robot import RobotClient

from ..cli.conftest import aegis
from ..support.robot_server import RobotServer

__all__ = ["aegis", "client", "robot"]


@pytest.fixture
def robot() -> Iterator[RobotServer]:
    with RobotServer() as server:
        yield server


@pytest.fixture
def client(robot: RobotServer) -> Iterator[RobotClient]:
    with RobotClient(robot.url) as it:
        yield it
