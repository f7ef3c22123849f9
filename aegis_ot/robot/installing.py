"""Puts the robot half onto a robot over ssh, and tries it there."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import urlsplit

from .._version import __version__
from ..errors import RobotError
from .address import robot_url
from .ssh import Failed, Shell
from .wheel import write_wheel

_INSTALL_S = 300.0
_TRY_S = 300.0
"""An OT-2 takes half a minute to import its own software."""
_LOOK = """
import sys
from importlib.util import find_spec
print("AEGIS", sys.version.split()[0], *(n for n in ("opentrons", "pip") if find_spec(n)))
"""
_INSTALL = """
set -e
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/{name}"
python3 -m pip install --no-deps --no-index --force-reinstall --no-cache-dir \
--disable-pip-version-check "$folder/{name}" 2>&1
"""
"""One command, so that nothing of it stays behind where the connection breaks off."""
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
_OLDEST = (3, 10)
_ADVICE = (
    ("ead-only file system", "Its disk is read-only: run 'mount -o remount,rw /' there first."),
    ("ermission denied", "Only root may install there."),
    ("No space left", "Its disk is full: delete old runs and protocols in the App first."),
)


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
    *,
    user: str = "root",
    port: int | None = None,
) -> Installed:
    """Copy the wheel to a robot, install it with the robot's pip, try it, restart the server.

    Args:
        host: The robot, as for :func:`~.address.robot_url`.
        key, user, port: As for :class:`~.ssh.Shell`.
        restart: Whether the robot's server is restarted, so that it takes the new version.
        told: Told what goes on.

    Raises:
        RobotError: A step failed, with what the robot said and what can be done.
    """
    shell = Shell(urlsplit(robot_url(host)).hostname or host, user, port, key)
    told("logging in")
    _look(shell)
    with tempfile.TemporaryDirectory() as folder:
        wheel = write_wheel(Path(folder))
        data = wheel.read_bytes()
    told(f"installing {wheel.name} ({len(data) / 1000:.0f} kB)")
    try:
        shell.run(_INSTALL.format(name=wheel.name), data, _INSTALL_S)
    except Failed as error:
        advice = next((words for mark, words in _ADVICE if mark in error.said), "")
        raise RobotError(f"aegis-ot could not be installed. {error} {advice}".rstrip()) from None
    told("trying it on a protocol of four steps")
    found = _try(shell, len(data))
    if restart:
        told("restarting the robot's server")
        try:
            shell.run("systemctl restart opentrons-robot-server")
        except Failed as error:
            raise RobotError(
                "aegis-ot is installed and works, but the robot's server still runs without it. "
                f"{error} Switch the robot off and on."
            ) from None
    return found


def _look(shell: Shell) -> None:
    """Refuse what is no robot before anything is changed there."""
    try:
        words = _words(shell.run("python3 -", _LOOK.encode()))
    except Failed as error:
        raise RobotError(f"There is no Python on {shell.host}. {error} Is it a robot?") from None
    if not words:
        raise RobotError(f"{shell.host} gave no answer that makes sense. Is it a robot?")
    python, *packages = words
    if "opentrons" not in packages:
        raise RobotError(
            f"The Python {python} on {shell.host} has no opentrons. Is it a robot? Nothing was "
            "installed."
        )
    if tuple(int(part) for part in python.split(".")[:2]) < _OLDEST:
        raise RobotError(
            f"{shell.host} has Python {python}; the guard needs 3.10. Update the robot's software "
            "in the Opentrons App first."
        )
    if "pip" not in packages:
        raise RobotError(
            f"The Python {python} on {shell.host} has no pip, so nothing can be installed. Put "
            "the guard into your protocols instead: aegis-ot wrap PROTOCOL.py --out GUARDED.py"
        )


def _try(shell: Shell, size: int) -> Installed:
    try:
        said = shell.run("python3 -", _TRY.encode(), _TRY_S)
    except Failed as error:
        raise RobotError(f"aegis-ot is installed, but does not work there. {error}") from None
    words = _words(said)
    if len(words) != 4 or words[3] == "0":
        raise RobotError(
            f"aegis-ot is installed on {shell.host}, but does not work there: {said[-500:]}"
        )
    if words[0] != __version__:
        raise RobotError(
            f"aegis-ot {__version__} is installed on {shell.host}, but its Python finds aegis-ot "
            f"{words[0]} first. Remove that there: python3 -m pip uninstall aegis-ot, then again."
        )
    return Installed(words[0], words[1], words[2], size)


def _words(said: str) -> list[str]:
    """What a script of ours printed, among what a login shell may say."""
    return next((li.split()[1:] for li in said.splitlines() if li.startswith("AEGIS ")), [])
