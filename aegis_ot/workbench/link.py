"""Messages between a command and its rehearsing process, and what comes back in them."""

from __future__ import annotations

import contextlib
import io
import pickle
import struct
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from typing import IO, Any

from .files_read import Signature
from .result import Problem

CAN_FORK = sys.platform == "linux"
"""Elsewhere a fork of a process with threads is not safe, or there is none."""


@dataclass(frozen=True)
class LinkAnswer:
    """What came of a task: a value, a problem, or the death of the process that did it.

    Attributes:
        value: What it gave.
        problem: Why it gave none.
        died: How its process ended, if that is why.
        stale: The process has loaded what has changed on the disk since: ask another one.
        rests_on: Every file that it opened or looked for, where it depends on nothing else.
    """

    value: Any = None
    problem: Problem | None = None
    died: str = ""
    stale: bool = False
    rests_on: Mapping[str, Signature] | None = None


class Link:
    """Pickled messages over two byte streams, each after its length; ``trusts`` the other side."""

    def __init__(self, incoming: IO[bytes], outgoing: IO[bytes], trusts: bool = False) -> None:
        self._unpickler = pickle.Unpickler if trusts else _Unpickler
        self._incoming = incoming
        self._outgoing = outgoing

    def send(self, message: object) -> None:
        """Send one message."""
        self.forward(pickle.dumps(message))

    def forward(self, data: bytes) -> None:
        """Send one message that is pickled already."""
        self._outgoing.write(struct.pack("!Q", len(data)) + data)
        self._outgoing.flush()

    def receive(self) -> Any:
        """Wait for one message.

        Raises:
            EOFError: The other side is gone.
            pickle.UnpicklingError: It is none of ours: a protocol wrote it.
        """
        return self.read(self.receive_bytes())

    def read(self, data: bytes) -> Any:
        """A message that was received pickled; raises as :meth:`receive`."""
        return self._unpickler(io.BytesIO(data)).load()

    def receive_bytes(self) -> bytes:
        """Wait for one message, and leave it pickled.

        Raises:
            EOFError: As for :meth:`receive`.
        """
        return self._exactly(struct.unpack("!Q", self._exactly(8))[0])

    def _exactly(self, size: int) -> bytes:
        data = self._incoming.read(size)
        if data is None or len(data) < size:
            raise EOFError
        return data

    def close(self) -> None:
        """Close both streams."""
        for stream in (self._outgoing, self._incoming):
            with contextlib.suppress(OSError):
                stream.close()


class _Unpickler(pickle.Unpickler):
    """Makes objects of this package and plain values only: a protocol may have written them."""

    def load(self) -> Any:
        try:
            return super().load()
        except Exception as error:
            raise pickle.UnpicklingError(str(error)) from error

    def find_class(self, module: str, name: str) -> Any:
        if module.partition(".")[0] == __name__.partition(".")[0] or (module, name) in _PLAIN:
            found = super().find_class(module, name)
            if isinstance(found, type) and found.__module__ == module:
                return found
        raise pickle.UnpicklingError(f"{module}.{name} is not part of an answer.")


_PLAIN = {("builtins", name) for name in ("set", "frozenset", "complex", "bytearray", "range")} | {
    ("collections", name) for name in ("Counter", "OrderedDict", "defaultdict", "deque")
}
