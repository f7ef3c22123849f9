"""Loads a script as Opentrons does."""

from __future__ import annotations

from typing import Any

from ...errors import RehearsalError
from .refusals import too_deep, too_new, unloadable
from .script import Script


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
