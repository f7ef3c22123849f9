"""What the guard does about an error that Layer 1 finds while the run is under way."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from ..adapters.opentrons.instrumentation import Event, Operation
from ..adapters.opentrons.run_refusal import refuse_everything
from ..adapters.opentrons.run_state import RunState
from ..errors import RunAborted
from ..settings import Settings
from .cancellation import CancellationToken, Stopping
from .operator import Operator, no_news


class RunControl(Protocol):
    """What Layer 1 needs of whoever stands between it and a run."""

    @property
    def acting(self) -> bool:
        """Whether what moves now is the guard's own doing."""

    @property
    def may_object(self) -> bool:
        """Whether the guard can get a word in before the operation that is told just now."""

    def object_to(self, text: str) -> None:
        """What the protocol does next breaks a rule: do as ``on_fail`` says."""

    def tell_difference(self, text: str) -> None:
        """The run does otherwise than its rehearsal."""


def object_to(
    text: str, settings: Settings, operator: Operator, on_page: Callable[[str], None] | None = None
) -> None:
    """Pause, go on or end the run, as ``on_fail`` says.

    Args:
        text: What is about to be done, and which rule it breaks.
        settings: In force.
        operator: Asked, or told.
        on_page: Pauses in a way that the sidecar's page can answer, where there is one.

    Raises:
        RunAborted: The policy, or the operator, ends the run.
        Exception: Whatever Opentrons raises when the run is cancelled during its pause.
    """
    if settings.on_fail == "continue":
        operator.comment(f"{text} The run goes on, as configured.")
        return
    if settings.on_fail == "abort":
        raise RunAborted(f"{text} The run ends here, as configured.")
    paused = f"{text} Paused before that. Resume to do it all the same, or cancel the run."
    if on_page is not None:
        on_page(paused)
    elif not operator.can_be_answered:
        raise RunAborted(
            f"{text} The run ends here: nobody can answer a pause in this program "
            '(on_fail="continue" lets it go on).'
        )
    else:
        operator.pause(paused, no_news)


class Bystander:
    """Stands in for the watcher where no sidecar is configured. A listener.

    Args:
        protocol: The context of the run.
        settings: ``on_fail`` counts here.
        file_name: ``co_filename`` of the protocol's code.
    """

    acting = False

    def __init__(self, protocol: Any, settings: Settings, file_name: str) -> None:
        self._protocol = protocol
        self._settings = settings
        self._file_name = file_name
        self._begun = False
        simulating = bool(protocol.is_simulating())
        self._operator = Operator(protocol, simulating, CancellationToken(RunState(protocol)).rest)

    @property
    def may_object(self) -> bool:
        """Of :class:`RunControl`."""
        return self._begun or not self._operator.is_legacy

    def begin(self) -> None:
        """From the next operation on there may be something to say. Idempotent."""
        if not self._begun:
            self._begun = True
            self._operator.begin()

    def end(self) -> None:
        """The run is over. Idempotent."""
        self._operator.end()

    def before(self, operation: Operation) -> None:
        """Of :class:`.Listener`: nothing more is to be said."""
        self._operator.proceed()

    def after(self, operation: Operation) -> None:
        """Likewise."""
        self._operator.proceed()

    def event(self, event: Event) -> None:
        """Likewise; the guard's own pause is no event."""
        if not self._operator.busy:
            self._operator.proceed()

    def object_to(self, text: str) -> None:
        """Of :class:`RunControl`; raises as :func:`object_to`."""
        try:
            object_to(text, self._settings, self._operator)
        except Stopping:
            pass  # the next command raises what Opentrons raises then
        except RunAborted as error:
            refuse_everything(self._protocol, error, self._file_name)
            raise

    def tell_difference(self, text: str) -> None:
        """Of :class:`RunControl`. The run log has its word at the end only, where the analysis
        has one too: the Opentrons App compares the commands of both."""
        self.begin()
