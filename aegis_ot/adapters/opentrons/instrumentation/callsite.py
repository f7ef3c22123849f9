"""Which line of the protocol caused an operation, and through which call.

The protocol's frames are found on the stack by their file name: Opentrons compiles a protocol
under its bare file name, so neither ``inspect`` nor ``linecache`` can help.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from types import FrameType
from typing import Any, NamedTuple

from .own_code import is_helper_file

# Functions that mix when they stand between the protocol and a core: the context's own, and
# the liquid-class transfers' (``pre_wet`` aspirates and dispenses in the source to wet the tip).
_MIXING = frozenset({"mix", "dynamic_mix", "pre_wet"})
_MEASURED = frozenset({"aspirate", "dispense"})
"""Methods that take the volume which is written, before older apiLevels make another of it."""
_API = os.sep + os.path.join("opentrons", "protocol_api", "")

_NEAREST = 8
"""So many of the protocol's functions, from the innermost, are met at each walk: a recursion may be
hundreds deep."""

_PROTOCOL, _HELPER, _CONTEXT, _INSIDE_API, _OTHER = range(5)


class CallSite(NamedTuple):
    """Where in the protocol an operation comes from.

    Attributes:
        lines: Lines of all protocol frames on the stack, innermost first.
        call: The Opentrons method that the protocol called.
        mixing: Whether a mixing function stands between protocol and core.
        volume: What ``aspirate`` or ``dispense`` was called with, if the stack was asked to look.
    """

    lines: tuple[int, ...]
    call: str
    mixing: bool
    volume: Any = None

    @property
    def line(self) -> int | None:
        """The innermost protocol line."""
        return self.lines[0] if self.lines else None


class ProtocolStack:
    """The frames of one protocol's functions on the call stack.

    A frame that a walk has met is held until a later walk, or the end, finds that its function
    has returned; Python keeps the last values of its local names that long.

    Args:
        file_name: ``co_filename`` of the protocol's code.

    Attributes:
        met: Gets the innermost of these frames at each walk; ``None`` while nobody asks for them.
        returned: Gets each such frame once its function has returned, innermost first.
        looks_for_volumes: Whether call sites tell the volume that was written.
    """

    def __init__(self, file_name: str) -> None:
        self.met: Callable[[FrameType], None] | None = None
        self.returned: Callable[[FrameType], None] | None = None
        self.looks_for_volumes = False
        self._kinds = {file_name: _PROTOCOL}
        self._running: list[FrameType] = []
        self._outermost: FrameType | None = None

    def call_site(self, skip: int = 1) -> CallSite:
        """Walk the stack from the caller outwards.

        Args:
            skip: Frames to leave out at the inner end.
        """
        frame: FrameType | None = sys._getframe(skip + 1)
        kinds = self._kinds
        lines: list[int] = []
        own: list[FrameType] = []
        within = 0  # how many of them the protocol's outermost frame called, itself included
        call, mixing, volume = "", False, None
        while frame is not None:
            code = frame.f_code
            kind = kinds.get(code.co_filename)
            if kind is None:
                kind = kinds[code.co_filename] = _kind_of(code.co_filename)
            if kind == _PROTOCOL:
                lines.append(frame.f_lineno)
                own.append(frame)
                within = len(own)
                if frame is self._outermost:
                    break  # what called it is known, and nothing of the protocol
            elif lines and code.co_name == "<module>":
                break  # the loader's call of ``run``: the protocol goes no further out
            elif kind == _HELPER:
                own.append(frame)
            elif kind != _OTHER and not lines:
                name = code.co_name
                if name in _MIXING:
                    mixing = True
                # Decorators stand in frames of their own; the methods are what users know.
                if kind == _CONTEXT and name[0] not in "_<":
                    call = name
                    if self.looks_for_volumes and volume is None and name in _MEASURED:
                        volume = frame.f_locals.get("volume")
            frame = frame.f_back
        if self.returned is not None and within:
            del own[within:]
            self._now_running(own)
            if self.met is not None:
                for frame in own[:_NEAREST]:
                    self.met(frame)
        return CallSite(tuple(lines), call, mixing, volume)

    @property
    def running(self) -> tuple[FrameType, ...]:
        """The protocol's functions that were on the stack at the last walk, innermost first."""
        return tuple(self._running)

    def close(self) -> None:
        """The run is over: tell of the frames that are left, and let go of them."""
        self._now_running([])
        self._outermost = None

    def _now_running(self, own: list[FrameType]) -> None:
        before = self._running
        if own == before:
            return
        self._running = own
        self._outermost = own[-1] if own else None
        if self.returned is not None:
            for frame in before:
                if frame not in own:
                    self.returned(frame)


def _kind_of(file_name: str) -> int:
    if _API in file_name:
        return _CONTEXT if file_name.endswith("_context.py") else _INSIDE_API
    return _HELPER if is_helper_file(file_name) else _OTHER
