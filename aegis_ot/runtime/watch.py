"""The listener that guards a run: keyframes out, verdicts in, holds between."""

from __future__ import annotations

import hashlib
import time
import uuid
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..adapters.opentrons.instrumentation import Event, Operation, Tap
from ..adapters.opentrons.run_refusal import refuse_everything
from ..adapters.opentrons.run_state import RunState
from ..errors import LinkError, RunAborted
from ..http_client import CheckStop
from ..settings import Settings
from ..vocabulary import Keyframe, KeyframeKind
from .boundaries import Holding
from .cancellation import LAST_WORDS_S, CancellationToken, Stopping
from .delivery_policy import DeliveryPolicy
from .descriptions import about_guard, about_run, working_volume
from .keyframe_sender import KeyframeSender
from .objecting import object_to
from .operator import Operator
from .page_answers import PageAnswers
from .probes import liquid_found, never_asked
from .recovering import RunRecoveries, TipKnowledge
from .sidecar_client import SidecarClient
from .steps import Abandon, Capture, Hold, Lift, Step
from .summary import WatchSummary
from .tracker import Tracker

LiftMove = Callable[[Operation], None]
_GOODBYE_S = 3.0


@dataclass(frozen=True)
class _Line:
    """What stands between robot and sidecar while a run is watched."""

    sender: KeyframeSender
    delivery: DeliveryPolicy
    holding: Holding


class Watcher:
    """Layer 2 of one run, on the robot.

    In a simulation that is not watched (an analysis, say) it does nothing but insert the same
    moves as in the live run.

    Args:
        protocol: The context of the run.
        settings: In force for this run; ``settings.sidecar`` must not be ``None``.
        file_name: ``co_filename`` of the protocol's code.
        about: Of the run's registration what is known before it: ``layer1``, ``title``, ``plates``,
            ``planned``.
        tips: What Layer 1 knows of them; without it nothing is recovered.
        text: The protocol's, where it is known.
    """

    def __init__(
        self,
        protocol: Any,
        settings: Settings,
        file_name: str,
        about: Mapping[str, Any] | None = None,
        tips: TipKnowledge | None = None,
        text: str = "",
    ) -> None:
        self._settings = settings
        self._simulating = bool(protocol.is_simulating())
        self.run_id = settings.new_run_id()
        self._nonce = self.run_id if settings.run_id is None else uuid.uuid4().hex
        self.result = WatchSummary(watching=settings.watch_simulation or not self._simulating)
        self._state = RunState(protocol)
        self._waits = CancellationToken(self._state)
        self._operator = Operator(protocol, self._simulating, self._waits.rest)
        # A simulator's probe finds what the simulator assumes: no witness.
        probe = never_asked if self._simulating else liquid_found
        self._tracker = Tracker(self.run_id, settings.hold, settings.lift, working_volume, probe)
        self._lift: LiftMove = lambda operation: None
        self._tips = tips
        self._recovery: RunRecoveries | None = None
        self._line: _Line | None = None
        self._about = about_run(protocol, self.run_id, file_name, self._simulating) | {
            **(about or {}),
            "guard": about_guard(settings),
            "protocol_sha256": hashlib.sha256(text.encode()).hexdigest() if text else "",
        }
        self._refuse: Callable[[RunAborted], None] = lambda error: refuse_everything(
            protocol, error, file_name
        )
        self._stopped = False
        self._aborted = ""
        self.acting = False
        """Whether what moves now is the guard's own doing."""

    # What the guard calls

    def begin(self, tap: Tap) -> None:
        """Before the protocol's first command.

        Args:
            tap: On the protocol's instruments; this watcher is one of its listeners.

        Raises:
            RunAborted: The sidecar is away, and the policy says so.
        """
        self._lift = tap.lift
        if not self.result.watching:
            return
        self._operator.begin()
        self._line = line = self._connect(tap)
        try:
            self._stoppable(lambda: line.delivery.insist(line.delivery.register))
            self._say_name(line)
        except BaseException:
            self._operator.end()
            line.sender.close()
            raise

    def before(self, operation: Operation) -> None:
        """Of :class:`.Listener`."""
        goes_on = self._perform(self._tracker.before(operation), operation)
        if self._recovery is not None:
            self._recover(self._recovery, operation)
        if goes_on:
            self._operator.proceed()

    def after(self, operation: Operation) -> None:
        """Of :class:`.Listener`."""
        if self._recovery is not None:
            self._recovery.strokes.done(operation)
        if self._perform(self._tracker.after(operation)):
            self._operator.proceed()

    def event(self, event: Event) -> None:
        """Of :class:`.Listener`."""
        if self._operator.busy:
            return  # the guard's own pauses and comments are no events
        if self._perform(self._tracker.event(event)):
            self._operator.proceed()

    @property
    def may_object(self) -> bool:
        """Of :class:`aegis_ot.runtime.objecting.RunControl`."""
        return True

    def object_to(self, text: str) -> None:
        """Layer 1 finds that what the protocol does next breaks a rule: as ``on_fail`` says.

        Raises:
            RunAborted: The policy, or the operator, ends the run.
        """
        line, number = self._line, max(0, self._tracker.trajectories - 1)

        def on_page(paused: str) -> None:
            self._connected().holding.pause(number, paused)

        ask = on_page if line is not None and not self._simulating else None
        self._stoppable(lambda: object_to(text, self._settings, self._operator, ask))

    def tell_difference(self, text: str) -> None:
        """The run does otherwise than its rehearsal: the sidecar's page says so at once."""
        if self._line is not None:
            self._line.sender.report_difference(text)

    def end(
        self, error: BaseException | None, told: str = "", layer1: Mapping[str, Any] | None = None
    ) -> None:
        """After the protocol's last command, or when it raised ``error``.

        Args:
            error: What it raised, or ``None``.
            told: What there is to say of it, where it is not ``error`` itself.
            layer1: What Layer 1 says in the end, where that is not what it said at the beginning.

        Raises:
            RunAborted: A last well failed, and the policy says so.
        """
        outcome, detail = "succeeded", ""
        try:
            if self._aborted and error is not None:
                outcome, detail = "aborted", self._aborted
            elif error is None:
                self._perform(self._tracker.finish())
                self._operator.proceed()
            else:
                outcome = "failed"
                detail = told or f"{type(error).__name__}: {error}"
        except RunAborted as aborted:
            outcome, detail = "aborted", str(aborted)
            raise
        except BaseException as failure:
            outcome, detail = "failed", f"{type(failure).__name__}: {failure}"
            raise
        finally:
            if outcome in ("succeeded", "failed") and (self._stopped or self._state.stopping):
                outcome, detail = "stopped", ""  # what Opentrons raises then is no news
            self._operator.end()
            self._say_goodbye(outcome, detail, layer1)

    def summary(self) -> str:
        """One line for the run log."""
        return self.result.text()

    # Steps

    def _perform(self, steps: Sequence[Step], boundary: Operation | None = None) -> bool:
        """Do all steps; whether the run went on until then."""
        if self._stopped:
            return False
        if self._aborted:
            # The protocol caught it (`except Exception`) and goes on; the robot must not.
            raise RunAborted(self._aborted)

        def perform() -> None:
            for step in steps:
                if isinstance(step, Lift):
                    self._lift(step.operation)
                elif not self.result.watching:
                    continue
                elif isinstance(step, Capture):
                    self._capture(step.keyframe)
                elif isinstance(step, Hold):
                    free = boundary if step is steps[-1] else None
                    self._connected().holding.hold(step, free)
                else:
                    self._abandon(step)

        self._stoppable(perform)
        return True

    def _recover(self, recovery: RunRecoveries, operation: Operation) -> None:
        """Put right what failed, before ``operation``; what is done is watched like the rest."""
        while recovery.is_due and not self._stopped:
            self._act(recovery.carry_out)
            self._perform(self._tracker.before(operation), operation)
        if not self._stopped and recovery.needs_clean_tip(operation):
            self._act(lambda: recovery.give_clean_tip(operation))
            self._perform(self._tracker.before(operation), operation)

    def _act(self, action: Callable[[], None]) -> None:
        self.acting = True
        try:
            with self._operator.aside():
                self._stoppable(action)
        finally:
            self.acting = False

    def _capture(self, keyframe: Keyframe) -> None:
        if keyframe.kind is KeyframeKind.DISPENSE:
            self.result.places[keyframe.trajectory] = ", ".join(
                str(well) for well in keyframe.destinations[:1]
            )
        if self._recovery is not None:
            self._recovery.strokes.captured(keyframe)
        line = self._connected()
        sender = line.sender
        now, uptime = time.time(), time.monotonic()
        sender.offer(replace(keyframe, robot_time=now, robot_uptime=uptime))
        timeout = self._settings.capture_timeout_s
        if sender.away and not sender.look(timeout):
            sender.move_on()
            return
        line.delivery.insist(lambda: sender.deliver(timeout), keyframe.trajectory)
        self._say_name(line)
        line.holding.obey(keyframe.trajectory)

    def _say_name(self, line: _Line) -> None:
        """The sidecar gave the run a name of its own: another start has the one it came with."""
        before, self.run_id = self.run_id, line.sender.run
        if before != self.run_id:
            self._operator.comment(
                f"The sidecar has another run {before!r}; this one is watched as {self.run_id!r}, "
                "and no frame or verdict of the other counts. Give each run a run_id of its own, "
                "or none."
            )

    def _abandon(self, step: Abandon) -> None:
        self.result.abandoned.add(step.trajectory)
        self._connected().sender.abandon(step.trajectory, step.reason)

    def _stoppable(self, action: Callable[[], None]) -> None:
        """Drop everything on a stop: the next command raises what Opentrons raises then."""
        try:
            action()
        except Stopping:
            self._stopped = True
        except RunAborted as aborted:
            self._aborted = str(aborted)
            self._refuse(aborted)
            raise

    # The line to the sidecar

    def _connect(self, tap: Tap) -> _Line:
        url, token = self._settings.sidecar, self._settings.token
        assert url is not None

        def link(check: CheckStop) -> SidecarClient:
            return SidecarClient(url, token, check, self._nonce)

        sender = KeyframeSender(link(self._waits.check), self.run_id, self._about, self._waits.rest)
        delivery = DeliveryPolicy(
            sender,
            self._settings,
            self._operator,
            self._state,
            self._waits,
            self._simulating,
            self.result,
            lambda number, announce: PageAnswers(
                link,
                lambda: sender.run,
                number,
                lambda: self._state.paused,
                announce,
                self._settings.robot_headers(),
            ),
        )
        if self._settings.recover and self._tips is not None:
            self._recovery = RunRecoveries(
                self._settings, self._tips, tap, self._operator.comment, sender.report_recovery,
                self._waits.check, self.result,
            )  # fmt: skip
            self._tracker.mark_recoveries(self._recovery.of_mount)
        holding = Holding(
            sender, delivery, self._settings, self._operator, self._state, self._waits, self.result,
            link, self._recovery,
        )  # fmt: skip
        delivery.obey = holding.obey
        return _Line(sender, delivery, holding)

    def _connected(self) -> _Line:
        if self._line is None:
            raise RuntimeError("begin() was not called, or end() was")
        return self._line

    def _say_goodbye(
        self, outcome: str, detail: str, layer1: Mapping[str, Any] | None = None
    ) -> None:
        line, self._line = self._line, None
        self._lift = lambda operation: None
        self._recovery = None
        self._refuse = lambda error: None
        leftover = self._tracker.break_off(f"the run {outcome}")
        if line is None:
            return
        sender = line.sender
        self.result.keyframes = sender.acknowledged
        self._waits.leave()
        patience = LAST_WORDS_S if outcome == "stopped" else _GOODBYE_S
        given_up = {step.trajectory: step.reason for step in leftover if isinstance(step, Abandon)}
        if outcome == "stopped" or sender.away:
            given_up = {}
        try:
            begun = self._tracker.trajectories
            sender.finish(outcome, detail, given_up, patience, layer1, begun)
        except (LinkError, Stopping):
            pass  # it was lost before, and the policy has had its say; or nobody wants to wait
        finally:
            sender.close()
