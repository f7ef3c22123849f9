"""What a rehearsing process can be asked to do. Each task is sent to it and performed there."""

from __future__ import annotations

import contextlib
import functools
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from ..errors import AegisError, RehearsalError
from ..preflight import Database, Options, Report, check_script, load_database
from ..preflight.dossier import Dossier
from ..preflight.dossier_making import check_with_dossier
from ..preflight.examples import ExampleResult, run_examples
from ..preflight.rehearsal import Script, in_words, interrupted_after, line_of, load

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
        return check_script(self.script, _database(self.rules), self.options, self.timeout_s)


@dataclass(frozen=True)
class CheckWithDossier(_OfProtocol):
    """Rehearse a protocol, judge it, and put together what a model should know of it."""

    def perform(self) -> tuple[Report, Dossier]:
        """Judge."""
        return check_with_dossier(self.script, _database(self.rules), self.options, self.timeout_s)


@dataclass(frozen=True)
class Parameter:
    """A runtime parameter as a protocol declares it.

    Attributes:
        name: Variable name.
        kind: ``int``, ``float``, ``bool``, ``str`` or ``csv_file``.
        default: Its default, ``None`` for a file.
        choices: The values it may have, empty for none declared.
        low: Smallest value, where bounds are declared.
        high: Largest value.
    """

    name: str
    kind: str
    default: Any = None
    choices: tuple[Any, ...] = ()
    low: float | None = None
    high: float | None = None


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
        from opentrons.protocol_api._parameter_context import ParameterContext
        from opentrons.protocols.execution.execute_python import exec_add_parameters

        protocol = load(self.script)
        context = ParameterContext(api_version=protocol.api_level)
        try:
            with interrupted_after(self.timeout_s, self.script.file_name):
                exec_add_parameters(protocol, context, None, None)
        except RehearsalError:
            raise
        except Exception as error:
            raise RehearsalError(
                f"add_parameters: {in_words(error)}", line_of(error, self.script.file_name)
            ) from error
        return tuple(_parameter(item) for item in context.export_parameters_for_analysis())


def _parameter(declared: Any) -> Parameter:
    choices = getattr(declared, "choices", None) or ()
    return Parameter(
        name=declared.variableName,
        kind=str(declared.type),
        default=getattr(declared, "default", None),
        choices=tuple(choice.value for choice in choices),
        low=getattr(declared, "min", None),
        high=getattr(declared, "max", None),
    )


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
