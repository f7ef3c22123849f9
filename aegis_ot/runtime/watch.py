"""The listener that guards a run: keyframes out, verdicts in, holds between."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

from ..errors import ConfigurationError, LinkError, RunAborted
from ..instrumentation import Event, Operation
from ..settings import SIMULATED, Settings
from ..vocabulary import Gate, Keyframe, KeyframeKind, Outcome, Verdict
from .courier import Courier
from .link import SidecarLink
from .operator import Answer, Operator
from .runstate import RunState
from .steps import Abandon, Capture, Hold, Lift, Step
from .summary import WatchSummary
from .tracker import Tracker
from .words import about_run, tell_verdict, working_volume

LiftMove = Callable[[Operation], None]
_SLICE_S = 0.1
_GOODBYE_S = 3.0
_HASTY_GOODBYE_S = 0.25


class _Stopping(Exception):
    """The run is being stopped: drop everything. Never leaves this module."""


class Watcher:
    """Layer 2 of one run, on the robot.

    In a simulation that is not watched (an analysis, say) it does nothing but insert the same
    moves as in the live run.

    Args:
        protocol: The context of the run.
        settings: In force for this run; ``settings.sidecar`` must not be ``None``.
        file_name: Name of the protocol file, for the record.
    """

    def __init__(self, protocol: Any, settings: Settings, file_name: str) -> None:
        self._settings = settings
        self._simulating = bool(protocol.is_simulating())
        self.run_id = settings.new_run_id()
        self.result = WatchSummary(watching=settings.watch_simulation or not self._simulating)
        self._state = RunState(protocol)
        self._operator = Operator(protocol, self._simulating, self._rest)
        self._tracker = Tracker(self.run_id, settings.hold, settings.lift, working_volume)
        self._lift: LiftMove = lambda operation: None
        self._courier: Courier | None = None
        self._about = about_run(protocol, self.run_id, file_name, self._simulating)
        self._stopped = False
        self._aborted = ""
        self._leaving = False

    # What the guard calls

    def begin(self, lift: LiftMove) -> None:
        """Before the protocol's first command.

        Args:
            lift: Moves the tip to the top of the wells of a recent operation, unheard.

        Raises:
            ConfigurationError: The sidecar setting names nothing that can be reached.
            RunAborted: The sidecar is away, and the policy says so.
        """
        self._lift = lift
        if not self.result.watching:
            return
        url = self._settings.sidecar
        if url is None or url == SIMULATED:
            raise ConfigurationError(
                f"Setting 'sidecar' is {url!r}, which is no address. Run the protocol with "
                "`aegis-ot simulate`, which brings a simulated sidecar, or give the address of a "
                'running one: "http://HOST:PORT".'
            )
        link = SidecarLink(url, self._settings.token, self._check_stop)
        self._courier = Courier(link, self.run_id, self._about, self._rest)
        try:
            self._stoppable(lambda: self._insist(self._register))
        except BaseException:
            link.close()
            raise

    def before(self, operation: Operation) -> None:
        """Of :class:`aegis_ot.instrumentation.Listener`."""
        self._perform(self._tracker.before(operation))

    def after(self, operation: Operation) -> None:
        """Of :class:`aegis_ot.instrumentation.Listener`."""
        self._perform(self._tracker.after(operation))

    def event(self, event: Event) -> None:
        """Of :class:`aegis_ot.instrumentation.Listener`."""
        if not self._operator.busy:  # the guard's own pauses and comments are no events
            self._perform(self._tracker.event(event))

    def end(self, error: BaseException | None) -> None:
        """After the protocol's last command, or when it raised ``error``.

        Raises:
            RunAborted: A last well failed, and the policy says so.
        """
        outcome, detail = "succeeded", ""
        try:
            if self._aborted and error is not None:
                outcome, detail = "aborted", self._aborted
            elif error is None:
                self._perform(self._tracker.finish())
                self._operator.catch_up()
            else:
                outcome = "failed"
                detail = f"{type(error).__name__}: {error}"
        except RunAborted as aborted:
            outcome, detail = "aborted", str(aborted)
            raise
        except BaseException as failure:
            outcome, detail = "failed", f"{type(failure).__name__}: {failure}"
            raise
        finally:
            if outcome in ("succeeded", "failed") and (self._stopped or self._state.stopping):
                outcome = "stopped"
            self._say_goodbye(outcome, detail)

    def summary(self) -> str:
        """One line for the run log."""
        return self.result.text()

    # Steps

    def _perform(self, steps: Iterable[Step]) -> None:
        if self._stopped:
            return
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
                    self._hold(step)
                else:
                    self._abandon(step)

        self._stoppable(perform)

    def _capture(self, keyframe: Keyframe) -> None:
        if keyframe.kind is KeyframeKind.DISPENSE:
            self.result.places[keyframe.trajectory] = ", ".join(
                str(well) for well in keyframe.destinations[:1]
            )
        courier = self._link_up()
        courier.offer(replace(keyframe, robot_time=time.time()))
        timeout = self._settings.capture_timeout_s
        if courier.away and not courier.look(timeout):
            courier.move_on()
            return
        self._insist(lambda: courier.deliver(timeout))

    def _abandon(self, step: Abandon) -> None:
        self.result.abandoned.add(step.trajectory)
        self._link_up().abandon(step.trajectory, step.reason)

    def _hold(self, step: Hold) -> None:
        deadline = time.monotonic() + self._settings.verdict_timeout_s
        for number in step.trajectories:
            began = time.monotonic()
            verdict, ended_by = None, "stopped"
            try:
                verdict, ended_by = self._await_verdict(number, deadline)
            finally:
                self.result.held(time.monotonic() - began)
            self._resolve(step, number, verdict, ended_by, time.monotonic() - began)

    def _await_verdict(self, number: int, deadline: float) -> tuple[Verdict | None, str]:
        """Poll in short waits until the verdict is in; else why there is none."""
        courier = self._link_up()
        while True:
            if number in courier.stale:
                return None, "late keyframes"
            if courier.away:
                return None, "link lost"
            self._check_stop()
            asked = time.monotonic()
            verdict = None
            try:
                verdict = courier.verdict(number)
            except LinkError:
                self._insist(self._register)  # the same patience as for a keyframe
            if verdict is not None:
                return verdict, "verdict"
            if time.monotonic() - asked < _SLICE_S / 2:
                self._rest(_SLICE_S / 5)  # it answered at once: do not hammer it
            if self._state.paused:
                deadline += time.monotonic() - asked  # an operator's pause is nobody's delay
            if time.monotonic() >= deadline:
                return None, "timeout"

    def _resolve(
        self, step: Hold, number: int, verdict: Verdict | None, ended_by: str, seconds: float
    ) -> None:
        settings = self._settings
        policy: str | None = None
        place = self.result.places.get(number) or f"trajectory {number}"
        if verdict is None:
            self.result.lost[number] = ended_by
            text = f"No verdict on {place} within {settings.verdict_timeout_s:g} s."
            if ended_by == "timeout":
                policy = settings.on_link_loss
        else:
            self.result.verdicts[number] = verdict
            text = tell_verdict(place, verdict)
            if verdict.outcome is Outcome.FAIL:
                policy = settings.on_fail
            elif verdict.outcome is Outcome.UNDECIDED:
                policy = settings.on_undecided
        if step.final and settings.hold == "off":
            policy = "continue" if policy else None  # too late to change anything
        self._link_up().report_hold(number, seconds, ended_by, policy)
        if policy == "continue":
            self._operator.comment(f"{text} The run goes on, as configured.")
        elif policy == "abort":
            raise RunAborted(f"{text} The run ends here, as configured (before {step.reason}).")
        elif policy == "pause":
            self._operator.pause(
                f"{text} Paused before {step.reason}. Resume to go on, or cancel the run.",
                lambda: self._decision(number),
            )

    def _decision(self, number: int) -> Answer | None:
        """What the operator decided on the sidecar's page, where the run cannot be resumed."""
        try:
            verdict = self._link_up().verdict(number)
        except LinkError:
            return None
        if verdict is None or verdict.gate is not Gate.OPERATOR:
            return None
        self.result.verdicts[number] = verdict
        return Answer.RESUME if verdict.outcome is Outcome.PASS else Answer.ABORT

    # Trouble with the link

    def _register(self) -> None:
        self._link_up().register(self._settings.capture_timeout_s)

    def _insist(self, attempt: Callable[[], None]) -> None:
        """Attempt; if that fails, do as ``on_link_loss`` says. Returns when the run may go on."""
        courier = self._link_up()
        trouble = _trouble_of(attempt)
        if trouble is None:
            return
        self.result.outages += 1
        policy = self._settings.on_link_loss
        if policy == "abort":
            raise RunAborted(f"{trouble} The run ends here, as configured.") from trouble
        if policy == "pause":
            self._operator.pause(
                f"{trouble} Resume to try again; if it is still away then, the run goes on "
                "unwatched until it is back. Or cancel the run.",
                self._is_back,
            )
            trouble = trouble if self._simulating else _trouble_of(attempt)
            if trouble is None:
                return
        courier.give_up()
        if not (policy == "pause" and self._simulating):
            self._operator.comment(
                f"{trouble} The run goes on unwatched until the sidecar is back."
            )

    def _is_back(self) -> Answer | None:
        return Answer.RESUME if _trouble_of(self._glance) is None else None

    def _glance(self) -> None:
        self._link_up().register(_SLICE_S)

    def _say_goodbye(self, outcome: str, detail: str) -> None:
        courier, self._courier = self._courier, None
        self._lift = lambda operation: None
        leftover = self._tracker.break_off(f"the run {outcome}")
        if courier is None:
            return
        self.result.keyframes = courier.acknowledged
        self._leaving = True  # a stop in progress must not keep the sidecar uninformed
        patience = _HASTY_GOODBYE_S if outcome == "stopped" else _GOODBYE_S
        try:
            if outcome != "stopped" and not courier.away:
                for step in leftover:
                    if isinstance(step, Abandon):
                        courier.abandon(step.trajectory, step.reason)
            courier.finish(outcome, detail, patience)
        except LinkError:
            pass  # it was lost before, and the policy has had its say
        finally:
            courier.close()

    # Stopping

    def _check_stop(self) -> None:
        if not self._leaving and self._state.stopping:
            raise _Stopping

    def _rest(self, seconds: float) -> None:
        until = time.monotonic() + seconds
        while (left := until - time.monotonic()) > 0:
            self._check_stop()
            time.sleep(min(_SLICE_S, left))
        self._check_stop()

    def _stoppable(self, action: Callable[[], None]) -> None:
        """Drop everything on a stop: the next command raises what Opentrons raises then."""
        try:
            action()
        except _Stopping:
            self._stopped = True
        except RunAborted as aborted:
            self._aborted = str(aborted)
            raise

    def _link_up(self) -> Courier:
        if self._courier is None:
            raise RuntimeError("begin() was not called, or end() was")
        return self._courier


def _trouble_of(attempt: Callable[[], None]) -> LinkError | None:
    try:
        attempt()
    except LinkError as error:
        return error
    return None
