"""Virtual time: a protocol's own sleeps pass at once in a rehearsal.

A robot waits while its protocol is rehearsed, and ``time.sleep`` cannot be interrupted. The
``time`` module is not touched, since a robot server uses it too: the rehearsed text gets an
``import`` of its own that hands out another one, whose clocks run ahead by what was slept.
"""

from __future__ import annotations

import builtins
import time
from types import ModuleType
from typing import Any

_YIELD_S = 0.001
"""Long enough to let the protocol's other threads run, s."""


def builtins_in_virtual_time() -> dict[str, Any]:
    """``__builtins__`` for a rehearsed protocol's namespace."""
    slept = 0.0

    def sleep(seconds: float, /) -> None:
        nonlocal slept
        time.sleep(min(seconds, _YIELD_S))  # refuses what the real one refuses
        slept += seconds

    virtual = ModuleType("time", time.__doc__)
    vars(virtual).update(vars(time), sleep=sleep)
    for name in ("time", "monotonic", "perf_counter"):
        clock = getattr(time, name)
        setattr(virtual, name, lambda clock=clock: clock() + slept)

    def imported(name: str, *args: Any, **kwargs: Any) -> Any:
        module = builtins.__import__(name, *args, **kwargs)
        return virtual if module is time else module

    return {**vars(builtins), "__import__": imported}
