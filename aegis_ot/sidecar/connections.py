"""Who holds a connection to the sidecar: time limits, and room for those who showed the token.

uvicorn lets a connection that says nothing stay for ever, and counts it like a robot's. Here a
connection is a *stranger's* until the door has let a request of it in. Strangers have little time
and little room: where there are too many, the oldest of the address that has most of them goes, so
that neither silence nor a flood keeps a robot out.
"""

from __future__ import annotations

import asyncio
import math
from collections import Counter
from collections.abc import Iterable
from typing import Any

import h11
from starlette.types import Scope
from uvicorn.protocols.http.h11_impl import H11Protocol

from .journal import event

MOST_AT_ONCE = 400
"""Connections at once, and requests at once. Robots and pages hold one or two each."""
MOST_STRANGERS = 64
"""Of these, connections that have not shown the token."""
STRANGER_S = 15.0
"""How long a connection may stay without the token, s."""
REQUEST_S = 15.0
"""How long a request may take to arrive, from its first byte to its last, s."""
TELL_S = 60.0
_KEY = "connection"


class Connection(H11Protocol):
    """One connection, as uvicorn serves it, with an end to patience.

    Attributes:
        known: Whether a request of it was let in.
        made, used: When it began, and when it last brought something, on the event loop's clock, s.
    """

    _told = -math.inf  # when the log last heard of a crowd: a flood must not fill it

    def __init__(self, *given: Any, **named: Any) -> None:
        super().__init__(*given, **named)
        self.app_state = {**self.app_state, _KEY: self}
        self.known = False
        self.made = self.used = self.loop.time()
        self._limit: asyncio.TimerHandle | None = None

    @property
    def address(self) -> str:
        """Where it comes from."""
        return self.client[0] if self.client else "unknown"

    @property
    def idle(self) -> bool:
        """Whether no request of it is being answered, or arriving."""
        answered = self.cycle is None or self.cycle.response_complete
        return answered and not self._arriving

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Of :class:`asyncio.Protocol`."""
        super().connection_made(transport)
        self._limit = self.loop.call_later(STRANGER_S, self.drop)
        leaving = who_goes(self.connections, self)
        if leaving is not None:
            if self.made - Connection._told >= TELL_S:
                Connection._told = self.made
                event("crowded", address=leaving.address, connections=len(self.connections))
            leaving.drop()

    def connection_lost(self, exc: Exception | None) -> None:
        """Of :class:`asyncio.Protocol`."""
        self._set_limit(None)
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Of :class:`asyncio.Protocol`."""
        self.used = self.loop.time()
        super().data_received(data)
        self._look_at_limit()

    def on_response_complete(self) -> None:
        """Of uvicorn: a further request may be in already."""
        super().on_response_complete()
        self._look_at_limit()

    def let_in(self) -> None:
        """A request of it showed the token."""
        if not self.known:
            self.known = True
            self._set_limit(None)
            self._look_at_limit()

    def drop(self) -> None:
        """End it, whatever it is at."""
        self._set_limit(None)
        self.connections.discard(self)
        if self.transport is not None:
            self.transport.abort()

    @property
    def _arriving(self) -> bool:
        state = self.conn.their_state
        return state is h11.SEND_BODY or (state is h11.IDLE and bool(self.conn.trailing_data[0]))

    def _look_at_limit(self) -> None:
        if not self.known:
            return  # its limit stands, whatever it brings
        if not self._arriving:
            self._set_limit(None)
        elif self._limit is None:
            self._set_limit(self.loop.call_later(REQUEST_S, self.drop))

    def _set_limit(self, limit: asyncio.TimerHandle | None) -> None:
        if self._limit is not None:
            self._limit.cancel()
        self._limit = limit


def let_in(scope: Scope) -> None:
    """The door let this request in: its connection is no stranger's any more."""
    connection = scope.get("state", {}).get(_KEY)
    if connection is not None:
        connection.let_in()


def who_goes(connections: Iterable[Any], newcomer: Any) -> Any:
    """The connection that has to make room for a newcomer; ``None`` if there is room.

    Of too many strangers, the oldest of the address that has most; of too many in all, the one
    that has been idle for longest: who is there opens another.
    """
    others = [one for one in connections if one is not newcomer]
    strangers = [one for one in others if not one.known]
    if len(strangers) >= MOST_STRANGERS:
        of = Counter(one.address for one in strangers)
        return max(strangers, key=lambda one: (of[one.address], -one.made))
    if len(others) + 1 >= MOST_AT_ONCE:
        idle = [one for one in others if one.idle]
        return min(idle, key=lambda one: (one.known, one.used), default=None)
    return None
