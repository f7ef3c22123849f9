"""Layer 1 beside a run that does otherwise than its rehearsal, or that had none.

As long as a run does what was rehearsed, what was said of the rehearsal holds. From its first
other move on, what it has done and is about to do is judged as it comes.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ..adapters.opentrons.instrumentation import (
    Event,
    EventKind,
    LabwareInfo,
    NameBinding,
    Operation,
    OperationKind,
)
from ..adapters.opentrons.rehearsal import Comparison, Record, Recorder, Recording, RunPlan
from ..errors import AegisError
from ..settings import Settings
from ..vocabulary import Finding
from .check_protocol import counts_of, errors_of
from .judging import Interpretation, Options, Report, judge, uncollected
from .rule_set import RuleSet, load_rules

GUARD = "aegis_ot: "
"""How the guard's own comments and pauses begin."""

_FREE_S = 5.0
"""So long judging may take in all before it has to keep to its share of the run, s."""
_SHARE = 0.1
_ENTERS = (
    OperationKind.ASPIRATE, OperationKind.DISPENSE, OperationKind.BLOW_OUT, OperationKind.TOUCH_TIP
)  # fmt: skip


@dataclass(frozen=True)
class RunKnowledge:
    """What is known of a run beside its operations; asked when it is judged.

    Attributes:
        file, text: The protocol.
        names: Names that hold wells by now.
        labware: By key.
        parameters: The values of its runtime parameters.
    """

    file: str
    text: str
    names: Callable[[], Sequence[NameBinding]]
    labware: Callable[[], Mapping[str, LabwareInfo]]
    parameters: Mapping[str, Any]


class LiveJudge:
    """Layer 1 of one run, while it runs.

    Args:
        settings: As for the rehearsal.
        surroundings: Of the run.
        recorder: Hears all that it does, before this judge is asked.
        rehearsal: Of the same protocol, with its ``plan``; ``None``: all is judged as it comes.

    Attributes:
        report: What the whole run came to, once it has ended and if it was judged.
        failure: Why it could not be judged.
    """

    def __init__(
        self,
        settings: Settings,
        surroundings: RunKnowledge,
        recorder: Recorder,
        rehearsal: Recording | None,
        plan: RunPlan | None,
    ) -> None:
        self._settings = settings
        self._around = surroundings
        self._recorder = recorder
        self._rehearsal = rehearsal
        self._head = plan.head if plan else 0
        self._plans = plan is not None and bool(plan.steps)
        self._comparison = None if plan is None else Comparison(plan.steps)
        self._told: set[tuple[str, tuple[int, ...]]] = set()
        self._spent_s = self._last_s = 0.0
        self._rested_at = 0.0
        self.report: Report | None = None
        self.failure = ""

    @cached_property
    def _rule_set(self) -> RuleSet:
        path = self._settings.rules_path
        return load_rules([path] if path else [])

    @property
    def difference(self) -> str:
        """What the run does otherwise than its rehearsal; ``""`` if nothing, or without one."""
        return self._comparison.difference if self._comparison else ""

    @property
    def judges(self) -> bool:
        """Whether what is done now was never judged before."""
        return self._comparison is None or bool(self._comparison.difference)

    def before(self, operation: Operation) -> list[Finding]:
        """Errors that this would be the first to make, each told once."""
        if self._comparison is not None and self._comparison.fits(operation):
            return []
        if operation.kind not in _ENTERS or operation.mixing or operation.well is None:
            return []
        began = time.monotonic()
        rest_s = self._last_s * (1 / _SHARE - 1) if self._spent_s > _FREE_S else 0.0
        if began < self._rested_at + rest_s:
            return []
        found = self._errors_so_far(operation)
        self._rested_at = time.monotonic()
        self._last_s = self._rested_at - began
        self._spent_s += self._last_s
        fresh = [one for one in found if (one.rule, one.lines) not in self._told]
        self._told.update((one.rule, one.lines) for one in fresh)
        return fresh

    def done(self, operation: Operation) -> bool:
        """Take in what was done; whether it is the first that the rehearsal did not do."""
        return self._comparison is not None and self._comparison.done(operation)

    def event(self, event: Event) -> None:
        """Take in what happened beside."""
        if self._comparison is not None:
            self._comparison.event(event)

    def ended(self, by_itself: bool) -> None:
        """The run is over: judge what it did as a whole, where nobody has yet.

        Not where it was stopped or failed: what it left undone says nothing, and nobody waits.
        """
        if not by_itself:
            self.failure = "the run did not come to its end"
            return
        if self._comparison is not None:
            self._comparison.ended()
        if self.judges and any(isinstance(one, Operation) for one in self._recorder.log):
            self.report = self._judged(self._log(), self._around.labware(), so_far=False)

    def summary(self) -> str:
        """What there is to say at the end; ``""`` if the rehearsal has said it all."""
        if not self.judges:
            return ""
        if self.report is None:
            why = self.failure or "it moved no liquid"
            return f"What was run was not judged as a whole: {why}."
        return f"What was run, judged as it ran: {counts_of(self.report)}."

    def _errors_so_far(self, operation: Operation) -> list[Finding]:
        log = [*self._log(), operation.detached()]
        now = self._around.labware()
        report = self._judged(log, now, so_far=True)
        errors = errors_of(report) if report else []
        # What looks wrong now may be what the protocol is about: pooling, say. The rest of the plan
        # shows it; without one, such rules wait for the end.
        if self._rehearsal is None or not self._plans or not self._knows_its_labware():
            return [one for one in errors if not self._may_be_meant(one.rule)]
        if errors:
            log += self._rehearsal.log[self._head :]
            whole = self._judged(log, {**self._rehearsal.labware, **now}, so_far=True)
            still = {(one.rule, one.lines) for one in errors_of(whole)} if whole else set()
            errors = [one for one in errors if (one.rule, one.lines) in still]
        return errors

    def _may_be_meant(self, rule: str) -> bool:
        return any(check.get("pooled") for check in self._rule_set.rule(rule)[1].checks)

    def _log(self) -> list[Record]:
        """All that was done, from before the guard began on."""
        heard = [one for one in self._recorder.log if not _is_guards_own(one)]
        if self._rehearsal is None or not self._head or not self._knows_its_labware():
            return heard
        head = self._rehearsal.log[: self._head]
        known = {_loaded_by(one) for one in head} - {""}
        return [*head, *(one for one in heard if _loaded_by(one) not in known)]

    def _knows_its_labware(self) -> bool:
        """Whether the labware of the rehearsal has the same keys in the run, as far as it goes."""
        assert self._rehearsal is not None
        known = self._rehearsal.labware
        return all(
            (known[key].load_name, known[key].label) == (info.load_name, info.label)
            for key, info in self._around.labware().items()
            if key in known
        )

    def _judged(
        self, log: Sequence[Record], labware: Mapping[str, LabwareInfo], so_far: bool
    ) -> Report | None:
        around = self._around
        recording = Recording(
            around.text, around.file, log, dict(labware), around.names(), around.parameters
        )
        try:
            with uncollected():
                reading = Interpretation(
                    recording, self._rule_set, Options.from_settings(self._settings)
                )
                return judge(reading, so_far=so_far)
        except AegisError:
            raise
        except Exception as error:  # a fault of ours must not end a run that is under way
            self.failure = f"Layer 1 failed ({type(error).__name__}: {error})"
            return None


def _is_guards_own(one: Record) -> bool:
    return isinstance(one, Event) and one.text.startswith(GUARD)


def _loaded_by(one: Record) -> str:
    """Key of the labware that a record loads, or ``""``."""
    if isinstance(one, Event) and one.kind is EventKind.LABWARE_LOADED:
        return one.labware
    return ""
