"""What a process has read so far, and whether it still stands so on the disk.

A process that is kept alive judges by what it loaded once: this package, the engine, rules. It may
do so only as long as none of these files has changed.
"""

from __future__ import annotations

import contextlib
import os
import sys
import time
from collections.abc import Iterable, Mapping
from importlib.util import source_from_cache
from typing import Any

Signature = tuple[int, ...] | None
"""Of a file or folder as it stands: times, size and inode; ``None`` where there is none."""

_OPENS = frozenset({"open", "os.listdir", "os.scandir"})
_OUTWARD = frozenset(
    {
        "socket.connect", "socket.getaddrinfo", "socket.sendto", "subprocess.Popen", "os.system",
        "os.exec", "os.posix_spawn", "os.startfile", "os.putenv", "os.rename", "os.remove",
        "shutil.rmtree", "builtins.input", "ctypes.dlopen", "sqlite3.connect", "webbrowser.open",
    }
)  # fmt: skip
_WRITES = os.O_WRONLY | os.O_RDWR | os.O_CREAT


class Reads:
    """Listens to what this process opens. It cannot be taken off again.

    Attributes:
        paths: Every file and folder that was opened to be read, or was looked for.
        outward: What else it did that no file tells: writing, networks, programs.
    """

    def __init__(self) -> None:
        self.paths: set[str] = set()
        self.outward: set[str] = set()
        self._start_ns = time.time_ns()
        self._known: dict[str, Signature] = {}
        sys.addaudithook(self._heard)

    def settle(self) -> None:
        """Take what was read so far, all loaded modules among it, for what later has to stand.

        A folder of the search path that holds none of them counts for nothing: the import system
        only looked there, and it may be the busy one that somebody works in.
        """
        modules = _module_files()
        homes = {os.path.dirname(file) for file in modules}
        passed = {os.path.abspath(folder) for folder in sys.path} - homes
        self._known = signatures((self.paths - passed) | modules)

    def stands(self) -> bool:
        """Whether every file that was read before :meth:`settle` is what it was."""
        return all(
            (mark := _signature(path)) == known and max(mark or (0,)) < self._start_ns
            for path, known in self._known.items()
        )

    def _heard(self, event: str, arguments: tuple[Any, ...]) -> None:
        if event in _OPENS:
            path = arguments[0] if arguments else None
            if isinstance(path, (str, bytes)):
                name = os.path.abspath(os.fsdecode(path))
                self.paths.add(name)
                if event == "open" and _is_write(arguments[1:]):
                    self.outward.add(f"writes {name}")
        elif event in _OUTWARD:
            self.outward.add(event)


def signatures(paths: Iterable[str]) -> dict[str, Signature]:
    """Each path as it stands now; of a compiled module its source as well."""
    known = {path: _signature(path) for path in paths}
    for path in list(known):
        with contextlib.suppress(ValueError, NotImplementedError):
            source = source_from_cache(path)
            known[source] = _signature(source)
    return known


def unchanged(known: Mapping[str, Signature]) -> bool:
    """Whether all of these stand as they were."""
    return all(_signature(path) == mark for path, mark in known.items())


def _signature(path: str) -> Signature:
    try:
        found = os.stat(path)
    except (OSError, ValueError):
        return None
    if path.startswith(("/dev/", "/proc/", "/sys/")):
        return (0, 0, 0, 0)
    # A change time cannot be set by whoever unpacks an older file over a newer one.
    return (found.st_mtime_ns, found.st_ctime_ns, found.st_size, found.st_ino)


def _is_write(rest: tuple[Any, ...]) -> bool:
    mode, flags = (*rest, None, None)[:2]
    if isinstance(mode, str):
        return any(letter in mode for letter in "wax+")
    return isinstance(flags, int) and bool(flags & _WRITES)


def _module_files() -> set[str]:
    files = (getattr(module, "__file__", None) for module in list(sys.modules.values()))
    return {file for file in files if isinstance(file, str)}
