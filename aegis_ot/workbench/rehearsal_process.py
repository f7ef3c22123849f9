"""The rehearsing process: performs one task after another, each in a fork where that exists.

Protocols are other people's programs. They print, end the process, crash it, loop for ever, or
change what opentrons' own modules hold. So no two share a process, and none has this
process's standard streams: those carry the answers, and are moved away first. A fork has a pipe
of its own, so whatever its protocol writes there spoils no other's answer.
"""

from __future__ import annotations

import contextlib
import dataclasses
import faulthandler
import io
import os
import pickle
import sys
from collections.abc import Iterator
from pathlib import Path

from ..adapters.opentrons.rehearsal import second_clock
from .files_read import Reads, signatures
from .lasting_process import outlive
from .link import CAN_FORK, Link, LinkAnswer
from .problems import problem_of
from .result import Problem
from .tasks import Task, prepare
from .verdicts_kept import Kept, KeptVerdicts, key_of

ANSWERED = 85
"""Exit status of a fork that has sent its answer; any other has died without."""


def grace_s(timeout_s: float) -> float:
    """How long after its time a protocol may take to be interrupted, so that it says where."""
    return min(5.0, max(0.6, 0.3 * timeout_s))


_MEMORY_BYTES = 6 << 30


def main() -> None:
    """Serve until the other side closes.

    Arguments: a file for stacks; a socket to listen at and for how long, s, or two empty ones;
    paths of rules.
    """
    reads = Reads()
    stacks, place, keep_s, *rules = sys.argv[1:]
    link = _private_streams()
    try:
        prepare(tuple(rules))
    except ImportError as error:
        link.send(LinkAnswer(problem=Problem(str(error))))
        return
    reads.settle()
    if place:
        outlive(Path(place), float(keep_s), link, reads, serve)
    link.send(LinkAnswer("ready"))
    serve(link, Path(stacks), reads, KeptVerdicts())


def serve(
    link: Link, stacks: Path, reads: Reads, kept: KeptVerdicts, upward: Link | None = None
) -> None:
    """Perform one caller's tasks until it closes its side.

    Args:
        link: To the caller.
        stacks: File for the stacks of a task that dies.
        reads: What this process rests on.
        kept: Verdicts that still hold are given anew.
        upward: Told of each verdict that may hold for other callers as well.
    """
    while True:
        try:
            task = pickle.loads(link.receive_bytes())  # from this package: no protocol writes it
        except EOFError:
            return
        if not reads.stands():
            link.send(LinkAnswer(stale=True))
        elif CAN_FORK:
            key = key_of(task)
            known = kept.find(key)
            answer = known or _fork(task, link, stacks, reads, upward)
            link.forward(answer)
            if key and not known and (new := _to_keep(answer)):
                kept.add(key, new)
                if upward is not None:
                    upward.send((key, new))
        else:
            link.forward(_served(task, stacks, reads))


def _to_keep(answer: bytes) -> Kept | None:
    """The answer without what it rests on, if it rests on files alone."""
    told = Link(io.BytesIO(), io.BytesIO()).read(answer)
    if not isinstance(told, LinkAnswer) or told.rests_on is None or told.problem is not None:
        return None
    return Kept(pickle.dumps(dataclasses.replace(told, rests_on=None)), told.rests_on)


def _private_streams() -> Link:
    """Take the standard streams for the link, and leave nothing behind them."""
    incoming = os.fdopen(os.dup(0), "rb")
    outgoing = os.fdopen(os.dup(1), "wb")
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(nowhere, stream)
    os.close(nowhere)
    return Link(incoming, outgoing, trusts=True)  # tasks hold paths and what others need


def _fork(task: Task, link: Link, stacks: Path, reads: Reads, upward: Link | None) -> bytes:
    """Perform a task in a fork; its answer, as it was sent."""
    reading, writing = os.pipe()
    pid = os.fork()
    if pid == 0:
        try:
            os.close(reading)
            link.close()
            if upward is not None:
                upward.close()
            _limit_memory()
            Link(io.BytesIO(), os.fdopen(writing, "wb")).forward(_served(task, stacks, reads))
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
        return answer
    how = f"signal {-code}" if code < 0 else f"exit status {code}"
    return pickle.dumps(LinkAnswer(died=how))


def _limit_memory() -> None:
    """A protocol that hoards memory gets a MemoryError, with its line, and not the machine."""
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    limit = _MEMORY_BYTES if hard == resource.RLIM_INFINITY else min(hard, _MEMORY_BYTES)
    resource.setrlimit(resource.RLIMIT_AS, (limit, hard))


def _served(task: Task, stacks: Path, reads: Reads) -> bytes:
    """The answer to a task, ready to be sent."""
    reads.paths.clear()
    reads.outward.clear()
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
                value = task.perform()
                rests_on = None if reads.outward else signatures(reads.paths - {str(stacks)})
                answer = LinkAnswer(value, rests_on=rests_on)
        except BaseException as error:
            answer = LinkAnswer(problem=problem_of(error, task.file_name))
        faulthandler.disable()
    try:
        return pickle.dumps(answer)
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        return pickle.dumps(LinkAnswer(problem=problem_of(error, task.file_name)))
