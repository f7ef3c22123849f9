"""Runtime parameters: what a protocol declares, and the values that a rehearsal gives it.

Opentrons refuses a value without the name of its parameter; here the name is told, and what the
parameter takes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import AbstractContextManager
from copy import copy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ....errors import RehearsalError
from .refusals import in_words, line_of, stopped
from .script import Script

Limit = Callable[[], AbstractContextManager[None]]
"""Makes a ``with`` block that a protocol's code has to end in time."""

_KINDS = {"int": "a whole number", "float": "a number", "bool": "True or False", "str": "a text"}
_CSV = "csv_file"


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

    @property
    def takes(self) -> str:
        """What it may be set to, in words."""
        if self.choices and self.kind != "bool":
            return f"one of {', '.join(map(str, self.choices))}"
        kind = _KINDS.get(self.kind, self.kind)
        if self.low is None or self.high is None:
            return kind
        return f"{kind} from {self.low:g} to {self.high:g}"


def declared_parameters(protocol: Any, script: Script, limit: Limit) -> tuple[Parameter, ...]:
    """What a loaded script declares.

    Raises:
        RehearsalError: It raises meanwhile, or does not end in time.
    """
    context, _ = _executed(protocol, script, limit)
    return tuple(_declared(context).values())


def runtime_parameters(protocol: Any, script: Script, limit: Limit) -> Any:
    """The ``Parameters`` of a loaded script, with the script's values set; ``None`` without any.

    Raises:
        RehearsalError: A value is not accepted, or has no parameter; named.
    """
    context, parameters = _executed(protocol, script, limit)
    declared = _declared(context)
    given = (*script.parameters, *script.csv_parameters)
    unknown = [name for name in given if name not in declared]
    if unknown:
        raise RehearsalError(f"{script.file_name}: {undeclared(unknown, declared)}")
    if parameters is None:
        return None
    try:
        for name, value in script.parameters.items():
            _set(context, declared[name], value, is_file=False)
        for name, path in script.csv_parameters.items():
            _set(context, declared[name], Path(path), is_file=True)
    except RehearsalError as error:
        raise RehearsalError(f"{script.file_name}: {error}") from error.__cause__
    return context.export_parameters_for_protocol()


def undeclared(names: Iterable[str], declared: Iterable[str]) -> str:
    """That there are no parameters of these names, and which there are."""
    known = ", ".join(declared)
    told = f"there are {known}" if known else "the protocol declares none"
    return f"there is no parameter {' or '.join(names)}; {told}."


def lacking_files(context: Any) -> list[str]:
    """The CSV parameters of a run that have no file."""
    values = _all_values(getattr(context, "_params", None))
    return [name for name, value in values.items() if getattr(value, "_contents", b"") is None]


def plain_values(parameters: Any) -> dict[str, int | float | str]:
    """The numbers and texts among the values of a ``Parameters``, by name; ``{}`` for ``None``."""
    return {
        name: value
        for name, value in _all_values(parameters).items()
        if isinstance(value, (int, float, str)) and not isinstance(value, bool)
    }


def _all_values(parameters: Any) -> Mapping[str, Any]:
    return parameters.get_all() if parameters is not None else {}


def copied_parameters(live: Any) -> Any:
    """A copy of a live run's ``Parameters``; its CSV files are opened anew.

    A file that the rehearsal has read, or closed, would be empty for the run itself.
    """
    values = {name: copy(value) for name, value in live.get_all().items()}
    for value in values.values():
        if hasattr(value, "_file"):
            value._file = None
    return type(live)(values)


def _executed(protocol: Any, script: Script, limit: Limit) -> tuple[Any, Any]:
    """The context in which ``add_parameters`` was run, and its ``Parameters`` if there is any.

    Opentrons executes the whole text to find ``add_parameters``; that stands under ``limit``.
    """
    from opentrons.protocol_api._parameter_context import ParameterContext
    from opentrons.protocols.execution.execute_python import exec_add_parameters

    context = ParameterContext(api_version=protocol.api_level)
    try:
        with limit():
            return context, exec_add_parameters(protocol, context, None, None)
    except RehearsalError:
        raise
    except Exception as error:
        if "add_parameters" not in script.text:
            raise stopped(error, script.file_name) from error
        raised = error.__cause__ or error  # Opentrons wraps what the protocol raises
        raise RehearsalError(
            f"{script.file_name}: the runtime parameters cannot be read: {in_words(raised)}",
            line_of(error, script.file_name),
        ) from error


def _declared(context: Any) -> dict[str, Parameter]:
    return {
        declared.variableName: Parameter(
            name=declared.variableName,
            kind=str(declared.type),
            default=getattr(declared, "default", None),
            choices=tuple(choice.value for choice in getattr(declared, "choices", None) or ()),
            low=getattr(declared, "min", None),
            high=getattr(declared, "max", None),
        )
        for declared in context.export_parameters_for_analysis()
    }


def _set(context: Any, parameter: Parameter, value: Any, is_file: bool) -> None:
    name, takes_file = parameter.name, parameter.kind == _CSV
    if takes_file and not is_file:
        raise RehearsalError(f"the CSV parameter {name} needs a file, not a value.")
    if is_file and not takes_file:
        raise RehearsalError(f"the runtime parameter {name} takes {parameter.takes}, no CSV file.")
    try:
        (context.initialize_csv_files if is_file else context.set_parameters)({name: value})
    except Exception as error:
        told = f"the runtime parameter {name} cannot be {value!r}; it takes {parameter.takes}."
        if is_file:
            told = f"the CSV parameter {name} cannot be {value}: {in_words(error)}"
        raise RehearsalError(told) from error
