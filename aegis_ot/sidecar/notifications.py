"""Tells people away from the bench, through Apprise. A failure to tell never stops a run."""

from __future__ import annotations

import logging
import queue
import threading
from collections.abc import Sequence

from pydantic import SecretStr

log = logging.getLogger(__name__)

_QUEUE = 100


class Notifier:
    """Sends messages in a thread of its own, one after the other.

    Args:
        urls: Apprise URLs; without any, messages go nowhere.
    """

    def __init__(self, urls: Sequence[SecretStr] = ()) -> None:
        self._urls = [url.get_secret_value() for url in urls]
        self._messages: queue.Queue[tuple[str, str] | None] = queue.Queue(_QUEUE)
        self._thread: threading.Thread | None = None
        if self._urls:
            self._thread = threading.Thread(target=self._work, name="notifier", daemon=True)
            self._thread.start()

    def send(self, title: str, text: str) -> None:
        """Queue a message. Never blocks and never raises; a full queue drops it, logged."""
        if self._thread is None:
            return
        try:
            self._messages.put_nowait((title, text))
        except queue.Full:
            log.warning("Too many notifications at once; dropped: %s", title)

    def close(self, timeout: float = 2.0) -> None:
        """Send what is queued, for at most ``timeout`` seconds."""
        thread, self._thread = self._thread, None
        if thread is not None:
            try:
                self._messages.put(None, timeout=timeout)
            except queue.Full:
                log.warning("Notifications were still waiting when the sidecar stopped")
                return
            thread.join(timeout)

    def _work(self) -> None:
        import apprise  # takes half a second

        # Failed deliveries are told here in one line; the URLs may hold passwords.
        sender = apprise.Apprise()
        for number, url in enumerate(self._urls, 1):
            if not sender.add(url):
                log.error("Notification URL number %d is not one that Apprise understands", number)
        while (message := self._messages.get()) is not None:
            title, text = message
            try:
                if sender and not sender.notify(title=title, body=text):
                    log.warning("A notification could not be delivered: %s", title)
            except Exception:
                log.exception("A notification failed: %s", title)
