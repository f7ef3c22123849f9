"""What a rehearsing process can be asked to do. Each task is sent to it and performed there."""

from __future__ import annotations

import contextlib
import functools
import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

from ..adapters.opentrons.rehearsal import Parameter, Script
from ..errors import AegisError
from ..preflight import Options, Report, RuleSet, load_rules
from ..vocabulary import Dossier
from .surroundings import standing_in_place

if TYPE_CHECKING:
    from ..adapters.opentrons.rehearsal import Recording
    from ..preflight import Interpretation
    from .rule_examples import ExampleResult

# What performs a task is loaded where it is performed: whoever sends it has no use for that.

RulePaths = tuple[str, ...]


@runtime_checkable
class Task(Protocol):
    """Something to be done in the rehearsing process."""

    @property
    def file_name(self) -> str:
        """Name of the file whose lines tell where it stands."""

    @property
    def timeout_s(self) -> float:
        """Longest time that it may take, s."""

    def perform(self) -> Any:
        """Do it; the result is sent back."""


class OfScript:
    """A task that a protocol's script is needed for."""

    script: Script

    @property
    def file_name(self) -> str:
        """The protocol's."""
        return self.script.file_name


@dataclass(frozen=True)
class Examined:
    """What came of checking a protocol.

    Attributes:
        report: The verdict.
        rehearsal_s: Time of the rehearsal, s.
        verdict_s: Time from the recording to the verdict, s.
        modules: Those around the protocol that its rehearsal imported.
        playback: The run as a page plays it, where that was asked for.
        for_model: What a model should know of it and the recording, where that was asked for.
    """

    report: Report
    rehearsal_s: float
    verdict_s: float
    modules: tuple[str, ...] = ()
    playback: Mapping[str, Any] | None = None
    for_model: tuple[Dossier, Recording] | None = None


@dataclass(frozen=True)
class CheckTask(OfScript):
    """Rehearse a protocol and judge it, by the clock."""

    script: Script
    options: Options
    rules: RulePaths
    timeout_s: float
    playback: bool = False
    for_model: bool = False

    def perform(self) -> Examined:
        """Judge."""
        from ..preflight import Interpretation, judge, record
        from ..preflight.opinion import make_dossier

        start = time.perf_counter()
        with standing_in_place(self.script) as modules:
            recording = record(self.script, timeout_s=self.timeout_s)
        recorded = time.perf_counter()
        reading = Interpretation(recording, _rule_set(self.rules), self.options)
        report = judge(reading)
        seconds = time.perf_counter() - recorded
        return Examined(
            report,
            recorded - start,
            seconds,
            tuple(modules),
            _played(reading, report) if self.playback else None,
            (make_dossier(reading, report), recording) if self.for_model else None,
        )


@dataclass(frozen=True)
class Describe(OfScript):
    """List the runtime parameters that a protocol declares."""

    script: Script
    timeout_s: float

    def perform(self) -> tuple[Parameter, ...]:
        """Run ``add_parameters`` and read what it declared."""
        from ..adapters.opentrons.rehearsal import declared_parameters, interrupted_after, load

        limit = functools.partial(interrupted_after, self.timeout_s, self.script.file_name)
        with standing_in_place(self.script):
            return declared_parameters(load(self.script), self.script, limit)


@dataclass(frozen=True)
class RecordTask(OfScript):
    """Rehearse a protocol, and judge nothing."""

    script: Script
    timeout_s: float

    def perform(self) -> Recording:
        """Rehearse."""
        from ..adapters.opentrons.rehearsal import record

        with standing_in_place(self.script):
            return record(self.script, timeout_s=self.timeout_s)


@dataclass(frozen=True)
class RunExamples:
    """Run the examples of one rule."""

    rule: str
    rules: RulePaths
    timeout_s: float
    file_name: str = "example.py"

    def perform(self) -> list[ExampleResult]:
        """Run them."""
        from ..adapters.opentrons.rehearsal import interrupted_after
        from .rule_examples import run_examples

        with interrupted_after(self.timeout_s, self.file_name):
            return run_examples(_rule_set(self.rules), [self.rule])


def _played(reading: Interpretation, report: Report) -> Mapping[str, Any]:
    from .playback import playback_of

    return playback_of(reading, report)


@functools.cache
def _rule_set(rules: RulePaths) -> RuleSet:
    return load_rules(rules)


def prepare(rules: RulePaths) -> None:
    """Load ahead of the first task what every task needs."""
    import opentrons.hardware_control
    import opentrons.protocol_api._parameter_context
    import opentrons.protocol_api.core.engine
    import opentrons.protocol_engine.create_protocol_engine
    import opentrons.protocols.execution.execute_python
    import opentrons.protocols.parse  # noqa: F401

    from ..preflight import check_script, judge, opinion, record  # noqa: F401

    with contextlib.suppress(AegisError):  # told by the first task that needs it
        _rule_set(rules).prepare()  # once, and not in each fork: half of a short verdict
