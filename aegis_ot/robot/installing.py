"""Puts the robot half onto a robot over ssh, and tries it there."""

from __future__ import annotations

import shlex
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import urlsplit

from ..errors import RobotError
from .address import robot_url
from .wheel import write_wheel

_TIMEOUT_S = 300.0
_CONNECT_S = 15
_TRY = '''
import io, sys, opentrons, opentrons.simulate as simulate
import aegis_ot
text = """
from aegis_ot import guard
metadata = {"apiLevel": "2.13"}
@guard(assay="generic", rules="warn")
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2")
    pipette = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    pipette.transfer(50, plate["A1"], plate["A2"])
"""
log, _ = simulate.simulate(io.StringIO(text), "try.py", log_level="none")
said = [e["payload"]["text"] for e in log if "Layer 1: " in e["payload"].get("text", "")]
print("AEGIS", aegis_ot.__version__, opentrons.__version__, sys.version.split()[0], len(said))
'''


@dataclass(frozen=True)
class Installed:
    """What is on the robot now.

    Attributes:
        version: Of aegis-ot.
        opentrons, python: That it runs under there.
        size: Of the wheel, bytes.
    """

    version: str
    opentrons: str
    python: str
    size: int


def install(
    host: str,
    key: Path | None = None,
    restart: bool = True,
    told: Callable[[str], None] = lambda text: None,
) -> Installed:
    """Copy the wheel to a robot, install it with the robot's pip, try it, restart the server.

    Args:
        host: The robot, as for :func:`~.address.robot_url`; it must let us in as root by ssh.
        key: Private key file for ssh.
        restart: Whether the robot's server is restarted, so that it takes the new version.
        told: Told what goes on.

    Raises:
        RobotError: A step failed, with what the robot said.
    """
    name = urlsplit(robot_url(host)).hostname or host
    ssh = ["ssh", "-o", f"ConnectTimeout={_CONNECT_S}", "-o", "BatchMode=yes"]
    ssh += ["-i", str(key)] if key is not None else []
    ssh += [f"root@{name}"]
    with tempfile.TemporaryDirectory() as folder:
        wheel = write_wheel(Path(folder))
        data = wheel.read_bytes()
    there = f"/tmp/{wheel.name}"
    told(f"copying {wheel.name} ({len(data) / 1000:.0f} kB)")
    _do(ssh, f"cat > {there}", data, "could not be copied")
    told("installing")
    pip = (
        "python3 -m pip install --no-deps --no-index --force-reinstall --disable-pip-version-check"
    )
    try:
        _do(ssh, _login(f"{pip} {there}"), b"", "could not be installed")
    finally:
        _do(ssh, f"rm -f {there}", b"", "could not be tidied up")
    told("trying it on a protocol of four steps")
    said = _do(ssh, _login("python3 -"), _TRY.encode(), "is installed, but does not work")
    words = next((line.split() for line in said.splitlines() if line.startswith("AEGIS ")), [])
    if len(words) != 5 or words[4] == "0":
        raise RobotError(f"aegis-ot is installed on {name}, but does not work there: {said[-500:]}")
    if restart:
        told("restarting the robot's server")
        _do(ssh, "systemctl restart opentrons-robot-server", b"", "could not be taken up")
    return Installed(words[1], words[2], words[3], len(data))


def _login(command: str) -> str:
    """A login shell: it knows where the robot keeps the packages of its users."""
    return f"sh -l -c {shlex.quote(command)}"


def _do(ssh: Sequence[str], command: str, given: bytes, failed: str) -> str:
    try:
        done = subprocess.run(
            [*ssh, command], input=given, capture_output=True, timeout=_TIMEOUT_S, check=False
        )
    except FileNotFoundError:
        raise RobotError("There is no ssh on this computer. Install an OpenSSH client.") from None
    except subprocess.TimeoutExpired:
        raise RobotError(f"The robot did not finish within {_TIMEOUT_S:g} s: {command}") from None
    said = (done.stdout + done.stderr).decode("utf-8", "replace")
    if done.returncode == 0:
        return said
    if done.returncode == 255:
        raise RobotError(
            f"ssh cannot log in as {ssh[-1]}: {said.strip()[-300:]} Put your public key on the "
            "robot first (Opentrons' help: 'Setting up SSH access'), or name yours with --key."
        )
    hint = (
        " Its disk is read-only: run 'mount -o remount,rw /' there first."
        if ("ead-only file system" in said)
        else ""
    )
    raise RobotError(f"aegis-ot {failed}: {said.strip()[-500:]}{hint}")
