"""Hears each return of the protocol's own functions, at next to no cost for all other code.

Opentrons makes hundreds of calls for each command, so a profile function, which is told of all
of them, costs up to the simulation's own time. From Python 3.12 on, events can be asked for in
single code objects; before that, the functions run rewritten code for the time of the run. A
debugger, coverage tool or profiler keeps what it has installed.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from threading import get_ident
from types import CodeType, FrameType, FunctionType
from typing import Any

from .own_functions import codes_of
from .rewritten import Look, rewritten

_TOOL_IDS = (4, 3)
"""Those that Python keeps for no kind of tool."""


def heard_returns(
    functions: Sequence[FunctionType], sources: Callable[[str], str], look: Look
) -> AbstractContextManager[None]:
    """Call ``look`` with the frame of each of these functions as it returns, in this thread.

    Args:
        functions: Those to listen to, with all functions within them.
        sources: The text of a file, by ``co_filename``.
        look: Must not raise.
    """
    if sys.version_info >= (3, 12):
        tool = _free_tool()
        if tool is not None:
            codes = [code for function in functions for code in codes_of(function.__code__)]
            return _monitored(tool, codes, look)
    elif sys.gettrace() is None:  # a debugger would step through what was written in
        return rewritten(functions, sources, look)
    return _profiled({function.__code__.co_filename for function in functions}, look)


@contextmanager
def _profiled(files: set[str], look: Look) -> Iterator[None]:
    """The dear way, for where the others are taken."""
    if sys.getprofile() is not None:  # a profiler is at work: leave it in peace
        yield
        return

    def hook(frame: FrameType, event: str, _argument: Any) -> None:
        if event == "return" and frame.f_code.co_filename in files:
            look(frame)

    sys.setprofile(hook)
    try:
        yield
    finally:
        if sys.getprofile() is hook:
            sys.setprofile(None)


if sys.version_info >= (3, 12):

    def _free_tool() -> int | None:
        """Take one of the identifiers that no kind of tool has a right to."""
        for tool in _TOOL_IDS:
            try:
                sys.monitoring.use_tool_id(tool, "aegis_ot")
            except ValueError:
                continue
            return tool
        return None

    @contextmanager
    def _monitored(tool: int, codes: Sequence[CodeType], look: Look) -> Iterator[None]:
        monitoring, thread = sys.monitoring, get_ident()

        def returned(_code: CodeType, _offset: int, _value: object) -> None:
            if get_ident() == thread:
                look(sys._getframe(1))

        events = (monitoring.events.PY_RETURN, monitoring.events.PY_YIELD)
        try:
            for event in events:
                monitoring.register_callback(tool, event, returned)
            for code in codes:
                monitoring.set_local_events(tool, code, events[0] | events[1])
            yield
        finally:
            for code in codes:
                monitoring.set_local_events(tool, code, 0)
            for event in events:
                monitoring.register_callback(tool, event, None)
            monitoring.free_tool_id(tool)
