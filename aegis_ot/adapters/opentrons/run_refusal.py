"""After a rejection or an abort: a context with which nothing moves any more.

A protocol can catch the error that should have ended it (``except Exception``) and go on. Then
every further operation is refused with the same error, below all that a protocol can call: on
the cores of this context, its instruments and modules, and on its way to the engine. Instances
only; it stays on the context for as long as that lives.
"""

from __future__ import annotations

import functools
import inspect
import sys
from collections.abc import Callable, Iterator
from types import FrameType, MethodType
from typing import Any

from ...errors import AegisError

PATIENCE = 3
"""Refused operations after which a protocol is taken to try again and again."""

_OVER = "Nothing moves with this protocol context any more: a new run needs a new one."

# What a core is asked and not told.
_QUESTIONS = ("get_", "is_", "has_", "api_")


def refuse_everything(protocol: Any, error: AegisError, file_name: str) -> None:
    """Let every further operation of ``protocol`` raise an error like ``error``.

    Args:
        protocol: The context.
        error: Why; its type and text are what every operation raises.
        file_name: ``co_filename`` of the protocol's code. A protocol that tries a third time is
            thrown out of its own loop: ``while True: try: ... except: continue`` would never end.
    """
    refusal = _Refusal(type(error), str(error), file_name)
    for core in _cores(protocol):
        for name in _verbs(core):
            refusal.put_before(core, name)
    client = getattr(protocol._core, "_engine_client", None)
    if client is not None:
        for name in _verbs(client):
            if name.startswith("execute"):
                refusal.put_before(client, name)


def _cores(protocol: Any) -> Iterator[Any]:
    yield protocol._core
    for instrument in protocol.loaded_instruments.values():
        yield instrument._core
    yield from protocol._core.get_module_cores()


def _verbs(core: Any) -> Iterator[str]:
    for name, _ in inspect.getmembers(type(core), inspect.isfunction):
        if not name.startswith("_") and not name.startswith(_QUESTIONS):
            yield name


class _Refusal:
    def __init__(self, kind: type[AegisError], text: str, file_name: str) -> None:
        self._kind = kind
        self._text = text
        self._file_name = file_name
        self._refused = 0

    def put_before(self, target: Any, name: str) -> None:
        original = getattr(target, name)

        @functools.wraps(original)
        def refused(_self: Any, *_args: Any, **_kwargs: Any) -> Any:
            self._refused += 1
            if self._refused >= PATIENCE:
                _throw_out(self._file_name, self._error)
            raise self._error()

        setattr(target, name, MethodType(refused, target))

    def _error(self) -> AegisError:
        return self._kind(f"{self._text} {_OVER}")


def _throw_out(file_name: str, make: Callable[[], AegisError]) -> None:
    """Raise at the next line that the protocol reaches: the first of its own ``except`` block,
    which no longer stands inside its ``try``.
    """
    frames: list[FrameType] = []
    frame: FrameType | None = sys._getframe(2)
    while frame is not None:
        if frame.f_code.co_filename == file_name:
            frames.append(frame)
        frame = frame.f_back
    if not frames:
        return
    outermost, previous = frames[-1], sys.gettrace()
    raised_at: dict[FrameType, int] = {}

    def at_line(seen: FrameType, event: str, _argument: Any) -> Any:
        if event == "exception":
            raised_at[seen] = seen.f_lineno
        # An inlined comprehension cleans up in its own line while the error passes.
        if event == "line" and seen.f_lineno != raised_at.get(seen):
            raised_at.clear()
            sys.settrace(previous)
            raise make()
        if event == "return" and seen is outermost:
            sys.settrace(previous)
        return at_line

    for seen in frames:
        seen.f_trace = at_line
    sys.settrace(lambda *_: None)
