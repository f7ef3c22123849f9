"""The rehearsing process: performs one task after another, each in a fork where that exists.

Protocols are other people's programs. They print, end the process, crash it, loop for ever, or
change what opentrons' own modules hold. So no two share a process, and none has this
process's standard streams: those carry the answers, and are moved away first. A fork has a pipe
of its own, so whatever its protocol writes there spoils no other's answer.
"""

from __future__ import annotations

import contextlib
import faulthandler
import io
import os
import pickle
import struct
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from ..preflight.rehearsal import second_clock
from .problems import problem_of
from .result import Problem
from .tasks import Task, prepare

CAN_FORK = sys.platform == "linux"
"""Elsewhere a fork of a process with threads is not safe, or there is none."""

ANSWERED = 85
"""Exit status of a fork that has sent its answer; any other has died without."""


def grace_s(timeout_s: float) -> float:
    """How long after its time a protocol may take to be interrupted, so that it says where."""
    return min(5.0, max(0.6, 0.3 * timeout_s))


_MEMORY_BYTES = 6 << 30


@dataclass(frozen=True)
class Answer:
    """What came of a task: a value, a problem, or the death of the process that did it."""

    value: Any = None
    problem: Problem | None = None
    died: str = ""


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
        return self._unpickler(io.BytesIO(self.receive_bytes())).load()

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


def main() -> None:
    """Serve until the other side closes. Arguments: a file for stacks, paths of rules."""
    stacks = Path(sys.argv[1])
    link = _private_streams()
    try:
        prepare(tuple(sys.argv[2:]))
    except ImportError as error:
        link.send(Answer(problem=Problem(str(error))))
        return
    link.send(Answer("ready"))
    while True:
        try:
            task = pickle.loads(link.receive_bytes())  # from this package: no protocol writes it
        except EOFError:
            return
        if CAN_FORK:
            _fork(task, link, stacks)
        else:
            _serve(task, link, stacks)


def _private_streams() -> Link:
    """Take the standard streams for the link, and leave nothing behind them."""
    incoming = os.fdopen(os.dup(0), "rb")
    outgoing = os.fdopen(os.dup(1), "wb")
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(nowhere, stream)
    os.close(nowhere)
    return Link(incoming, outgoing, trusts=True)  # tasks hold paths and what others need


def _fork(task: Task, link: Link, stacks: Path) -> None:
    reading, writing = os.pipe()
    pid = os.fork()
    if pid == 0:
        try:
            os.close(reading)
            link.close()
            _limit_memory()
            _serve(task, Link(io.BytesIO(), os.fdopen(writing, "wb")), stacks)
            os._exit(ANSWERED)
        finally:
            os._exit(1)
    os.close(writing)
    own = Link(os.fdopen(reading, "rb"), io.BytesIO())
    answer = b""
    with contextlib.suppress(EOFError, MemoryError, OverflowError):
        answer = own.receive_bytes()
    own.close()
    _, status = os.waitpid(pid, 0)
    code = os.waitstatus_to_exitcode(status)
    if code == ANSWERED:
        link.forward(answer)
    else:
        how = f"signal {-code}" if code < 0 else f"exit status {code}"
        link.send(Answer(died=how))


def _limit_memory() -> None:
    """A protocol that hoards memory gets a MemoryError, with its line, and not the machine."""
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    limit = _MEMORY_BYTES if hard == resource.RLIM_INFINITY else min(hard, _MEMORY_BYTES)
    resource.setrlimit(resource.RLIMIT_AS, (limit, hard))


def _serve(task: Task, link: Link, stacks: Path) -> None:
    with stacks.open("wb") as file:
        # After a crash this tells the line.
        faulthandler.enable(file=file)

        @contextlib.contextmanager
        def last_resort(limit_s: float) -> Iterator[None]:
            """Tell the line and end the process: the protocol let no interruption through."""
            faulthandler.dump_traceback_later(limit_s + grace_s(limit_s), exit=True, file=file)
            try:
                yield
            finally:
                faulthandler.cancel_dump_traceback_later()

        try:
            with second_clock(last_resort):
                answer = Answer(task.perform())
        except BaseException as error:
            answer = Answer(problem=problem_of(error, task.file_name))
        faulthandler.disable()
    try:
        link.send(answer)
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        link.send(Answer(problem=problem_of(error, task.file_name)))
