"""Brings keyframes to the sidecar, each counted once, whatever happens to the link."""

from __future__ import annotations

import itertools
import math
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from ..errors import LinkError, SidecarRefused, SidecarUnreachable
from ..http_client import SLICE_S
from ..vocabulary import Keyframe, Verdict
from .outbox import REQUEST_S, Outbox
from .retrying import GLANCE_S, Retrying
from .sidecar_client import Order, RunUnknown, SequenceGap, SidecarClient

_FIRST_REST_S = 1.0
_LONGEST_REST_S = 30.0
_CATCH_UP_S = 1.0
"""How long one missed keyframe may take when a lost sidecar is back, s: its camera may be dead."""
_POLL_S = 0.15
_MOST_MENDS = 3


class KeyframeSender:
    """Sends in order, resends what was not acknowledged, fills gaps, registers anew.

    Args:
        link: To the sidecar.
        run: Identifier of the run.
        about: Body of the registration.
        rest: Sleeps in short slices and raises when the run is being stopped.

    Attributes:
        run: What the sidecar calls the run; another name where another start has the one it
            came with.
        retrying: Sends what was not taken once more.
        away: Whether the sidecar is given up for now; then only cheap looks are taken.
        stale: Trajectories of which a keyframe was, or will be, sent too late.
        forgotten: Those of them that were sent in time, and that the sidecar lost.
        acknowledged: Keyframes that the sidecar has.
    """

    def __init__(
        self, link: SidecarClient, run: str, about: Mapping[str, Any], rest: Callable[[float], None]
    ) -> None:
        self._link = link
        self.run = run
        self._about = about
        self.retrying = Retrying(link, rest, lambda: self.ordered, self._report_outage)
        self._sent: list[Keyframe] = []
        self._pending: deque[Keyframe] = deque()
        self._outbox = Outbox(link, run, self._register)
        self._obeyed: Order | None = None
        self._holds = itertools.count()
        self._unheard = False  # a message was not taken; the next keyframe shows who is there
        self._next_look = 0.0
        self._pause_s = _FIRST_REST_S
        self._registered = False
        self.away = False
        self.stale: set[int] = set()
        self.forgotten: set[int] = set()

    @property
    def acknowledged(self) -> int:
        """How many keyframes the sidecar has acknowledged."""
        return len(self._sent)

    def offer(self, keyframe: Keyframe) -> None:
        """Queue a keyframe; :meth:`deliver` sends it."""
        self._pending.append(keyframe)

    def deliver(self, timeout_s: float) -> None:
        """Send all that is queued while the robot stands still.

        Raises:
            LinkError: The last trouble, after retries for ``timeout_s``; the rest stays queued.
        """
        try:
            self.retrying.until(self._send_all, timeout_s)
        except SidecarUnreachable as error:
            raise self.retrying.camera_trouble(timeout_s) or error from None

    def move_on(self) -> None:
        """The robot moves on without acknowledgement: what is queued is late now."""
        self._pending = deque(self._late(keyframe) for keyframe in self._pending)

    def give_up(self) -> None:
        """Treat the sidecar as lost until a cheap look finds it again."""
        self.away = True
        self._pause_s = _FIRST_REST_S
        self._next_look = time.monotonic() + self._pause_s
        self.move_on()

    def look(self, timeout_s: float) -> bool:
        """If it is time, see whether a lost sidecar is back, and send what it missed.

        Takes 0.25 s at most while it is away, 1.25 s while it is there and its camera is dead,
        and nothing between looks.

        Returns:
            Whether the sidecar is there again.
        """
        if not self.away or time.monotonic() < self._next_look:
            return not self.away
        try:
            self._link.health(GLANCE_S)
            self._send_all(time.monotonic() + timeout_s, _CATCH_UP_S)
            self.retrying.is_served()
            self._outbox.flush(time.monotonic() + REQUEST_S)
        except LinkError:
            self._pause_s = min(_LONGEST_REST_S, self._pause_s * 2)
            self._next_look = time.monotonic() + self._pause_s
            return False
        self.away = False
        return True

    def register(self, timeout_s: float) -> None:
        """Say which run this is."""
        self.retrying.until(self._register, timeout_s)

    def verdict(self, number: int) -> Verdict | None:
        """Ask once, for 0.15 s at most, for a verdict."""
        try:
            return self._link.verdict(self.run, number, _POLL_S, REQUEST_S)
        except RunUnknown:
            self._register(time.monotonic() + REQUEST_S)
            self._queue_again(0)
            return None

    def abandon(self, number: int, reason: str) -> None:
        """Tell, now or when the sidecar is back, that a trajectory is given up."""
        self._outbox.abandon(number, reason)
        self._tell()

    def action(self, number: int, within_s: float) -> str | None:
        """Ask once what a person told the robot that is paused at a trajectory so long, s."""
        return self._link.action(self.run, number, within_s, REQUEST_S)

    @property
    def ordered(self) -> bool:
        """Whether a person told something that :meth:`order` has not handed out yet."""
        return self._link.order not in (None, self._obeyed)

    def order(self) -> Order | None:
        """What a person told the moving robot on the sidecar's page; each order once."""
        order = self._link.order
        if order == self._obeyed:
            return None
        self._obeyed = order
        return order

    def report_hold(
        self, trajectory: int, seconds: float, ended_by: str, policy: str | None, then: str = ""
    ) -> Callable[[float, str], None]:
        """Tell likewise how a hold went, and what the robot does when it goes on.

        Returns:
            Tells, where it was a pause and that is over, how long it lasted, s, and where it was
            answered.
        """
        told = self._hold(trajectory, seconds, ended_by, policy) | {"next": then[:200]}
        self._outbox.report("hold", told)
        self._tell()
        return self._answered(told)

    def begin_pause(
        self, trajectory: int, why: str
    ) -> tuple[Callable[[SidecarClient], None], Callable[[float, str], None]]:
        """A pause because the sidecar does not serve the robot: it may not hear of it yet.

        Args:
            trajectory: At which the robot stands.
            why: ``"camera"``, ``"busy"`` or ``"link"``.

        Returns:
            Tells of it over another connection, once there is one (raises LinkError); and what
            :meth:`report_hold` returns.
        """
        told = self._hold(trajectory, 0.0, why, "pause")

        def announce(link: SidecarClient) -> None:
            try:
                link.report(self.run, "hold", told, REQUEST_S)
            except RunUnknown:  # it is there now, and was not when the run registered
                self.run = self._outbox.run = link.start(self.run, self._about, REQUEST_S)
                link.report(self.run, "hold", told, REQUEST_S)

        return announce, self._answered(told)

    def _hold(
        self, trajectory: int, seconds: float, ended_by: str, policy: str | None
    ) -> dict[str, Any]:
        return {
            "number": next(self._holds),
            "trajectory": trajectory,
            "seconds": round(seconds, 4),
            "resolution": ended_by,
            "policy": policy,
        }

    def _answered(self, told: Mapping[str, Any]) -> Callable[[float, str], None]:
        def answered(paused_s: float, where: str) -> None:
            over = {"paused_s": round(paused_s, 3), "answered": where}
            self._outbox.report("hold", {**told, **over})
            self._tell()

        return answered

    def report_recovery(self, told: Mapping[str, Any]) -> None:
        """Tell likewise of a recovery."""
        self._outbox.report("recovery", told)
        self._tell()

    def report_difference(self, text: str) -> None:
        """Tell likewise that the run does otherwise than its rehearsal."""
        body = {"kind": "layer1", "seconds": 0.0, "text": text[:1000]}
        self._outbox.report("incident", body)
        self._tell()

    def finish(
        self,
        outcome: str,
        detail: str,
        abandoned: Mapping[int, str],
        timeout_s: float,
        layer1: Mapping[str, Any] | None = None,
        begun: int | None = None,
    ) -> None:
        """Tell which trajectories are given up and how the run ended, as the last thing; where the
        robot itself says so, how many have ``begun``, whether somebody watched them or not.

        Raises:
            LinkError: It could not be told within ``timeout_s``.
        """
        deadline = time.monotonic() + timeout_s
        for number, reason in abandoned.items():
            self._outbox.abandon(number, reason)
        try:
            self._outbox.flush(deadline)
        except SidecarUnreachable:
            raise
        except LinkError:
            pass  # that the run is over counts more than what it said on the way
        left = max(SLICE_S, deadline - time.monotonic())
        told: dict[str, Any] = {} if layer1 is None else {"layer1": dict(layer1)}
        if begun is not None:
            keyframes = len(self._sent) + len(self._pending)
            told |= {"trajectories": begun, "keyframes": keyframes}
        self._link.finish(self.run, outcome, detail[:2000], left, told)

    def close(self) -> None:
        """Drop the connection."""
        self._link.close()

    def _tell(self) -> None:
        """Messages are for people's eyes: a sidecar that takes none holds the robot up once."""
        if self.away or self._unheard:
            return
        try:
            self._outbox.flush(time.monotonic() + REQUEST_S)
        except LinkError:
            self._unheard = True

    def _send_all(self, deadline: float, each_s: float = math.inf) -> None:
        if not self._registered:
            self._register(deadline)
        mended = 0
        while self._pending:
            keyframe = replace(self._pending[0], run=self.run)
            try:
                left = min(each_s, deadline - time.monotonic())
                self._link.keyframe(keyframe, max(SLICE_S, left))
            except (RunUnknown, SequenceGap) as trouble:
                mended += 1
                if mended > _MOST_MENDS:
                    raise
                if isinstance(trouble, SequenceGap):
                    self._close_gap(trouble, keyframe)
                else:
                    self._register(deadline)
                continue
            self._sent.append(self._pending.popleft())
            self._unheard = False

    def _report_outage(self, seconds: float, why: str) -> None:
        body = {"kind": "link", "seconds": round(seconds, 1), "text": why[:1000]}
        self._outbox.report("incident", body)
        self._unheard = False

    def _close_gap(self, gap: SequenceGap, keyframe: Keyframe) -> None:
        if gap.expected > keyframe.sequence:
            raise SidecarRefused(
                f"{gap} It has other keyframes under these numbers: run {self.run!r} was used "
                "before. Give the run a new run_id."
            )
        self._queue_again(gap.expected)

    def _queue_again(self, sequence: int) -> None:
        """The sidecar lost what it had acknowledged. The moments are over: they go late."""
        again = self._sent[sequence:]
        del self._sent[sequence:]
        self.forgotten.update(keyframe.trajectory for keyframe in again)
        self._pending.extendleft(self._late(keyframe) for keyframe in reversed(again))

    def _register(self, deadline: float) -> None:
        left = max(SLICE_S, deadline - time.monotonic())
        self.run = self._outbox.run = self._link.start(self.run, self._about, left)
        self._registered = True

    def _late(self, keyframe: Keyframe) -> Keyframe:
        self.stale.add(keyframe.trajectory)
        return replace(keyframe, late=True)
