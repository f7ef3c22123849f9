"""What Opentrons says of the run at this moment: stopping, paused, resumable.

All of it is private to Opentrons and differs between engine and legacy core, so every question
has an answer when the private part is not there: not stopping, not paused. Read in opentrons
8.8.2, 9.0.0 and 10.1.0.
"""

from __future__ import annotations

import sys
from typing import Any

_ENDING = frozenset({"stop-requested", "finishing", "stopped", "failed", "succeeded"})
PAUSED = frozenset(
    {
        "paused",
        "blocked-by-open-door",
        "awaiting-recovery",
        "awaiting-recovery-paused",
        "awaiting-recovery-blocked-by-open-door",
    }
)
"""Statuses of a run in which a person is waited for."""


class RunState:
    """Asks one protocol context; about 2 µs a question."""

    def __init__(self, protocol: Any) -> None:
        core = getattr(protocol, "_core", None)
        self._client = getattr(core, "_engine_client", None)
        self._hardware = None
        if self._client is None:
            try:
                self._hardware = core.get_hardware()  # type: ignore[union-attr]
            except Exception:  # whatever a core of another version may raise
                self._hardware = None

    @property
    def stopping(self) -> bool:
        """Whether the run is being stopped or has ended."""
        return self._status() in _ENDING or self._execution() == "CANCELLED"

    @property
    def paused(self) -> bool:
        """Whether the operator, the protocol or the door has paused the run."""
        return self._status() in PAUSED or self._execution() == "PAUSED"

    def _status(self) -> str:
        if self._client is None:
            return ""
        try:
            status = self._client.state.commands.get_status()
            return str(getattr(status, "value", status))
        except Exception:  # a private interface: it may change, the robot must go on
            return ""

    def _execution(self) -> str:
        # The legacy core runs beside the engine; what it sees of a stop is that the hardware's
        # execution manager is cancelled.
        if self._hardware is None:
            return ""
        try:
            return str(self._hardware._execution_manager._state.name)
        except Exception:
            return ""


def can_be_resumed() -> bool:
    """Whether somebody could resume this process's run after ``protocol.pause()``.

    Under ``opentrons_execute`` and in a notebook nobody can: a pause there hangs for ever. In
    both, ``opentrons.execute`` owns the hardware of this process; on a robot server it owns
    none.
    """
    for name in ("opentrons.execute", "__main__"):
        module = sys.modules.get(name)
        if getattr(module, "_THREAD_MANAGED_HW", None) is not None:
            return False
    return True
