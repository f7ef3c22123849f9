"""A legacy protocol (apiLevel 2.13 and older) that an engine follows: how to pause it.

The engine hears of a legacy protocol's commands through messages, and accepts one at a time.
The guard acts inside a command that was announced already, where ``protocol.pause`` and
``protocol.comment`` would announce another: the engine then ends the run with an
AssertionError. So the pause goes past the messages. All of it is private to Opentrons; read in
opentrons 8.8.2 and 9.0.0.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import wait
from typing import Any

from .runstate import RunState

_LOOK_S = 0.1


class LegacyRun:
    """Pauses one run.

    Args:
        plugin: Opentrons' ``LegacyContextPlugin`` of that run.
    """

    def __init__(self, plugin: Any) -> None:
        self._plugin = plugin

    @classmethod
    def of(cls, protocol: Any) -> LegacyRun | None:
        """The legacy run of this context; ``None`` for an engine core, or without an engine."""
        subscriptions = getattr(getattr(protocol, "broker", None), "subscriptions", None) or {}
        for handler in subscriptions.get("command", ()):
            plugin = getattr(handler, "__self__", None)
            if hasattr(plugin, "_legacy_command_mapper") and hasattr(plugin, "_engine_loop"):
                return cls(plugin)
        return None

    def pause(self, protocol: Any, rest: Callable[[float], None]) -> None:
        """Pause, and come back when the run is resumed.

        Raises:
            Exception: Whatever ``rest`` raises when the run is being stopped.
        """
        from opentrons.protocol_engine.actions import PauseAction, PauseSource

        protocol._core.pause(msg=None)
        action = PauseAction(source=PauseSource.PROTOCOL)
        sent = asyncio.run_coroutine_threadsafe(
            self._plugin._dispatch_action_list([action]), self._plugin._engine_loop
        )
        while not wait([sent], _LOOK_S).done:
            rest(0.0)
        sent.result()
        state = RunState(protocol)
        rest(_LOOK_S)
        while state.paused:
            rest(_LOOK_S)
