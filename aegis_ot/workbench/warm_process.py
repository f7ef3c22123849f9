"""A rehearsing process that outlives the command that started it, found through a socket.

Whoever finds it has the same Python, the same search path and the same environment: all are part
of the socket's name. The process itself says whether what it has loaded still stands on the disk.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import signal
import socket
import stat
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from .. import __version__
from .link import CAN_FORK, Link, LinkAnswer

WARM = "AEGIS_OT_WARM"
"""How long an idle rehearsing process stays, s; ``0``: none outlives its command."""

_KEEP_S = 600.0
_GREETING_S = 10.0
_LONGEST_PLACE = 92
"""Of a socket's address, bytes: macOS takes 103, Linux 107, and a process number follows it."""


def seconds_to_keep(environment: Mapping[str, str]) -> float:
    """How long a rehearsing process may stay idle, s; 0 where it must not stay.

    In a continuous integration (``CI`` is set) nothing is left behind, unless that is asked for.
    """
    if not CAN_FORK:
        return 0.0
    try:
        return max(0.0, float(environment.get(WARM, 0 if environment.get("CI") else _KEEP_S)))
    except ValueError:
        return 0.0


def place_of(environment: Mapping[str, str], python: Sequence[str]) -> Path | None:
    """Where such a process listens; ``None`` if there is no folder that is this user's alone, or
    only one whose path is too long for a socket.

    Args:
        environment: All that the process gets.
        python: The interpreter with its arguments, its search path among them.
    """
    told = *python, sys.version, __version__, __file__, sorted(environment.items())
    named = repr(told)
    folder = Path(os.environ.get("XDG_RUNTIME_DIR") or tempfile.gettempdir())
    folder /= f"aegis-ot-{os.getuid()}"
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        found = folder.lstat()
    except OSError:
        return None
    private = stat.S_ISDIR(found.st_mode) and not found.st_mode & 0o077
    if not private or found.st_uid != os.getuid():
        return None
    place = folder / hashlib.sha256(named.encode("utf-8", "backslashreplace")).hexdigest()[:20]
    return place if len(os.fsencode(place)) <= _LONGEST_PLACE else None


class Joined:
    """One caller's part of a process that serves several."""

    def __init__(self, connection: socket.socket, stacks: Path) -> None:
        self._connection = connection
        self.link = Link(connection.makefile("rb"), connection.makefile("wb"))
        self.link.send(str(stacks))
        greeting = self.link.receive()
        if not isinstance(greeting, LinkAnswer) or not isinstance(greeting.value, int):
            raise EOFError
        self._pid = greeting.value
        connection.settimeout(None)

    def kill(self) -> None:
        """End it with all that it started for this caller; the others' goes on."""
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(self._pid, signal.SIGKILL)

    def end(self) -> str:
        """End it; how it ended, in words."""
        self.kill()
        self.link.close()
        self._connection.close()
        return "it was ended"


def join(place: Path, stacks: Path) -> Joined | None:
    """Ask the process that listens here; ``None`` if none does, or what it has loaded is old."""
    connection: Any = socket.socket(socket.AF_UNIX)
    connection.settimeout(_GREETING_S)
    try:
        connection.connect(str(place))
        return Joined(connection, stacks)
    except (OSError, EOFError, ValueError):
        connection.close()
        return None
