"""What a run does when its sidecar is away: ``on_link_loss``."""

from __future__ import annotations

import time
from collections.abc import Callable

from ..adapters.opentrons.run_state import RunState
from ..errors import LinkError, RunAborted
from ..settings import Settings
from .cancellation import CancellationToken
from .keyframe_sender import KeyframeSender
from .operator import Operator, OperatorAnswer, no_news
from .page_answers import Announce, PageAnswers
from .sidecar_client import CameraSilent, SidecarBusy
from .summary import WatchSummary

_TRY_S = 0.1
"""How long one try to reach the sidecar may take while the operator is waited for, s."""
_LOOK_S = 0.5
_CALM = 4
"""After so many answers at the first try, a well's keyframes, an incident is over."""

_WHY: dict[type[LinkError], str] = {CameraSilent: "camera", SidecarBusy: "busy"}
"""What the sidecar is told of why the robot is paused; ``"link"`` for all else."""

Attempt = Callable[[], None]


class DeliveryPolicy:
    """The policy of one run.

    Args:
        sender: Speaks to the sidecar.
        settings: ``on_link_loss`` and ``capture_timeout_s`` count here.
        operator: Asked to mend it.
        state, waits: Of the run.
        simulating: In simulation nobody mends anything.
        result: Outages are counted here.
        page: Asks the sidecar's page about a pause at a trajectory, and tells of it.

    Attributes:
        obey: Does at a trajectory what a person told the robot meanwhile; for how long it was
            paused by that, s.
    """

    def __init__(
        self,
        sender: KeyframeSender,
        settings: Settings,
        operator: Operator,
        state: RunState,
        waits: CancellationToken,
        simulating: bool,
        result: WatchSummary,
        page: Callable[[int, Announce], PageAnswers],
    ) -> None:
        self._page = page
        self.obey: Callable[[int], float] = lambda number: 0.0
        self._sender = sender
        self._settings = settings
        self._operator = operator
        self._state = state
        self._waits = waits
        self._simulating = simulating
        self._result = result
        self._told = self._troubled = False
        self._calm = 0
        sender.retrying.on_trouble = self._tell

    def register(self) -> None:
        """Say which run this is; raises LinkError."""
        self._sender.register(self._settings.capture_timeout_s)

    def insist(self, attempt: Attempt, number: int = 0) -> None:
        """Attempt; if that fails, do as the policy says. Returns when the run may go on.

        Raises:
            RunAborted: The policy, or the operator, ends the run.
        """
        self._troubled = False
        trouble = self._outlast_pause(attempt, _trouble_of(attempt))
        if trouble is not None and self.obey(number):
            trouble = _trouble_of(attempt)
        if trouble is None:
            # What follows soon belongs to the same incident, which is told once: a sidecar that
            # takes seconds for each keyframe would fill the run log.
            self._calm = 0 if self._troubled else self._calm + 1
            self._told = self._told and self._calm < _CALM
            return
        self._result.outages += 1
        policy = self._settings.on_link_loss
        if policy == "abort":
            raise RunAborted(f"{trouble} The run ends here, as configured.") from trouble
        if policy == "pause":
            trouble = self._pause(trouble, number, attempt)
            if trouble is None:
                return
        self._sender.give_up()
        if not (policy == "pause" and self._simulating):
            self._operator.comment(
                f"{trouble} The run goes on unwatched until the sidecar is back."
            )

    def _pause(self, trouble: LinkError, number: int, attempt: Attempt) -> LinkError | None:
        """Have a person mend it, on the page too as far as it can be reached; what is still wrong
        then."""
        why = next((why for kind, why in _WHY.items() if isinstance(trouble, kind)), "link")
        began = time.monotonic()
        announce, answered = self._sender.begin_pause(number, why)
        where = self._operator.pause(
            f"{trouble} Resume to try again; if it fails again, the run goes on unwatched until "
            "it works. Or cancel the run.",
            # A sidecar that is there again mends itself, a camera does not.
            self._is_back if why == "link" else no_news,
            self._page(number, announce),
        )
        if self._simulating:
            return trouble
        paused_s = time.monotonic() - began
        left = _trouble_of(attempt)
        if left is not None:
            self._sender.give_up()  # what is to be said waits until it is back
        answered(paused_s, where)
        return left

    def _tell(self, trouble: LinkError, seconds_left: float) -> None:
        """Say at once why the robot stands still, not only when it has been tried for long."""
        self._troubled = True
        # A comment would wait behind an operator's pause, and with it the next try.
        if self._told or self._simulating or self._state.paused:
            return
        self._told = True
        self._operator.comment(
            f"{trouble} Trying again for {seconds_left:.0f} s; the run goes on when it answers."
        )

    def _outlast_pause(self, attempt: Attempt, trouble: LinkError | None) -> LinkError | None:
        """An operator who has paused the run meanwhile resumes once, not twice: the guard's own
        pause would wait behind that one."""
        while trouble is not None and self._state.paused:
            while self._state.paused and self._is_back() is None:
                self._waits.rest(_LOOK_S)
            trouble = _trouble_of(attempt)
            if self._sender.ordered:
                break
        return trouble

    def _is_back(self) -> OperatorAnswer | None:
        trouble = _trouble_of(lambda: self._sender.register(_TRY_S))
        return OperatorAnswer.RESUME if trouble is None else None


def _trouble_of(attempt: Attempt) -> LinkError | None:
    try:
        attempt()
    except LinkError as error:
        return error
    return None
