"""Loads a script as Opentrons does, and sets its runtime parameters."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from copy import copy
from typing import Any

from ...errors import RehearsalError
from .refusals import line_of, stopped, too_deep, too_new, unloadable
from .script import Script

Limit = Callable[[], AbstractContextManager[None]]
"""Makes a ``with`` block that a protocol's code has to end in time."""


def load(script: Script) -> Any:
    """The ``PythonProtocol`` that Opentrons makes of a script.

    Raises:
        RehearsalError: It cannot be parsed; with its line.
    """
    from opentrons.protocols.api_support.definitions import MAX_SUPPORTED_VERSION
    from opentrons.protocols.parse import parse
    from opentrons.protocols.types import PythonProtocol

    try:
        compile(script.text, script.file_name, "exec", dont_inherit=True)
    except (SyntaxError, ValueError) as error:
        line = getattr(error, "lineno", None)
        reason = getattr(error, "msg", None) or str(error)
        where = f"{script.file_name}, line {line}" if line else script.file_name
        raise RehearsalError(f"{where}: not valid Python: {reason}", line) from error
    except (RecursionError, MemoryError) as error:
        raise too_deep(script) from error
    try:
        protocol = parse(
            script.text,
            script.file_name,
            extra_labware=dict(script.extra_labware),
            extra_data=dict(script.data_files),
        )
    except (RecursionError, MemoryError) as error:
        raise too_deep(script) from error
    except Exception as error:  # opentrons raises its own zoo, and plain RuntimeErrors
        raise unloadable(error, script) from error
    if not isinstance(protocol, PythonProtocol):
        raise RehearsalError(
            f"{script.file_name} is a JSON protocol; only Python protocols can be rehearsed."
        )
    if protocol.api_level > MAX_SUPPORTED_VERSION:
        raise too_new(script, protocol.api_level, MAX_SUPPORTED_VERSION)
    return protocol


def runtime_parameters(protocol: Any, script: Script, limit: Limit) -> Any:
    """The ``Parameters`` of a loaded script, with the script's values set; ``None`` without any.

    Opentrons executes the whole text to find ``add_parameters``; that stands under ``limit``.

    Raises:
        RehearsalError: A value is not accepted.
    """
    from opentrons.protocol_api._parameter_context import ParameterContext
    from opentrons.protocols.execution.execute_python import exec_add_parameters

    known = dict(script.parameters)
    context = ParameterContext(api_version=protocol.api_level)
    files = dict(script.csv_parameters)
    try:
        with limit():
            return exec_add_parameters(protocol, context, known or None, files or None)
    except RehearsalError:
        raise
    except Exception as error:
        if not known and not script.csv_parameters and "add_parameters" not in script.text:
            raise stopped(error, script.file_name) from error
        raise RehearsalError(
            f"The runtime parameters of {script.file_name} cannot be set: {error}",
            line_of(error, script.file_name),
        ) from error


def copied_parameters(live: Any) -> Any:
    """A copy of a live run's ``Parameters``; its CSV files are opened anew.

    A file that the rehearsal has read, or closed, would be empty for the run itself.
    """
    values = {name: copy(value) for name, value in live.get_all().items()}
    for value in values.values():
        if hasattr(value, "_file"):
            value._file = None
    return type(live)(values)
