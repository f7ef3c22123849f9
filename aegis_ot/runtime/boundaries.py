"""A boundary: wait for verdicts, and do as the policy says where one is bad or missing."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import NoReturn

from ..adapters.opentrons.instrumentation import Operation
from ..adapters.opentrons.run_state import RunState, can_be_resumed
from ..errors import LinkError, RunAborted
from ..http_client import SLICE_S, CheckStop
from ..settings import Settings
from ..vocabulary import Outcome, Verdict, one_line, unobserved
from .cancellation import CancellationToken
from .delivery_policy import DeliveryPolicy
from .descriptions import tell_unobserved, tell_verdict
from .keyframe_sender import KeyframeSender
from .operator import LONGEST, Operator, no_news
from .page_answers import PageAnswers, act_on_current_run
from .recovering import NO_RECOVERY, RunRecoveries
from .sidecar_client import SidecarClient
from .steps import Hold
from .summary import WatchSummary

_STOP_S = 5.0
"""How long the robot's server may take to stop the run that it was told to stop, s."""


LOST, TIMEOUT = "lost by the sidecar", "timeout"
"""Why there is no verdict, where the policy has not been asked yet."""

_STRICTNESS = (None, "continue", "pause", "abort")


class Holding:
    """The holds of one run.

    Args:
        sender: Speaks to the sidecar.
        delivery: What to do when it cannot.
        settings: Time limits and policies.
        operator: Told of bad verdicts.
        state, waits: Of the run.
        result: Holds and verdicts are counted here.
        link: Makes a further connection to the sidecar.
        recovery: Puts failed wells right where it may; asked before the policies.
    """

    def __init__(
        self,
        sender: KeyframeSender,
        delivery: DeliveryPolicy,
        settings: Settings,
        operator: Operator,
        state: RunState,
        waits: CancellationToken,
        result: WatchSummary,
        link: Callable[[CheckStop], SidecarClient],
        recovery: RunRecoveries | None = None,
    ) -> None:
        self._recovery = recovery
        self._link = link
        self._sender = sender
        self._delivery = delivery
        self._settings = settings
        self._operator = operator
        self._state = state
        self._waits = waits
        self._result = result

    def hold(self, step: Hold, boundary: Operation | None = None) -> None:
        """Stand still until every verdict of ``step`` is in and dealt with.

        Args:
            step: Which.
            boundary: What the protocol does next, if a recovery may come before it.

        Raises:
            RunAborted: A policy, or the operator, ends the run.
            Stopping: The run is being stopped.
        """
        deadline = time.monotonic() + self._settings.verdict_timeout_s
        for number in step.trajectories:
            began = time.monotonic()
            try:
                verdict, ended_by = self._await(number, deadline)
            finally:
                self._result.held(time.monotonic() - began)
            held = time.monotonic() - began
            self._resolve(step, number, verdict, ended_by, held, boundary)

    def _await(self, number: int, deadline: float) -> tuple[Verdict | None, str]:
        """Poll in short waits until the verdict is in; else why there is none."""
        sender = self._sender
        while True:
            if number in sender.forgotten:
                return None, LOST
            if number in sender.stale:
                return None, "late keyframes"
            if sender.away:
                return None, "link lost"
            self._waits.check()
            asked = time.monotonic()
            verdict = None
            try:
                verdict = sender.verdict(number)
                deadline += self.obey(number)
            except LinkError:
                # The same patience as for a keyframe.
                self._delivery.insist(self._delivery.register, number)
            if verdict is not None:
                return verdict, "verdict"
            if time.monotonic() - asked < SLICE_S / 2:
                self._waits.rest(SLICE_S / 5)  # it answered at once: do not hammer it
            if self._state.paused:
                deadline += time.monotonic() - asked  # an operator's pause is nobody's delay
            if time.monotonic() >= deadline:
                return None, TIMEOUT

    def _resolve(
        self,
        step: Hold,
        number: int,
        verdict: Verdict | None,
        ended_by: str,
        seconds: float,
        boundary: Operation | None,
    ) -> None:
        """Do as the policy says, once a hold is over."""
        if verdict is None:
            text, policy = self._without_verdict(number, ended_by)
        else:
            text, policy = self._with_verdict(number, verdict)
        answer = NO_RECOVERY
        if self._recovery is not None:
            answer = self._recovery.judged(number, verdict, boundary)
        policy = self._strictest(step, number, verdict, policy)
        if answer.begins:
            policy = "recover"
        text = one_line(f"{text} {answer.refusal}".rstrip(), LONGEST)
        answered = self._sender.report_hold(number, seconds, ended_by, policy, step.reason)
        if policy == "continue":
            self._operator.comment(f"{text} The run goes on, as configured.")
        elif policy == "abort":
            raise RunAborted(f"{text} The run ends here, as configured (before {step.reason}).")
        elif policy == "pause":
            self._pause(
                number,
                f"{text} Paused before {step.reason}. Resume to go on, or cancel the run.",
                answered,
            )

    def _without_verdict(self, number: int, ended_by: str) -> tuple[str, str | None]:
        """What is said where there is none, and the policy: for late keyframes and a lost link it
        was asked when that happened."""
        self._result.lost[number] = ended_by
        if ended_by == LOST:
            return (
                f"No verdict on {self._place(number)}: the sidecar lost its keyframes.",
                self._settings.on_link_loss,
            )
        return (
            f"No verdict on {self._place(number)} within {self._settings.verdict_timeout_s:g} s.",
            self._settings.on_link_loss if ended_by == TIMEOUT else None,
        )

    def _with_verdict(self, number: int, verdict: Verdict) -> tuple[str, str | None]:
        """What is said of a verdict, and its policy; ``None`` if it is good."""
        hidden = unobserved([verdict])
        if hidden and not unobserved(self._result.verdicts.values()):
            self._operator.comment(tell_unobserved(hidden))
        self._result.verdicts[number] = verdict
        policies = {
            Outcome.FAIL: self._settings.on_fail,
            Outcome.UNDECIDED: self._settings.on_undecided,
        }
        return tell_verdict(self._place(number), verdict), policies.get(verdict.outcome)

    def _strictest(
        self, step: Hold, number: int, verdict: Verdict | None, policy: str | None
    ) -> str | None:
        """The policy, with what is known of the well already."""
        passed = verdict is not None and verdict.outcome is Outcome.PASS
        if not passed and number in self._result.attempts:
            # The well is known to have failed, and was not seen to be put right.
            policy = max(policy, self._settings.on_fail, key=_STRICTNESS.index)
        if step.final and self._settings.hold == "off":
            return "continue" if policy else None  # too late to change anything
        return policy

    def _place(self, number: int) -> str:
        return self._result.places.get(number) or f"trajectory {number}"

    def obey(self, number: int) -> float:
        """Do what a person told the moving robot on the sidecar's page, if anybody did.

        Returns:
            For how long it was paused, s.

        Raises:
            RunAborted, Stopping: The person ends the run.
        """
        order = self._sender.order()
        if order is None:
            return 0.0
        if order.action == "stop":
            self._end(f"{order.by} ended the run on the sidecar's page.")
        began = time.monotonic()
        answered = self._sender.report_hold(number, 0.0, "operator", "pause")
        self._pause(
            number,
            f"{order.by} paused the run on the sidecar's page. Resume to go on, or cancel the run.",
            answered,
        )
        return time.monotonic() - began

    def pause(self, number: int, text: str) -> None:
        """Layer 1 has found an error in what comes next: wait for a person, on the page too.

        Raises:
            RunAborted, Stopping: The person ends the run.
        """
        self._pause(number, text, self._sender.report_hold(number, 0.0, "layer1", "pause"))

    def _end(self, text: str) -> NoReturn:
        """Stop as the App's button does; where nobody can, by an error."""
        if can_be_resumed() and act_on_current_run("stop", self._settings.robot_headers()):
            self._waits.rest(_STOP_S)
        raise RunAborted(text)

    def _pause(self, number: int, text: str, report: Callable[[float, str], None]) -> None:
        """Wait for a person, then tell how long that took and where it was answered."""
        began = time.monotonic()
        page = PageAnswers(
            self._link, lambda: self._sender.run, number, lambda: self._state.paused,
            headers=self._settings.robot_headers(),
        )  # fmt: skip
        where = self._operator.pause(text, no_news, page)
        if where:
            report(time.monotonic() - began, where)
            self._hear_decision(number)

    def _hear_decision(self, number: int) -> None:
        """A person may have put the verdict right meanwhile."""
        try:
            verdict = self._sender.verdict(number)
        except LinkError:
            return
        if verdict is not None and verdict.gate.traits.is_person:
            self._result.verdicts[number] = verdict
