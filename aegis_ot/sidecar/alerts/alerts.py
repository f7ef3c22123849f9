"""Keeps trouble with the runs that it befell, and tells people of it, once."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Sequence

from pydantic import SecretStr

from ...errors import StoreError
from ..store import Store
from .incidents import Incidents
from .messages import compose
from .notices import Notice
from .sending import Notifier


class Alerts:
    """Of all runs. Safe to use from threads.

    Args:
        urls: Of the services that people are told through, as Apprise takes them.
        store: Where incidents are kept.
        address: Where the page is; for links in messages.
        changed: Called when there is something new to show.
        told: Called with each notice that people are told of.

    Raises:
        ConfigurationError: A URL is none that Apprise understands.
    """

    def __init__(
        self,
        urls: Sequence[SecretStr],
        store: Store,
        address: Callable[[], str],
        changed: Callable[[], None],
        told: Callable[[Notice], None],
    ) -> None:
        self._changed, self._told = changed, told
        self.incidents = Incidents(store)
        self.notifier = Notifier(
            urls,
            lambda notices: compose(store, notices, address()),
            lambda notice, why: self.undelivered(notice.run, "notification", why),
        )

    def tell(self, notice: Notice) -> None:
        """Tell people of an incident, once; trouble is kept with its run until it is over."""
        lasts = notice.trajectory is None
        if lasts and not self.incidents.begin(notice.run, notice.kind, notice.seen):
            return
        self.notifier.send(notice)
        self._changed()
        self._told(notice)

    def over(self, run: str, kind: str) -> None:
        """Trouble of this kind is over, if there was any."""
        if self.incidents.end(run, kind):
            self._changed()

    def note(self, run: str, kind: str, seen: str) -> None:
        """Keep trouble that is over by now; nobody is told of it."""
        self.incidents.note(run, kind, seen)
        self._changed()

    def undelivered(self, run: str, kind: str, why: str) -> None:
        """Keep that people, or another system, could not be told."""
        with contextlib.suppress(StoreError):
            self.incidents.note(run, kind, why)
        self._changed()
