"""The protocol's own frames: an error raised from one of its lines, an action at its return."""

from __future__ import annotations

import dis
import sys
from collections.abc import Callable
from types import FrameType
from typing import Any

from .errors import AegisError


def make_final(error: AegisError, protocol: Any, file_name: str, frame: FrameType) -> None:
    """See to it that ``error`` ends the run, even where the protocol catches it.

    Nothing moves after it, and a ``run`` that returns all the same raises it again.
    """
    from .runtime.refusal import refuse_everything

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


def at_return_of(frame: FrameType, action: Callable[[bool], None]) -> None:
    """Call ``action`` when ``frame`` returns, with whether it returned by itself.

    An exception raised by ``action`` becomes the exception of that function. A protocol may set a
    profiler or a tracer of its own, and take it off again: so there is a hook in either place.
    """
    profiler: Any = sys.getprofile()
    tracer: Any = sys.gettrace()
    over = False

    def at_end(seen: FrameType) -> None:
        nonlocal over
        if over:
            return
        over = True
        if sys.getprofile() is profiled:
            sys.setprofile(profiler)
        if sys.gettrace() is traced:
            sys.settrace(tracer)
        # An exception is told as a return too; the instruction tells them apart.
        opcode = dis.opname[seen.f_code.co_code[seen.f_lasti]]
        action(opcode.startswith(("RETURN_", "INSTRUMENTED_RETURN")))

    def profiled(seen: FrameType, event: str, argument: Any) -> None:
        if callable(profiler):
            profiler(seen, event, argument)
        if seen is frame and event == "return":
            at_end(seen)

    def traced(_seen: FrameType, _event: str, _argument: Any) -> None:
        """Keeps tracing on; of interest is the one frame alone."""

    def traced_here(seen: FrameType, event: str, _argument: Any) -> Any:
        if event == "return":
            at_end(seen)
        return traced_here

    sys.setprofile(profiled)
    if tracer is None:
        frame.f_trace, frame.f_trace_lines = traced_here, False
        sys.settrace(traced)
