"""Which line of the protocol caused an operation, and through which call.

The protocol's frames are found on the stack by their file name: Opentrons compiles a protocol
under its bare file name, so neither ``inspect`` nor ``linecache`` can help.
"""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from types import FrameType

# Functions that mix when they stand between the protocol and a core: the context's own, and
# the liquid-class transfers' (``pre_wet`` aspirates and dispenses in the source to wet the tip).
_MIXING = frozenset({"mix", "dynamic_mix", "pre_wet"})
_API = os.sep + os.path.join("opentrons", "protocol_api", "")


@dataclass(frozen=True)
class CallSite:
    """Where in the protocol an operation comes from.

    Attributes:
        lines: Lines of all protocol frames on the stack, innermost first.
        call: The Opentrons method that the protocol called.
        mixing: Whether a mixing function stands between protocol and core.
    """

    lines: tuple[int, ...]
    call: str
    mixing: bool

    @property
    def line(self) -> int | None:
        """The innermost protocol line."""
        return self.lines[0] if self.lines else None


def find_call_site(file_name: str, skip: int = 1) -> CallSite:
    """Walk the stack from the caller outwards.

    Args:
        file_name: ``co_filename`` of the protocol's code.
        skip: Frames to leave out at the inner end.
    """
    frame: FrameType | None = sys._getframe(skip + 1)
    lines: list[int] = []
    call, mixing = "", False
    while frame is not None:
        code = frame.f_code
        if code.co_filename == file_name:
            lines.append(frame.f_lineno)
        elif lines:
            if code.co_name == "<module>":
                break  # the loader's call of ``run``: the protocol goes no further out
        elif _API in code.co_filename:
            name = code.co_name
            if name in _MIXING:
                mixing = True
            # Decorators stand in frames of their own; the methods are what users know.
            if code.co_filename.endswith("_context.py") and name[0] not in "_<":
                call = name
        frame = frame.f_back
    return CallSite(tuple(lines), call, mixing)
