"""Ends a rehearsal that does not end by itself, or whose run is being stopped."""

from __future__ import annotations

import ctypes
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from contextvars import ContextVar

from ....errors import RehearsalError, RehearsalTimeout
from .refusals import line_of

_LOOK_S = 0.1

_AGAIN_S = 1.0
"""When to interrupt once more what swallowed the first interruption, s."""

Clock = Callable[[float], AbstractContextManager[None]]
"""Given the seconds that are allowed, a ``with`` block that ends what takes longer."""

_SECOND_CLOCK: ContextVar[Clock] = ContextVar(
    "aegis_ot_second_clock", default=lambda _: nullcontext()
)


@contextmanager
def second_clock(clock: Clock) -> Iterator[None]:
    """Start ``clock`` whenever a rehearsal's own clock starts, in a ``with`` block.

    For what an interruption cannot reach. It starts with the protocol's first line, so what
    Opentrons takes to get ready, which a busy machine draws out, is not counted.
    """
    token = _SECOND_CLOCK.set(clock)
    try:
        yield
    finally:
        _SECOND_CLOCK.reset(token)


@contextmanager
def interrupted_after(
    timeout_s: float, file_name: str, is_stopping: Callable[[], bool] = lambda: False
) -> Iterator[None]:
    """Interrupt what this thread does in a ``with`` block, after ``timeout_s`` s or on a stop, for
    which ``is_stopping`` is asked every 0.1 s.

    An endless loop in plain Python never comes back to a listener, so it is interrupted from
    another thread, again and again if it swallows that. A call that blocks inside C code is
    interrupted when it returns.

    Raises:
        RehearsalTimeout: The time was over.
        RehearsalError: ``is_stopping`` said so.
    """
    thread = threading.get_ident()
    interrupt = ctypes.pythonapi.PyThreadState_SetAsyncExc
    lock = threading.Lock()
    over = threading.Event()
    deadline = time.monotonic() + timeout_s
    reasons: list[RehearsalError] = []

    def watch() -> None:
        pause = _LOOK_S
        while not over.wait(pause):
            if is_stopping():
                reason = RehearsalError(f"The run was stopped while {file_name} was rehearsed.")
            elif time.monotonic() >= deadline:
                reason = RehearsalTimeout(
                    f"{file_name} did not end within {timeout_s:g} s of rehearsal."
                )
            else:
                continue
            pause = _AGAIN_S
            with lock:
                if not over.is_set():
                    reasons.append(reason)
                    interrupt(ctypes.c_ulong(thread), ctypes.py_object(_Interrupted))

    def close() -> None:
        try:
            with lock:
                over.set()
            if reasons:
                time.sleep(0.001)  # an interruption that is still on its way arrives here
        except _Interrupted:
            over.set()

    threading.Thread(target=watch, name="aegis-ot-rehearsal", daemon=True).start()
    try:
        with _SECOND_CLOCK.get()(timeout_s):
            yield
    except _Interrupted as error:
        if not reasons:  # the clock of a block around this one
            raise
        reasons[0].line = line_of(error, file_name)
        raise reasons[0] from None
    finally:
        close()


class _Interrupted(BaseException):
    """Not an ``Exception``, so that a protocol's own ``except Exception`` lets it pass."""
