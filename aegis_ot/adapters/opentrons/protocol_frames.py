"""The protocol's own frames: an error raised from one of its lines, an action at its return."""

from __future__ import annotations

import dis
import sys
from collections.abc import Callable
from types import FrameType
from typing import Any

from ...errors import AegisError


def make_final(error: AegisError, protocol: Any, file_name: str, frame: FrameType) -> None:
    """See to it that ``error`` ends the run, even where the protocol catches it.

    Nothing moves after it, and a ``run`` that returns all the same raises it again.
    """
    from .run_refusal import refuse_everything

    refuse_everything(protocol, error, file_name)
    run = outermost(frame, file_name)

    def raise_again(by_itself: bool) -> None:
        if by_itself:
            raise type(error)(str(error))

    if run is not None:
        at_return_of(run, raise_again)


def raise_in_protocol(error: AegisError, file_name: str, line: int) -> None:
    """Raise ``error`` from a line of the protocol, which Opentrons looks for and shows.

    Does nothing where the error comes through the protocol anyway: its own line says more.
    """
    trace = error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == file_name:
            return
        trace = trace.tb_next
    found = getattr(error, "line", None) or line
    code = compile("\n" * (found - 1) + "raise error", file_name, "exec")
    exec(code, {"error": error})


def line_of(run: Any) -> int:
    return int(getattr(getattr(run, "__code__", None), "co_firstlineno", 1))


def outermost(frame: FrameType, file_name: str) -> FrameType | None:
    """The protocol's ``run``: the outermost function of its file on the stack."""
    found: FrameType | None = None
    seen: FrameType | None = frame
    while seen is not None:
        if seen.f_code.co_filename == file_name and seen.f_code.co_name != "<module>":
            found = seen
        seen = seen.f_back
    return found


def at_return_of(frame: FrameType, action: Callable[[bool], None]) -> Callable[[], None]:
    """Call ``action`` when ``frame`` returns, with whether it returned by itself.

    An exception raised by ``action`` becomes the exception of that function. A protocol may set a
    profiler or a tracer of its own, and take it off again: so there is a hook in either place.

    Returns:
        Takes the hook off again; ``action`` is not called then.
    """
    return _ReturnHook(frame, action).take_off


class _ReturnHook:
    def __init__(self, frame: FrameType, action: Callable[[bool], None]) -> None:
        self.profiler = _serving(sys.getprofile(), "profiler")
        self.tracer = _serving(sys.gettrace(), "tracer")
        self._seen: tuple[FrameType, Callable[[bool], None]] | None = frame, action
        sys.setprofile(self._profiled)
        if self.tracer is None:
            frame.f_trace, frame.f_trace_lines = self._traced_here, False
            sys.settrace(self._traced)

    @property
    def is_over(self) -> bool:
        return self._seen is None

    def take_off(self) -> None:
        """Let go of the frame, and leave what stood there before: no hook that has ended."""
        if self._seen is None:
            return
        frame, self._seen = self._seen[0], None
        if frame.f_trace == self._traced_here:
            frame.f_trace = None
        # Where another one stands over this one, it only passes on from now.
        profiling, tracing = sys.getprofile(), sys.gettrace()
        if (profiler := _serving(profiling, "profiler")) is not profiling:
            if profiler is None or callable(profiler):
                sys.setprofile(profiler)
            else:
                profiler.enable()  # cProfile's
        if (tracer := _serving(tracing, "tracer")) is not tracing:
            sys.settrace(tracer)

    def _end(self, frame: FrameType) -> None:
        if self._seen is None or self._seen[0] is not frame:
            return
        action = self._seen[1]
        self.take_off()
        # An exception is told as a return too; the instruction tells them apart.
        opcode = dis.opname[frame.f_code.co_code[frame.f_lasti]]
        action(opcode.startswith(("RETURN_", "INSTRUMENTED_RETURN")))

    def _profiled(self, seen: FrameType, event: str, argument: Any) -> None:
        if callable(self.profiler):
            self.profiler(seen, event, argument)
        if event == "return":
            self._end(seen)

    def _traced(self, _seen: FrameType, _event: str, _argument: Any) -> None:
        """Keeps tracing on; of interest is the one frame alone."""

    def _traced_here(self, seen: FrameType, event: str, _argument: Any) -> Any:
        if event == "return":
            self._end(seen)
        return self._traced_here


def _serving(hook: Any, before: str) -> Any:
    """A profiler or tracer, or where it is one of ours that has ended, what stood there before."""
    while isinstance(own := getattr(hook, "__self__", None), _ReturnHook) and own.is_over:
        hook = getattr(own, before)
    return hook
