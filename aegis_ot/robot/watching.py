"""Watch mode: Layer 2 for a run that carries no guard, over the robot's HTTP API."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .._version import __version__
from ..adapters.opentrons.run_state import PAUSED
from ..errors import LinkError, RobotError, RobotRefused, RobotUnreachable
from ..run_view import RECOVERY
from ..runtime.keyframe_sender import KeyframeSender
from ..runtime.steps import Abandon
from ..vocabulary import Keyframe, KeyframeKind, Outcome
from .client import RobotClient
from .clocks import WatchedClock
from .deck import Deck
from .following import POLL_S, Completed, Found, Lost, Started, StatusChanged, follow
from .keyframe_times import PastLink
from .listening import RunListener, Timed
from .page_pauses import PagePauses
from .recovery import RECOVERING
from .running import (
    LAST_VERDICTS_S,
    LOST_SIDECAR_S,
    NO_VERDICT,
    WAIT_SHOWN_S,
    RobotRun,
    RunDriver,
    Screen,
    tell_open,
)
from .server_answers import ENDED, RunSnapshot
from .verdicts import VerdictReader, WellVerdict, unjudged

LOSSES = (
    "The robot is not held between deliveries: when a delivery fails, the robot has gone on for "
    "some seconds before it is paused. Frames are chosen by the times of its commands and may be "
    "one camera frame off."
)
DRIVEN = (
    "Run {} is driven by single commands and has no protocol: the robot cannot pause it, and it is "
    "NOT watched. Waiting for the run of a protocol."
)


@dataclass(frozen=True)
class WatchPolicies:
    """What to do, each ``"pause"`` or ``"continue"``; and for how long a frame is asked for, s."""

    on_fail: str = "pause"
    on_undecided: str = "pause"
    on_link_loss: str = "pause"
    capture_timeout_s: float = 3.0


def await_run(
    robot: RobotClient,
    rest: Callable[[float], None] = time.sleep,
    says: Callable[[str], None] = lambda text: None,
) -> str:
    """Wait until a run has begun on the robot, also while it is switched off; its identifier.

    Args:
        robot: Where.
        rest: Between two looks.
        says: Told, once each time, why the robot does not answer, and which run is not watched: one
            that a program drives by single commands cannot be paused.
    """
    lost, unwatched = False, ""
    while True:
        try:
            current = robot.current_run()
            view = None if current is None else robot.run(current)
            if view is not None and view.id != unwatched and _is_driven(robot, view):
                unwatched = view.id
                says(DRIVEN.format(view.id))
        except (RobotUnreachable, RobotRefused) as error:  # refused: its server is starting
            if not lost:
                says(f"{error} Trying again.")
            lost = True
        else:
            lost = False
            if view is not None and view.status != "idle" and not view.ended:
                return view.id
        rest(0.5)


def _is_driven(robot: RobotClient, view: RunSnapshot) -> bool:
    """Whether a program sends this run its commands one by one: it has no protocol."""
    return view.status == "idle" and not view.protocol and robot.commands(view.id, 0).total > 0


def watch_run(
    robot: RobotClient,
    run: RobotRun,
    sidecar: PastLink,
    screen: Screen,
    policies: WatchPolicies | None = None,
    verdicts: VerdictReader | None = None,
    *,
    poll_s: float = POLL_S,
) -> RobotRun:
    """Watch a run that has begun, to its end and to its last verdict.

    Args:
        robot: Where.
        run: Its ``id`` says which; the rest is filled in.
        sidecar: Scores its deliveries.
        screen: Shows it.
        policies: What to do when a delivery fails, or cannot be watched.
        verdicts: Of the same sidecar: read at the end, so that both reports say the same.
        poll_s: Pause between two looks at the robot.

    Raises:
        RobotError: The robot is lost for too long. The run goes on unwatched.
        LinkError: The sidecar is not there at the beginning.
    """
    driver = RunDriver(robot, run, screen)
    watch = _Watch(robot, run, sidecar, screen, policies or WatchPolicies(), driver)
    watch.begin()
    if verdicts is not None:
        verdicts.run = run.watched_as
    screen.says(LOSSES)
    began = time.monotonic()

    def idle() -> None:
        driver.look_around()
        watch.look_around()

    try:
        try:
            for step in follow(robot, run.id, poll_s=poll_s, idle=idle):
                driver.take(step)
                watch.take(step)
        finally:
            run.seconds = time.monotonic() - began
        watch.await_last()
    finally:
        watch.end()
        RunDriver(robot, run, screen, verdicts).last_words()
    return run


def name_of_watch(run: str) -> str:
    """What a watched run is called at its sidecar."""
    return f"watch-{run}"


class _Watch:
    def __init__(
        self,
        robot: RobotClient,
        run: RobotRun,
        sidecar: PastLink,
        screen: Screen,
        policies: WatchPolicies,
        driver: RunDriver,
    ) -> None:
        self._paused = driver.paused_because
        self._failed_step = driver.failed_step
        driver.failed_again = self._recover
        self._robot = robot
        self._run = run
        self._link = sidecar
        self._screen = screen
        self._policies = policies
        self.name = name_of_watch(run.id)
        self._sender = KeyframeSender(sidecar, self.name, self._about(), time.sleep)
        self._pauses = PagePauses(self._sender, driver.recovery.act)
        self._clock = WatchedClock(robot.clock, screen.says)
        self._listener = RunListener(Deck(robot, run.id), self.name, self._clock)
        self._places: dict[int, str] = {}
        self._awaited: list[int] = []
        self._guarded = False
        self._lost = False
        self._heard_at = 0

    def begin(self) -> None:
        self._sender.register(self._policies.capture_timeout_s)
        self._run.watched_as = self._sender.run
        if self._sender.run != self.name:
            self._screen.says(
                f"This run was watched before; what is seen from now on is kept apart, as "
                f"{self._sender.run!r}."
            )
        self._clock.look()

    def take(self, step: Any) -> None:
        if isinstance(step, Started):
            if step.command.is_guards and not self._guarded:
                self._guarded = True
                self._screen.says(
                    "This run carries a guard of its own; it need not be watched too."
                )
            self._tell(self._listener.started(step.command))
        elif isinstance(step, Completed):
            self._tell(self._listener.completed(step.command))
        elif isinstance(step, Lost):
            self._lost = True
        elif isinstance(step, Found):
            self._lost = False
            self._clock.look()
        elif isinstance(step, StatusChanged):
            if step.run.status == RECOVERING:
                self._recover()
            elif step.run.status not in PAUSED and step.run.status != "pause-requested":
                self._pauses.is_over()
            self._tell(self._listener.status(step.run.status))

    def _recover(self) -> None:
        self._pauses.begin(self._heard_at, RECOVERY, self._failed_step())

    def look_around(self) -> None:
        """Between two looks at the run: the clocks, and the verdict that is due first."""
        self._clock.look_around(followed=not self._lost)
        self._pauses.look_around()
        self._obey()
        if not self._awaited or self._sender.away:
            return
        number = self._awaited[0]
        try:
            verdict = self._sender.verdict(number)
        except LinkError as error:
            self._lose(error)
            return
        if verdict is None:
            return
        self._awaited.pop(0)
        known = WellVerdict(self._places.get(number, ""), verdict)
        self._run.verdicts[number] = known
        self._screen.judged(known)
        if verdict.outcome is Outcome.FAIL:
            self._apply(self._policies.on_fail, f"{known.well} failed", number)
        elif verdict.outcome is Outcome.UNDECIDED:
            self._apply(self._policies.on_undecided, f"{known.well} could not be judged", number)

    def await_last(self) -> None:
        """The run is over: wait for its last verdicts while the sidecar works on them."""
        heard, left, told = time.monotonic(), len(self._awaited), False
        while self._awaited:
            away = not self._sender.look(self._policies.capture_timeout_s)
            self.look_around()
            now = time.monotonic()
            if len(self._awaited) < left:
                heard, left = now, len(self._awaited)
            waited = now - heard
            if waited >= (LOST_SIDECAR_S if away else LAST_VERDICTS_S):
                break
            if waited >= WAIT_SHOWN_S and not told:
                self._screen.says(tell_open(map(self._place, self._awaited)))
                told = True
            time.sleep(0.02)  # an answer may come at once

    def end(self) -> None:
        """The run is over, or is followed no longer: what is open is undecided; goodbye."""
        for number in self._awaited:
            verdict = unjudged(self.name, number, NO_VERDICT)
            known = self._run.verdicts[number] = WellVerdict(self._place(number), verdict)
            self._screen.judged(known)
        status = self._run.status
        outcome = status if status in ENDED else "failed"
        detail = "" if outcome == status else "The run was followed no longer."
        detail = " ".join(self._run.errors) or detail
        given_up = self._listener.break_off(f"the run {outcome}")
        try:
            self._sender.finish(outcome, detail, given_up, self._policies.capture_timeout_s)
        except LinkError as error:
            self._screen.says(str(error))
        finally:
            self._sender.close()

    def _place(self, number: int) -> str:
        return self._places.get(number) or f"delivery {number}"

    def _tell(self, heard: list[Abandon | Timed]) -> None:
        for one in heard:
            if isinstance(one, Abandon):
                self._sender.abandon(one.trajectory, one.reason)
            else:
                self._send(one.keyframe, one.moment)

    # The sidecar

    def _send(self, keyframe: Keyframe, moment: float) -> None:
        sender = self._sender
        self._link.moments[keyframe.sequence] = moment
        if keyframe.destinations:
            self._places[keyframe.trajectory] = str(keyframe.destinations[0])
        sender.offer(keyframe)
        self._heard_at = keyframe.trajectory
        if keyframe.kind is KeyframeKind.POST_DISPENSE:
            self._awaited.append(keyframe.trajectory)
        if sender.away and not sender.look(self._policies.capture_timeout_s):
            sender.move_on()
            return
        try:
            sender.deliver(self._policies.capture_timeout_s)
        except LinkError as error:
            self._lose(error)

    def _lose(self, error: LinkError) -> None:
        self._screen.says(f"{error} Deliveries are not watched until it is back.")
        self._sender.give_up()
        self._apply(self._policies.on_link_loss, "the sidecar is away")

    def _obey(self) -> None:
        """Do what a person told the robot on the sidecar's page; heard with its answers."""
        order = self._sender.order()
        if order is not None:
            self._apply(order.action, f"{order.by} says so", self._heard_at, "operator")

    def _apply(
        self, policy: str, why: str, trajectory: int | None = None, cause: str = "verdict"
    ) -> None:
        did = {"pause": "paused", "stop": "stopped"}.get(policy)
        if did is None:
            return
        try:
            self._robot.act(self._run.id, policy)
        except RobotRefused:
            self._screen.says(f"Not {did}: {why}, but the run is not running.")
        except RobotError as error:
            self._screen.says(f"NOT {did.upper()}, though {why}: {error}")
        else:
            self._screen.says(
                f"{did.capitalize()} by the watch: {why}. Motion ends with the current move."
            )
            if policy == "pause":
                self._paused(f"The watch paused the run: {why}.")
                if trajectory is not None:
                    self._pauses.begin(trajectory, cause)

    def _about(self) -> dict[str, Any]:
        return {
            "run": self.name,
            "protocol": self._run.protocol,
            "robot": "",
            "robot_name": self._run.robot[:200],
            "simulated": False,
            "started": time.time(),
            "package": __version__,
            "mode": "watch",
            "guard": {
                "hold": "off",
                "on_fail": self._policies.on_fail,
                "on_undecided": self._policies.on_undecided,
                "on_link_loss": self._policies.on_link_loss,
            },
        }
