"""Asks a sidecar again until it takes what it is sent, and knows for how long it did not."""

from __future__ import annotations

import time
from collections.abc import Callable

from ..errors import LinkError, SidecarRefused, SidecarUnreachable
from .sidecar_client import CameraSilent, SidecarBusy, SidecarClient

GLANCE_S = 0.25
"""How long one cheap look for a lost sidecar may take, s."""
_FIRST_TRY_S = 3.0
"""How long a first try may take before somebody is told that it is tried again, s."""
_SILENT_S = 1.0
"""Shorter trouble is not worth a word, s."""
_FIRST_RETRY_S = 0.1
_SLOWEST_RETRY_S = 1.0

OnTrouble = Callable[[LinkError, float], None]


class Retrying:
    """The only loop in which a request is sent again.

    Args:
        link: To the sidecar.
        rest: Sleeps in short slices and raises when the run is being stopped.
        interrupted: Whether a person wants something of the robot meanwhile.
        report_outage: Takes for how long the robot was not served, s, and what was said of it.

    Attributes:
        on_trouble: Takes, during retries, what the trouble is and for how long they go on, s.
    """

    def __init__(
        self,
        link: SidecarClient,
        rest: Callable[[float], None],
        interrupted: Callable[[], bool],
        report_outage: Callable[[float, str], None],
    ) -> None:
        self._link, self._rest = link, rest
        self._interrupted, self._report_outage = interrupted, report_outage
        self._lost: tuple[float, str] | None = None
        self.on_trouble: OnTrouble = lambda error, seconds_left: None

    def until(self, attempt: Callable[[float], None], timeout_s: float) -> None:
        """Attempt until it works.

        Args:
            attempt: Takes the moment of ``time.monotonic`` until which it may last, s.
            timeout_s: For how long in all.

        Raises:
            LinkError: The last trouble, or what the sidecar itself said.
        """
        began = time.monotonic()
        deadline = began + timeout_s
        limit = min(deadline, began + _FIRST_TRY_S)
        wait = _FIRST_RETRY_S
        answered: LinkError | None = None
        while True:
            asked = time.monotonic()
            try:
                attempt(limit)
                self.is_served()
                return
            except SidecarRefused:
                raise  # asking again changes nothing
            except LinkError as error:
                if not isinstance(error, SidecarUnreachable):
                    answered = error
                if not isinstance(error, (SidecarBusy, SidecarUnreachable)):
                    self.is_served()  # it is there, and says what else is wrong
                elif self._lost is None and not self._is_there(error):
                    self._lost = asked, str(error)
                if self._interrupted() or time.monotonic() + wait >= deadline:
                    # The last attempt is often cut short: what was answered before says more.
                    raise answered or error from None
                if time.monotonic() - began >= _SILENT_S:
                    self.on_trouble(answered or error, deadline - time.monotonic())
                limit = deadline
                self._rest(wait)
                wait = min(_SLOWEST_RETRY_S, wait * 2)

    def is_served(self) -> None:
        """The sidecar serves the robot again: the run's report says for how long it did not."""
        lost, self._lost = self._lost, None
        if lost is not None and (seconds := time.monotonic() - lost[0]) >= _SILENT_S:
            self._report_outage(seconds, lost[1])

    def camera_trouble(self, waited_s: float) -> CameraSilent | None:
        """Whether the sidecar that captured nothing in time is there, and what it says."""
        try:
            camera = self._link.health(GLANCE_S).get("camera")
        except LinkError:
            return None
        said = str(camera.get("detail", ""))[:400].rstrip(".") if isinstance(camera, dict) else ""
        return CameraSilent(
            f"The sidecar at {self._link.url} is there, but took no frame within {waited_s:g} s"
            f"{f' ({said})' if said else ''}. Look at the camera and at the sidecar's page."
        )

    def _is_there(self, error: LinkError) -> bool:
        """Whether a sidecar that has not answered yet does answer: then it waits for its camera."""
        if not isinstance(error, SidecarUnreachable):
            return False
        try:
            self._link.health(GLANCE_S)
        except LinkError:
            return False
        return True
