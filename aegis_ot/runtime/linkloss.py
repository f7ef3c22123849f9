"""What a run does when its sidecar is away: ``on_link_loss``."""

from __future__ import annotations

from collections.abc import Callable

from ..errors import LinkError, RunAborted
from ..settings import Settings
from .courier import Courier
from .operator import Answer, Operator
from .summary import WatchSummary

_TRY_S = 0.1
"""How long one try to reach the sidecar may take while the operator is waited for, s."""

Attempt = Callable[[], None]


class LinkLoss:
    """The policy of one run.

    Args:
        courier: Speaks to the sidecar.
        settings: ``on_link_loss`` and ``capture_timeout_s`` count here.
        operator: Asked to mend it.
        simulating: In simulation nobody mends anything.
        result: Outages are counted here.
    """

    def __init__(
        self,
        courier: Courier,
        settings: Settings,
        operator: Operator,
        simulating: bool,
        result: WatchSummary,
    ) -> None:
        self._courier = courier
        self._settings = settings
        self._operator = operator
        self._simulating = simulating
        self._result = result

    def register(self) -> None:
        """Say which run this is; raises LinkError."""
        self._courier.register(self._settings.capture_timeout_s)

    def insist(self, attempt: Attempt) -> None:
        """Attempt; if that fails, do as the policy says. Returns when the run may go on.

        Raises:
            RunAborted: The policy, or the operator, ends the run.
        """
        trouble = _trouble_of(attempt)
        if trouble is None:
            return
        self._result.outages += 1
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
        self._courier.give_up()
        if not (policy == "pause" and self._simulating):
            self._operator.comment(
                f"{trouble} The run goes on unwatched until the sidecar is back."
            )

    def _is_back(self) -> Answer | None:
        trouble = _trouble_of(lambda: self._courier.register(_TRY_S))
        return Answer.RESUME if trouble is None else None


def _trouble_of(attempt: Attempt) -> LinkError | None:
    try:
        attempt()
    except LinkError as error:
        return error
    return None
