"""``aegis-ot install`` as its user: over a real sshd on loopback, to something like a robot."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import httpx
import pytest

from aegis_ot import __version__
from aegis_ot.robot import RobotClient, installing
from aegis_ot.robot.wheel import write_wheel

from ..cli.commands import Command, Result
from ..support.robot_server import RobotServer
from ..support.sshd import Robot

Install = Callable[..., Result]


WAITS = """
metadata = {"apiLevel": "2.15"}

def run(protocol):
    protocol.pause("Wait.")
"""

PIP_SAYS = """
case "$1$(cat)" in
    -m*) {pip} ;;
    *simulate*) echo AEGIS {version} 8.2.0 3.10.8 1 ;;
    *) echo AEGIS 3.10.8 opentrons pip ;;
esac
"""
"""A Python that takes itself for a robot's, with a pip that does as it is told."""


@pytest.fixture(scope="module")
def one_robot(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Robot]:
    with Robot(tmp_path_factory.mktemp("robot")) as robot:
        yield robot


@pytest.fixture
def there(one_robot: Robot, monkeypatch: pytest.MonkeyPatch) -> Iterator[Robot]:
    monkeypatch.setenv("PATH", f"{one_robot.tools}:/usr/bin:/bin")
    with one_robot.as_it_is():
        yield one_robot


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_wheel(tmp_path_factory.mktemp("wheel"))


@pytest.fixture
def install(there: Robot, aegis: Command, wheel: Path, monkeypatch: pytest.MonkeyPatch) -> Install:
    monkeypatch.setattr(installing, "write_wheel", lambda folder: Path(shutil.copy(wheel, folder)))
    robot = f"127.0.0.1:{there.no_server}"
    reached = ("--user", there.user, "--port", there.port, "--key", there.key)
    return lambda *more: aegis("install", "--robot", robot, *reached, *more)


@pytest.mark.slow
def test_it_is_installed_tried_and_taken_up(there: Robot, install: Install) -> None:
    (there.packages / "aegis_ot").mkdir()
    (there.packages / "aegis_ot" / "guard.py").write_text("half of an earlier try")
    done = install()
    assert done.code == 0, done.err
    assert f"aegis-ot {__version__} works there, under Python 3." in done.out
    assert (there.packages / "aegis_ot" / "guard.py").stat().st_size > 1000
    assert (there.home / "systemctl").read_text().strip() == "restart opentrons-robot-server"
    assert len(done.out.splitlines()) == 5


def test_a_server_that_does_not_start_again(there: Robot, install: Install) -> None:
    there.says("python3", PIP_SAYS.format(pip="true", version=__version__))
    there.says("systemctl", "echo 'Unit not found.' >&2; exit 5")
    done = install()
    assert done.code == 2
    assert "installed and works, but" in done.err
    assert "Unit not found. Switch the robot off and on." in done.err
    assert not list((there.home / "tmp").iterdir())


def test_an_older_one_in_its_way(there: Robot, install: Install) -> None:
    there.says("python3", PIP_SAYS.format(pip="true", version="0.0.9"))
    done = install()
    assert done.code == 2
    assert "finds aegis-ot 0.0.9 first" in done.err


@pytest.mark.parametrize(
    ("python", "said"),
    [
        ("exit 127", r"There is no Python on 127\.0\.0\.1\..* Is it a robot\?"),
        ("echo AEGIS 3.10.8", r"has no opentrons\. Is it a robot\? Nothing was"),
        ("echo AEGIS 3.7.1 opentrons pip", "Python 3.7.1; the guard needs 3.10. Update"),
        ("echo AEGIS 3.10.8 opentrons", "aegis-ot wrap PROTOCOL.py --out GUARDED.py"),
        ("echo Hello.", "no answer that makes sense"),
    ],
)
def test_what_is_no_robot_is_left_alone(
    there: Robot, install: Install, python: str, said: str
) -> None:
    there.says("python3", python)
    done = install()
    assert done.code == 2
    assert re.search(said, done.err)
    assert len(done.err.splitlines()) == 1


@pytest.mark.parametrize(
    ("pip", "said"),
    [
        ("Could not install packages: [Errno 13] Permission denied: '/usr/x'", "Only root may"),
        ("OSError: [Errno 30] Read-only file system: '/usr/x'", "mount -o remount,rw"),
    ],
)
def test_a_pip_that_cannot_write(there: Robot, install: Install, pip: str, said: str) -> None:
    pip = f'echo "ERROR: {pip}"; exit 1'
    there.says("python3", PIP_SAYS.format(pip=pip, version=__version__))
    done = install()
    assert done.code == 2
    assert "could not be installed" in done.err
    assert said in done.err


@pytest.fixture
def interruptible() -> Iterator[None]:
    """A shell's background job ignores the interrupt, and Python with it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.slow
@pytest.mark.usefixtures("interruptible")
def test_interrupted_half_way_it_can_be_done_again(there: Robot, install: Install) -> None:
    pip = 'touch "$HOME/tmp/half-way"; exec sleep 60'
    there.says("python3", PIP_SAYS.format(pip=pip, version=__version__))
    interrupter = threading.Thread(target=_interrupt, args=(there.home / "tmp" / "half-way",))
    interrupter.start()
    done = install()
    interrupter.join()
    assert done.code == 130
    assert "Run it again" in done.err
    assert "Traceback" not in done.err


def _interrupt(once: Path) -> None:
    until = time.monotonic() + 60.0
    while not once.exists() and time.monotonic() < until:
        time.sleep(0.02)
    os.kill(os.getpid(), signal.SIGINT)


def test_a_wrong_key_file_is_told_at_once(aegis: Command) -> None:
    done = aegis("install", "--robot", "127.0.0.1", "--key", "no-such-key")
    assert done.code == 2
    assert "no-such-key" in done.err


def test_a_robot_that_runs_a_protocol_is_left_alone(
    aegis: Command, robot: RobotServer, client: RobotClient, tmp_path: Path
) -> None:
    protocol = tmp_path / "waits.py"
    protocol.write_text(WAITS, encoding="utf-8")
    run = client.create_run(client.upload(protocol)[0])
    client.act(run, "play")
    done = aegis("install", "--robot", robot.url, "--port", "1")
    client.act(run, "stop")
    assert done.code == 2
    assert "runs a protocol" in done.err
    assert "logging in" not in done.out


def test_a_server_that_does_not_come_up_is_no_reason_to_leave_it(
    aegis: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    broken = httpx.Response(503, json={"errors": [{"detail": "It failed to start."}]})
    answers = httpx.MockTransport(lambda request: broken)
    monkeypatch.setattr(
        "aegis_ot.robot.RobotClient", lambda robot: RobotClient(robot, transport=answers)
    )
    done = aegis("install", "--robot", "127.0.0.1", "--port", "1")
    assert done.code == 2
    assert "logging in" in done.out


def test_the_wheel_is_pure_and_complete(wheel: Path, tmp_path: Path) -> None:
    assert wheel.stat().st_size < 600_000
    with zipfile.ZipFile(wheel) as files:
        names = files.namelist()
        metadata = next(name for name in names if name.endswith("METADATA"))
        assert "Requires-Dist" not in files.read(metadata).decode()
        files.extractall(tmp_path / "site")
    assert all(name.endswith((".py", ".json", "METADATA", "WHEEL", "RECORD")) for name in names)
    assert not any(name.startswith(("aegis_ot/sidecar", "aegis_ot/vision")) for name in names)
    tried = (
        "import aegis_ot.guarded_run, aegis_ot.preflight.check_protocol as check\n"
        "print(check.load_rules())"
    )
    subprocess.run([sys.executable, "-c", tried], cwd=tmp_path / "site", check=True,
                   capture_output=True, env={"PYTHONPATH": str(tmp_path / "site")})  # fmt: skip
