"""Tells people away from the bench, through Apprise. A failure to tell never stops a run."""

from __future__ import annotations

import logging
import queue
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import SecretStr

from ...errors import ConfigurationError
from ..background import BackgroundWorker
from ..journal import event
from .notices import Notice

log = logging.getLogger(__name__)

_QUEUE = 100
RETRIES_S = (2.0, 15.0, 60.0)
"""How long to wait before each further try, s."""


@dataclass(frozen=True)
class Notification:
    """What is sent.

    Attributes:
        title, text: Plain text.
        pictures: JPEG files to attach, where the service takes any.
    """

    title: str
    text: str
    pictures: Sequence[Path] = ()


class Notifier(BackgroundWorker[Notice]):
    """Sends messages in a thread of its own, one after the other.

    Args:
        urls: Apprise URLs; without any, messages go nowhere.
        compose: Makes the message of some notices of one run and kind; called in that thread.
        failed: Told of notices that could not be delivered, and why; likewise.
        retries_s: See :data:`RETRIES_S`.

    Raises:
        ConfigurationError: A URL is none that Apprise understands. It is not shown: it may hold
            a password.
    """

    def __init__(
        self,
        urls: Sequence[SecretStr] = (),
        compose: Callable[[Sequence[Notice]], Notification] | None = None,
        failed: Callable[[Notice, str], None] | None = None,
        retries_s: Sequence[float] = RETRIES_S,
    ) -> None:
        self._services = _services([url.get_secret_value() for url in urls])
        self._compose = compose or _plain
        self._failed = failed or (lambda notice, why: None)
        self._retries_s = tuple(retries_s)
        self.trouble = ""
        """What went wrong with the last message; empty if it was delivered."""
        super().__init__("notifier", _QUEUE, bool(self._services))

    def send(self, notice: Notice) -> None:
        """Queue a notice. Never blocks and never raises; a full queue drops it, logged."""
        if self._thread is None or self._closing.is_set():
            return
        try:
            self._tasks.put_nowait(notice)
        except queue.Full:
            self.trouble = "Too many notifications at once; some were dropped."
            log.warning("Too many notifications at once; dropped: %s", notice.what)

    def close(self, timeout: float = 2.0) -> None:
        """Send what is queued, for at most ``timeout`` seconds, without further retries."""
        super().close(timeout)

    def _do(self, task: Notice) -> None:
        self._deliver(self._take_alike(task))

    def _take_alike(self, first: Notice) -> list[Notice]:
        """What else waits of the same run and kind goes into the same message."""
        others: list[Notice | None] = []
        while True:
            try:
                others.append(self._tasks.get_nowait())
            except queue.Empty:
                break
        alike = [n for n in others if n is not None and (n.run, n.kind) == (first.run, first.kind)]
        for other in others:
            if other is not None and other not in alike:
                self._tasks.put_nowait(other)
        if None in others:
            self._tasks.put_nowait(None)
        return [first, *alike]

    def _deliver(self, notices: Sequence[Notice]) -> None:
        message = self._compose(notices)
        waiting = list(enumerate(self._services, 1))
        for pause in (0.0, *self._retries_s):
            if pause and self._closing.wait(pause):
                break
            waiting = [(n, service) for n, service in waiting if not _notify(service, message)]
            if not waiting:
                self.trouble = ""
                event("notification", run=notices[0].run, title=message.title)
                return
        numbers = ", ".join(str(number) for number, _ in waiting)
        self.trouble = f"Notification URL number {numbers} could not be reached: {message.title}"
        log.warning("A notification could not be delivered: %s", self.trouble)
        for notice in notices:
            self._failed(notice, self.trouble)


def _services(urls: Sequence[str]) -> list[Any]:
    if not urls:
        return []
    import apprise  # takes half a second

    logging.getLogger("apprise").setLevel(logging.CRITICAL)  # it would log passwords
    services = []
    for number, url in enumerate(urls, 1):
        service = apprise.Apprise()
        if not service.add(url):
            raise ConfigurationError(
                f"Notification URL number {number} is not one that Apprise understands. "
                "Apprise's documentation says how each service's is written."
            )
        services.append(service)
    return services


def _notify(service: Any, message: Notification) -> bool:
    pictures = [str(path) for path in message.pictures if path.is_file()]
    try:
        return bool(service.notify(title=message.title, body=message.text, attach=pictures or None))
    except Exception as error:
        log.warning("A notification failed: %s", type(error).__name__)
        return False


def _plain(notices: Sequence[Notice]) -> Notification:
    first = notices[0]
    return Notification(f"aegis-ot: {first.what}", "\n".join(n.seen for n in notices))
