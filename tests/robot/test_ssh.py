"""The shell of a robot, over a real sshd on loopback."""

from __future__ import annotations

import os
import shutil
import signal
import socket
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from aegis_ot.errors import RobotError
from aegis_ot.robot import ssh
from aegis_ot.robot.ssh import Failed, Shell

from ..support.sshd import Robot


@pytest.fixture(scope="module")
def one_robot(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Robot]:
    with Robot(tmp_path_factory.mktemp("robot")) as robot:
        yield robot


@pytest.fixture
def robot(one_robot: Robot, monkeypatch: pytest.MonkeyPatch) -> Robot:
    monkeypatch.setenv("PATH", f"{one_robot.tools}:/usr/bin:/bin")
    return one_robot


@pytest.fixture
def shell(robot: Robot) -> Shell:
    return Shell("127.0.0.1", robot.user, robot.port, robot.key)


def test_a_command_gets_its_input_in_a_login_shell(shell: Shell) -> None:
    said = shell.run("cat; which python3", b"Hello.\n")
    assert "Hello." in said
    assert said.endswith("/home/python/bin/python3")


def test_a_command_that_fails_keeps_what_it_said(shell: Shell) -> None:
    with pytest.raises(Failed, match=r"127\.0\.0\.1 says: .*No such thing\.$") as caught:
        shell.run("echo 'No such thing' >&2; exit 3")
    assert caught.value.status == 3


def test_nobody_listens(robot: Robot, shell: Shell) -> None:
    with pytest.raises(RobotError, match=r"Connection refused.*not switched on.*aegis-ot wrap"):
        replace(shell, port=robot.no_server).run("true")


def test_a_host_that_nobody_knows(shell: Shell) -> None:
    with pytest.raises(RobotError, match=r"resolve hostname.*as the Opentrons App shows it"):
        replace(shell, host="no-such-robot.invalid").run("true")


def test_a_key_that_is_not_let_in(robot: Robot, shell: Shell, tmp_path: Path) -> None:
    with pytest.raises(RobotError, match=r"Permission denied.*public key on the robot"):
        replace(shell, key=robot.host_key).run("true")
    readable = tmp_path / "key"
    shutil.copyfile(robot.key, readable)
    readable.chmod(0o644)
    with pytest.raises(RobotError, match="chmod 600"):
        replace(shell, key=readable).run("true")


def test_a_robot_is_believed_once_and_has_to_stay_the_same(robot: Robot, shell: Shell) -> None:
    shell.run("true")
    robot.start()
    with pytest.raises(RobotError, match=rf"ssh-keygen -R '\[127.0.0.1\]:{robot.port}'"):
        shell.run("true")
    robot.known.unlink()
    shell.run("true")


def test_a_robot_switched_off_half_way(robot: Robot, shell: Shell) -> None:
    killer = threading.Thread(target=_kill, args=(robot.home / "session",))
    killer.start()
    with pytest.raises(RobotError, match=r"127\.0\.0\.1.*Try again when the robot is back"):
        shell.run("echo $PPID > $HOME/session; exec sleep 60")
    killer.join()


def test_what_takes_too_long_is_given_up(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ssh, "CONNECT_S", 1)
    with pytest.raises(RobotError, match=r"did not finish within 0\.5 s"):
        shell.run("sleep 20", limit_s=0.5)
    with socket.create_server(("127.0.0.1", 0)) as silent:  # takes the call, and says nothing
        port = silent.getsockname()[1]
        with pytest.raises(RobotError, match=r"timed out.*switched on"):
            replace(shell, port=port).run("true")


def test_no_ssh_here(shell: Shell, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(RobotError, match="no ssh on this computer"):
        shell.run("true")


def _kill(noted: Path) -> None:
    """Kill the process whose number stands there, once it does."""
    until = time.monotonic() + 60.0
    while time.monotonic() < until:
        if noted.exists() and (number := noted.read_text().strip()):
            os.kill(int(number), signal.SIGKILL)
            return
        time.sleep(0.02)
