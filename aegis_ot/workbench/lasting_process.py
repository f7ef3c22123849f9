"""The side of a rehearsing process that outlives its first caller: takes callers one by one.

Each caller gets a fork of its own, which performs its tasks as any rehearsing process does.
"""

from __future__ import annotations

import contextlib
import gc
import os
import pickle
import selectors
import signal
import socket
import time
from collections.abc import Callable
from pathlib import Path

from .files_read import Reads
from .link import Link, LinkAnswer
from .verdicts_kept import KeptVerdicts

_LOOK_S = 30.0
"""How often it looks whether its socket is still there."""

Serve = Callable[[Link, Path, Reads, KeptVerdicts, Link], None]


def outlive(place: Path, keep_s: float, first: Link, reads: Reads, serve: Serve) -> None:
    """Detach, listen at ``place``, and serve until nobody has called for ``keep_s``.

    Args:
        place: The socket.
        keep_s: Longest idle time, s.
        first: Told as soon as somebody can call.
        reads: What this process rests on: once that has changed, it takes no more callers.
        serve: Performs one caller's tasks.
    """
    listener = socket.socket(socket.AF_UNIX)
    own = place.with_name(f"{place.name}.{os.getpid()}")
    listener.bind(str(own))
    listener.listen(16)
    os.replace(own, place)
    if os.fork():
        os._exit(0)  # whoever started it waits for this one
    os.setsid()
    os.chdir("/")
    first.send(LinkAnswer("ready"))
    first.close()
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    gc.freeze()
    _Service(listener, place, reads, serve).run(keep_s)


class _Service:
    def __init__(self, listener: socket.socket, place: Path, reads: Reads, serve: Serve) -> None:
        self._listener = listener
        self._place = place
        self._mark = _mark(place)
        self._reads = reads
        self._serve = serve
        self._kept = KeptVerdicts()
        self._selector = selectors.DefaultSelector()
        self._selector.register(listener, selectors.EVENT_READ)

    def run(self, keep_s: float) -> None:
        heard = time.monotonic()
        while True:
            left = keep_s - (time.monotonic() - heard)
            alone = len(self._selector.get_map()) == 1
            if (alone and left <= 0) or not self._is_mine():
                break
            for key, _ in self._selector.select(min(_LOOK_S, max(0.1, left))):
                heard = time.monotonic()
                if key.fileobj is not self._listener:
                    self._learn(key.data)
                elif not self._take():
                    return self._leave()
        return self._leave()

    def _is_mine(self) -> bool:
        with contextlib.suppress(OSError):
            return _mark(self._place) == self._mark
        return False

    def _leave(self) -> None:
        if self._is_mine():
            self._place.unlink(missing_ok=True)
        os._exit(0)  # callers are in forks of their own

    def _take(self) -> bool:
        """Take one caller, unless what this process has loaded is old."""
        connection, _ = self._listener.accept()
        if not self._reads.stands():
            connection.close()
            return False
        mine, its = socket.socketpair()
        if os.fork() == 0:
            try:
                mine.close()
                self._listener.close()
                self._selector.close()
                self._attend(connection, its)
            finally:
                os._exit(0)
        connection.close()
        its.close()
        link = Link(mine.makefile("rb"), mine.makefile("wb"), trusts=True)
        self._selector.register(mine, selectors.EVENT_READ, link)
        return True

    def _learn(self, link: Link) -> None:
        """A verdict that a caller's fork has worked out, for all later ones."""
        try:
            self._kept.add(*link.receive())
        except (EOFError, OSError, pickle.UnpicklingError, TypeError):
            self._forget(link)

    def _forget(self, link: Link) -> None:
        for key in list(self._selector.get_map().values()):
            if key.data is link:
                self._selector.unregister(key.fileobj)
                link.close()
                assert isinstance(key.fileobj, socket.socket)
                key.fileobj.close()

    def _attend(self, connection: socket.socket, up: socket.socket) -> None:
        os.setsid()  # so that the caller can end it with all that it started
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        link, upward = _link_over(connection), _link_over(up)
        stacks = Path(link.receive())
        link.send(LinkAnswer(os.getpid()))
        self._serve(link, stacks, self._reads, self._kept, upward)


def _mark(place: Path) -> tuple[int, int]:
    found = place.stat()
    return found.st_ino, found.st_mtime_ns


def _link_over(connection: socket.socket) -> Link:
    """A link whose closing closes the socket."""
    number = connection.detach()
    return Link(os.fdopen(number, "rb"), os.fdopen(os.dup(number), "wb"), trusts=True)
