"""Wakes whoever waits for news: threads and event loops alike, without polling."""

from __future__ import annotations

import asyncio
import concurrent.futures
import threading
import time
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")

Ticket = concurrent.futures.Future[None]


class Bell:
    """Rung at every change. Counts the rings, so that a page can ask for what it has not seen.

    The count starts at the current time in milliseconds: after a restart no old count returns.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._tickets: set[Ticket] = set()
        self._rings = int(time.time() * 1000)

    @property
    def rings(self) -> int:
        """How often it was rung, plus a start value."""
        return self._rings

    def ring(self) -> None:
        """Wake everyone who waits now."""
        with self._lock:
            self._rings += 1
            tickets, self._tickets = self._tickets, set()
        for ticket in tickets:
            if ticket.set_running_or_notify_cancel():
                ticket.set_result(None)

    def ticket(self) -> Ticket:
        """A future that completes at the next ring. Take it before looking, then wait."""
        ticket: Ticket = concurrent.futures.Future()
        with self._lock:
            self._tickets.add(ticket)
        return ticket

    def drop(self, ticket: Ticket) -> None:
        """Give a ticket back that is no longer waited on."""
        with self._lock:
            self._tickets.discard(ticket)

    async def until(self, look: Callable[[], T | None], seconds: float) -> T | None:
        """What ``look`` gives as soon as it is not ``None``, or ``None`` after ``seconds``.

        ``look`` is called at once, after every ring, and once at the end.
        """
        deadline = time.monotonic() + seconds
        while True:
            ticket = self.ticket()
            try:
                found = look()
                left = deadline - time.monotonic()
                if found is not None or left <= 0:
                    return found
                await asyncio.wait([asyncio.wrap_future(ticket)], timeout=left)
            finally:
                self.drop(ticket)
