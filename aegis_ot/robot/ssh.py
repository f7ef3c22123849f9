"""A robot's shell over ssh: one command at a time, with what went wrong in words for people."""

from __future__ import annotations

import shlex
import subprocess
from dataclasses import dataclass
from pathlib import Path

from ..errors import RobotError

CONNECT_S = 15
_SILENCE_S, _SILENCES = 5, 3
"""A robot that was switched off meanwhile is given up after so many silences, each so long."""
_HELP = "Opentrons' help: 'Setting up SSH access'"
_CHANGED = "REMOTE HOST IDENTIFICATION HAS CHANGED"
_ADVICE = (
    ("Could not resolve hostname", "Give its number as the Opentrons App shows it."),
    (
        "Connection refused",
        f"ssh is not switched on there, or listens elsewhere ({_HELP}). A file of aegis-ot wrap "
        "needs no ssh; where access to the robot is controlled, it is the only way.",
    ),
    ("timed out", "Is it switched on, and in the same network?"),
    ("No route to host", "Is it switched on, and in the same network?"),
    ("Network is unreachable", "Is it switched on, and in the same network?"),
    ("UNPROTECTED PRIVATE KEY FILE", "Others may read the key file: run 'chmod 600' on it first."),
    (
        "Permission denied",
        f"Put your public key on the robot first ({_HELP}), or name yours with --key. A key with "
        "a passphrase has to be known to an agent (ssh-add).",
    ),
    *(
        (mark, "The connection broke off. Try again when the robot is back.")
        for mark in ("closed by", "reset by", "not responding", "Broken pipe")
    ),
)
"""What ssh says, and what a person can do about it. It has no other way of telling."""


class Failed(RobotError):
    """A command failed on the robot.

    Attributes:
        status: Its exit status.
        said: What it wrote, standard output before standard error.
    """

    def __init__(self, message: str, status: int, said: str) -> None:
        super().__init__(message)
        self.status = status
        self.said = said


@dataclass(frozen=True)
class Shell:
    """How to reach a robot's shell.

    A robot that was never reached before is believed; one that shows another key than last time
    is not.

    Attributes:
        host: Its name or number.
        user: Who logs in.
        port: ``None`` for that of ssh's own configuration.
        key: Private key file; ``None`` for those that ssh finds itself.
    """

    host: str
    user: str = "root"
    port: int | None = None
    key: Path | None = None

    def run(self, command: str, given: bytes = b"", limit_s: float = 60.0) -> str:
        """Run a command in a login shell, which knows the packages of the robot's users.

        Args:
            command: For ``sh``.
            given: Its standard input.
            limit_s: How long it may take.

        Returns:
            Its standard output.

        Raises:
            Failed: It ended with an error.
            RobotError: There is no way to the robot, or it did not finish in time.
        """
        argv = [*self._ssh(), f"sh -l -c {shlex.quote(command)}"]
        try:
            done = subprocess.run(
                argv, input=given, capture_output=True, timeout=limit_s + CONNECT_S, check=False
            )
        except FileNotFoundError:
            raise RobotError(
                "There is no ssh on this computer. Install an OpenSSH client."
            ) from None
        except subprocess.TimeoutExpired:
            raise RobotError(f"{self.host} did not finish within {limit_s:g} s.") from None
        out, err = (text.decode("utf-8", "replace").strip() for text in (done.stdout, done.stderr))
        if done.returncode == 255:
            raise RobotError(self._no_way(err))
        if done.returncode:
            said = f"{out}\n{err}".strip()
            raise Failed(f"{self.host} says: {_last_words(said)}", done.returncode, said)
        return out

    def _ssh(self) -> list[str]:
        options = {
            "BatchMode": "yes",
            "ConnectTimeout": CONNECT_S,
            "ServerAliveInterval": _SILENCE_S,
            "ServerAliveCountMax": _SILENCES,
            "StrictHostKeyChecking": "accept-new",
        }
        if self.key is not None:
            options["IdentitiesOnly"] = "yes"
        argv = ["ssh", "-l", self.user]
        argv += [part for name, value in options.items() for part in ("-o", f"{name}={value}")]
        argv += ["-p", str(self.port)] if self.port is not None else []
        argv += ["-i", str(self.key)] if self.key is not None else []
        return [*argv, "--", self.host]

    def _no_way(self, said: str) -> str:
        if _CHANGED in said:
            name = self.host if self.port in (None, 22) else f"[{self.host}]:{self.port}"
            return (
                f"{self.host} shows another host key than last time. If the robot was reset or "
                f"exchanged, forget its old key with: ssh-keygen -R {shlex.quote(name)}. If not, "
                "another machine may have its address: do not go on."
            )
        advice = next((words for mark, words in _ADVICE if mark in said), "")
        return f"ssh cannot reach {self.user}@{self.host}. {_last_words(said)} {advice}".rstrip()


def _last_words(said: str) -> str:
    """The last lines, without the banners above them; ends in a full stop."""
    lines = [line.strip() for line in said.splitlines() if line.strip()]
    words = " ".join(lines[-3:])[-400:] or "It gave no reason."
    return words if words[-1] in ".!?" else f"{words}."
