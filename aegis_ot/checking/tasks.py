"""What a rehearsing process can be asked to do. Each task is sent to it and performed there."""

from __future__ import annotations

import contextlib
import functools
import time
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from ..errors import AegisError
from ..preflight import (
    Database,
    Options,
    Reading,
    Report,
    check_script,
    judge,
    load_database,
    record,
)
from ..preflight.opinion import check_with_dossier
from ..preflight.rehearsal import (
    Parameter,
    Recording,
    Script,
    declared_parameters,
    interrupted_after,
    load,
)
from ..vocabulary import Dossier
from .rule_examples import ExampleResult, run_examples
from .surroundings import standing_in_place

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


@dataclass(frozen=True)
class _OfProtocol:
    """What it takes to judge a protocol."""

    script: Script
    options: Options
    rules: RulePaths
    timeout_s: float

    @property
    def file_name(self) -> str:
        """The protocol's."""
        return self.script.file_name


@dataclass(frozen=True)
class Check(_OfProtocol):
    """Rehearse a protocol and judge it."""

    def perform(self) -> Report:
        """Judge."""
        with standing_in_place(self.script):
            return check_script(self.script, _database(self.rules), self.options, self.timeout_s)


@dataclass(frozen=True)
class Timed:
    """A report, what it took to come to it, s, and the modules that lay around the protocol."""

    report: Report
    rehearsal_s: float
    verdict_s: float
    modules: tuple[str, ...] = ()


@dataclass(frozen=True)
class TimedCheck(_OfProtocol):
    """Rehearse a protocol and judge it, by the clock."""

    def perform(self) -> Timed:
        """Judge."""
        start = time.perf_counter()
        with standing_in_place(self.script) as modules:
            recording = record(self.script, timeout_s=self.timeout_s)
        recorded = time.perf_counter()
        report = judge(Reading(recording, _database(self.rules), self.options))
        seconds = time.perf_counter() - recorded
        return Timed(report, recorded - start, seconds, tuple(modules))


@dataclass(frozen=True)
class Examined:
    """A report, what a model should know of the protocol, and what both were made from."""

    report: Report
    dossier: Dossier
    recording: Recording
    modules: tuple[str, ...] = ()


@dataclass(frozen=True)
class CheckWithDossier(_OfProtocol):
    """Rehearse a protocol, judge it, and put together what a model should know of it."""

    def perform(self) -> Examined:
        """Judge."""
        with standing_in_place(self.script) as modules:
            report, dossier, reading = check_with_dossier(
                self.script, _database(self.rules), self.options, self.timeout_s
            )
        return Examined(report, dossier, reading.recording, tuple(modules))


@dataclass(frozen=True)
class Describe:
    """List the runtime parameters that a protocol declares."""

    script: Script
    timeout_s: float

    @property
    def file_name(self) -> str:
        """The protocol's."""
        return self.script.file_name

    def perform(self) -> tuple[Parameter, ...]:
        """Run ``add_parameters`` and read what it declared."""
        limit = functools.partial(interrupted_after, self.timeout_s, self.script.file_name)
        with standing_in_place(self.script):
            return declared_parameters(load(self.script), self.script, limit)


@dataclass(frozen=True)
class RunExamples:
    """Run the examples of one rule."""

    rule: str
    rules: RulePaths
    timeout_s: float
    file_name: str = "example.py"

    def perform(self) -> list[ExampleResult]:
        """Run them."""
        with interrupted_after(self.timeout_s, self.file_name):
            return run_examples(_database(self.rules), [self.rule])


@functools.cache
def _database(rules: RulePaths) -> Database:
    return load_database(rules)


def prepare(rules: RulePaths) -> None:
    """Load ahead of the first task what every task needs."""
    import opentrons.hardware_control
    import opentrons.protocol_api._parameter_context
    import opentrons.protocol_api.core.engine
    import opentrons.protocol_engine.create_protocol_engine
    import opentrons.protocols.execution.execute_python
    import opentrons.protocols.parse  # noqa: F401

    with contextlib.suppress(AegisError):  # told by the first task that needs it
        _database(rules)
