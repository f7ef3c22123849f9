"""A run beside its rehearsal: whether it does the same, and Layer 1's word where it does not."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .adapters.opentrons.instrumentation import Event, Operation
from .preflight.check_protocol import tell_finding
from .preflight.live_judging import LiveJudge
from .runtime import RunControl, about_layer1
from .settings import Settings
from .vocabulary import NOT_AS_REHEARSED, Finding

NOT_REHEARSED = "not rehearsed"


class FollowedRun:
    """A listener that hears of a run before whoever acts in it.

    Args:
        judge: Layer 1 of this run.
        hands: Act on what it finds.
        settings: ``rules`` counts here.
        why: Why there is no rehearsal to go by; ``""`` if there is one.
    """

    def __init__(
        self, judge: LiveJudge, hands: RunControl, settings: Settings, why: str = ""
    ) -> None:
        self._judge = judge
        self._hands = hands
        self._acts = settings.rules in ("on", "strict")
        self._why = why

    def before(self, operation: Operation) -> None:
        """Of :class:`.Listener`; raises what :class:`RunControl` does."""
        if self._acts and not self._hands.acting and self._hands.may_object:
            errors = self._judge.before(operation)
            if errors:
                self._hands.object_to(self._objection(errors))

    def after(self, operation: Operation) -> None:
        """Of :class:`.Listener`."""
        if not self._hands.acting and self._judge.done(operation):
            self._hands.tell_difference(self._difference())

    def event(self, event: Event) -> None:
        """Of :class:`.Listener`."""
        self._judge.event(event)

    def end(self, by_itself: bool) -> None:
        """The run is over."""
        told = bool(self._judge.difference)
        self._judge.ended(by_itself)
        if self._judge.difference and not told:
            self._hands.tell_difference(self._difference())

    def summary(self) -> str:
        """For the run log's last comment: ``""`` if what was said of the rehearsal holds."""
        if not self._judge.judges:
            return ""
        return f"Layer 1: {self._verdict()}. {self._difference()} {self._judge.summary()}"

    def words(self) -> dict[str, Any] | None:
        """For the sidecar's page, likewise."""
        if not self._judge.judges:
            return None
        note = f"{self._difference()} {self._judge.summary()}"
        return about_layer1(self._judge.report, self._verdict(), note)

    def _verdict(self) -> str:
        return NOT_AS_REHEARSED if self._judge.difference else NOT_REHEARSED

    def _difference(self) -> str:
        if self._judge.difference:
            return f"The run did otherwise than its rehearsal: {self._judge.difference}."
        return self._why

    def _objection(self, errors: Sequence[Finding]) -> str:
        said = self._difference() or "The next step is not as rehearsed."
        return f"{said} With the next step it breaks {' '.join(map(tell_finding, errors))}"
