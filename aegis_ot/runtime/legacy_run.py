"""A legacy protocol (apiLevel 2.13 and older) that an engine follows: how the guard gets a word in.

The engine hears of a legacy protocol's commands through messages, and accepts one at a time. The
guard acts inside a command that was announced already, where ``protocol.pause`` and
``protocol.comment`` would announce another: the engine then ends the run with an AssertionError.
So the announcement of a command in which the guard may act is kept back until the guard is done;
what the guard says comes before it, as on an engine core. Private to Opentrons; read in opentrons
8.1.0, 8.8.2 and 9.0.0.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from ..adapters.opentrons.run_state import RunState

_LOOK_S = 0.1
_KEPT_BACK = frozenset(
    f"command.{name}"
    for name in (
        "PICK_UP_TIP", "DROP_TIP", "ASPIRATE", "DISPENSE", "BLOW_OUT", "TOUCH_TIP", "MOVE_TO",
        "PAUSE",
    )
)  # fmt: skip
"""Commands whose operation is told to the guard after they were announced."""

Message = Mapping[str, Any]
Handler = Callable[[Message], None]


class LegacyRun:
    """Stands between one legacy context and the engine that follows it.

    Args:
        handlers: Subscribers of the context's commands.
        handler: The engine's among them.
    """

    def __init__(self, handlers: list[Handler], handler: Handler) -> None:
        self._handlers = handlers
        self._handler = handler
        self._kept: Message | None = None
        self._speaking = False

    @classmethod
    def of(cls, protocol: Any) -> LegacyRun | None:
        """The legacy run of this context; ``None`` for an engine core, or without an engine."""
        subscriptions = getattr(getattr(protocol, "broker", None), "subscriptions", None) or {}
        handlers = subscriptions.get("command", [])
        for handler in handlers:
            if hasattr(getattr(handler, "__self__", None), "_legacy_command_mapper"):
                return cls(handlers, handler)
        return None

    def begin(self) -> None:
        """Keep announcements back from now on."""
        self._handlers[self._handlers.index(self._handler)] = self._hear

    def end(self) -> None:
        """Leave the context as it was. Idempotent."""
        self.announce()
        if self._hear in self._handlers:
            self._handlers[self._handlers.index(self._hear)] = self._handler

    def announce(self) -> None:
        """The guard is done: the command that was kept back begins."""
        kept, self._kept = self._kept, None
        if kept is not None:
            self._handler(kept)

    @contextmanager
    def aside(self) -> Iterator[None]:
        """Commands that the guard does itself come before the one that is kept back."""
        kept, self._kept = self._kept, None
        try:
            yield
        finally:
            self.announce()
            self._kept = kept

    @contextmanager
    def speaking(self) -> Iterator[None]:
        """What is announced now are the guard's own words."""
        self._speaking = True
        try:
            yield
        finally:
            self._speaking = False

    def wait_for_play(self, protocol: Any, rest: Callable[[float], None]) -> None:
        """A legacy context goes on after its pause until something moves. Wait here instead.

        Raises:
            Exception: Whatever ``rest`` raises when the run is being stopped.
        """
        state = RunState(protocol)
        rest(_LOOK_S)
        while state.paused:
            rest(_LOOK_S)

    def _hear(self, message: Message) -> None:
        if self._speaking:
            self._handler(message)
            return
        self.announce()
        if message["$"] == "before" and message["name"] in _KEPT_BACK:
            self._kept = message
        else:
            self._handler(message)
