"""A boundary: wait for verdicts, and do as the policy says where one is bad or missing."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import NoReturn

from ..errors import LinkError, RunAborted
from ..http_client import SLICE_S, CheckStop
from ..instrumentation import Operation
from ..settings import Settings
from ..vocabulary import Gate, Outcome, Verdict, one_line, unobserved
from .courier import Courier
from .descriptions import tell_unobserved, tell_verdict
from .link import SidecarLink
from .linkloss import LinkLoss
from .operator import LONGEST, Operator, no_news
from .page_answers import PageAnswers, act_on_current_run
from .recovering import Recovery
from .runstate import RunState, can_be_resumed
from .steps import Hold
from .stopping import Waits
from .summary import WatchSummary

_STOP_S = 5.0
"""How long the robot's server may take to stop the run that it was told to stop, s."""


_STRICTNESS = (None, "continue", "pause", "abort")


class Holding:
    """The holds of one run.

    Args:
        courier: Speaks to the sidecar.
        link_loss: What to do when it cannot.
        settings: Time limits and policies.
        operator: Told of bad verdicts.
        state, waits: Of the run.
        result: Holds and verdicts are counted here.
        link: Makes a further connection to the sidecar.
        recovery: Puts failed wells right where it may; asked before the policies.
    """

    def __init__(
        self,
        courier: Courier,
        link_loss: LinkLoss,
        settings: Settings,
        operator: Operator,
        state: RunState,
        waits: Waits,
        result: WatchSummary,
        link: Callable[[CheckStop], SidecarLink],
        recovery: Recovery | None = None,
    ) -> None:
        self._recovery = recovery
        self._link = link
        self._courier = courier
        self._link_loss = link_loss
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
        courier = self._courier
        while True:
            if number in courier.forgotten:
                return None, "lost by the sidecar"
            if number in courier.stale:
                return None, "late keyframes"
            if courier.away:
                return None, "link lost"
            self._waits.check()
            asked = time.monotonic()
            verdict = None
            try:
                verdict = courier.verdict(number)
                deadline += self.obey(number)
            except LinkError:
                # The same patience as for a keyframe.
                self._link_loss.insist(self._link_loss.register, number)
            if verdict is not None:
                return verdict, "verdict"
            if time.monotonic() - asked < SLICE_S / 2:
                self._waits.rest(SLICE_S / 5)  # it answered at once: do not hammer it
            if self._state.paused:
                deadline += time.monotonic() - asked  # an operator's pause is nobody's delay
            if time.monotonic() >= deadline:
                return None, "timeout"

    def _resolve(
        self,
        step: Hold,
        number: int,
        verdict: Verdict | None,
        ended_by: str,
        seconds: float,
        boundary: Operation | None,
    ) -> None:
        settings = self._settings
        policy: str | None = None
        place = self._result.places.get(number) or f"trajectory {number}"
        if verdict is None:
            self._result.lost[number] = ended_by
            # For late keyframes and a lost link the policy was asked when it happened.
            text = f"No verdict on {place} within {settings.verdict_timeout_s:g} s."
            if ended_by == "lost by the sidecar":
                text = f"No verdict on {place}: the sidecar lost its keyframes."
            if ended_by in ("timeout", "lost by the sidecar"):
                policy = settings.on_link_loss
        else:
            hidden = unobserved([verdict])
            if hidden and not unobserved(self._result.verdicts.values()):
                self._operator.comment(tell_unobserved(hidden))
            self._result.verdicts[number] = verdict
            text = tell_verdict(place, verdict)
            if verdict.outcome is Outcome.FAIL:
                policy = settings.on_fail
            elif verdict.outcome is Outcome.UNDECIDED:
                policy = settings.on_undecided
        refused: str | None = ""
        if self._recovery is not None:
            refused = self._recovery.judged(number, verdict, boundary)
        passed = verdict is not None and verdict.outcome is Outcome.PASS
        if not passed and number in self._result.attempts:
            # The well is known to have failed, and was not seen to be put right.
            policy = max(policy, settings.on_fail, key=_STRICTNESS.index)
        if step.final and settings.hold == "off":
            policy = "continue" if policy else None  # too late to change anything
        if refused is None:
            policy = "recover"
        elif refused:
            text = f"{text} {refused}"
        text = one_line(text, LONGEST)
        answered = self._courier.report_hold(number, seconds, ended_by, policy)
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

    def obey(self, number: int) -> float:
        """Do what a person told the moving robot on the sidecar's page, if anybody did.

        Args:
            number: Trajectory at which the robot hears of it.

        Returns:
            For how long it was paused, s.

        Raises:
            RunAborted, Stopping: The person ends the run.
        """
        order = self._courier.order()
        if order is None:
            return 0.0
        if order.action == "stop":
            self._end(f"{order.by} ended the run on the sidecar's page.")
        began = time.monotonic()
        answered = self._courier.report_hold(number, 0.0, "operator", "pause")
        self._pause(
            number,
            f"{order.by} paused the run on the sidecar's page. Resume to go on, or cancel the run.",
            answered,
        )
        return time.monotonic() - began

    def pause(self, number: int, text: str) -> None:
        """Layer 1 has found an error in what comes next: wait for a person, on the page too.

        Args:
            number: Trajectory at which the robot stands.
            text: What there is to say.

        Raises:
            RunAborted, Stopping: The person ends the run.
        """
        self._pause(number, text, self._courier.report_hold(number, 0.0, "layer1", "pause"))

    def _end(self, text: str) -> NoReturn:
        """Stop as the App's button does; where nobody can, by an error."""
        if can_be_resumed() and act_on_current_run("stop"):
            self._waits.rest(_STOP_S)
        raise RunAborted(text)

    def _pause(self, number: int, text: str, report: Callable[[float, str], None]) -> None:
        """Wait for a person, then tell how long that took and where it was answered."""
        began = time.monotonic()
        page = PageAnswers(
            self._link, lambda: self._courier.run, number, lambda: self._state.paused
        )
        where = self._operator.pause(text, no_news, page)
        if where:
            report(time.monotonic() - began, where)
            self._hear_decision(number)

    def _hear_decision(self, number: int) -> None:
        """A person may have put the verdict right meanwhile."""
        try:
            verdict = self._courier.verdict(number)
        except LinkError:
            return
        if verdict is not None and verdict.gate is Gate.OPERATOR:
            self._result.verdicts[number] = verdict
