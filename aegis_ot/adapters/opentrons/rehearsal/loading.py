"""Loads a script as Opentrons does, and says in words why it cannot be loaded.

Opentrons gives a line to few of its refusals: a file that it cannot load has none.
"""

from __future__ import annotations

import ast
from typing import Any

from ....errors import RehearsalError
from .refusals import error_at
from .script import Script

_DECLARED = ("apiLevel", "metadata", "requirements", "robotType")


def load(script: Script) -> Any:
    """The ``PythonProtocol`` that Opentrons makes of a script.

    Raises:
        RehearsalError: It cannot be parsed; with its line.
    """
    from opentrons.protocols.api_support.definitions import MAX_SUPPORTED_VERSION
    from opentrons.protocols.parse import parse
    from opentrons.protocols.types import PythonProtocol

    refusal = _not_python
    try:
        compile(script.text, script.file_name, "exec", dont_inherit=True)
        refusal = _unloadable
        protocol = parse(
            script.text,
            script.file_name,
            extra_labware=dict(script.extra_labware),
            extra_data=dict(script.data_files),
        )
    except (RecursionError, MemoryError) as error:
        told = f"{script.file_name}: not valid Python: nested too deeply to be compiled"
        raise RehearsalError(told) from error
    except Exception as error:  # opentrons raises its own zoo, and plain RuntimeErrors
        raise refusal(error, script) from error
    if not isinstance(protocol, PythonProtocol):
        raise RehearsalError(
            f"{script.file_name} is a JSON protocol, which carries no guard; "
            "aegis-ot check judges it."
        )
    if protocol.api_level > MAX_SUPPORTED_VERSION:
        told = (
            f"{script.file_name} is written for API version {protocol.api_level}, and the "
            f"opentrons installed here knows up to {MAX_SUPPORTED_VERSION}: install a newer one, "
            "or lower the apiLevel."
        )
        body = ast.parse(script.text).body
        raise RehearsalError(told, _assigned_at(body, _DECLARED) or 1)
    return protocol


def _not_python(error: Exception, script: Script) -> RehearsalError:
    reason = getattr(error, "msg", None) or str(error)
    line = getattr(error, "lineno", None)
    return error_at(script.file_name, line, f"not valid Python: {reason}")


def _unloadable(error: Exception, script: Script) -> RehearsalError:
    """The error of a protocol that Opentrons does not even load; the text itself is Python."""
    body = ast.parse(script.text).body
    runs = [node for node in body if isinstance(node, ast.FunctionDef) and node.name == "run"]
    short = getattr(error, "short_message", "") or str(error)
    declared = _assigned_at(body, _DECLARED) or 1
    if type(error).__name__ == "ApiDeprecationError":
        told = (
            f"is written for version {getattr(error, 'version', 1)} of the Python API, which "
            "Opentrons ended with its software 4.0: it has to be rewritten for version 2."
        )
        return RehearsalError(f"{script.file_name} {told}", declared)
    if not runs and "run" in short:
        line, hint = _instead_of_run(body)
        told = f"{script.file_name} defines no function run(protocol) at its top level{hint}."
        return RehearsalError(told, line)
    line = runs[1].lineno if len(runs) > 1 else declared
    return RehearsalError(f"Opentrons cannot load {script.file_name}: {short}", line)


def _instead_of_run(body: list[ast.stmt]) -> tuple[int, str]:
    """Where something stands that was meant to be ``run``, or the first line."""
    for node in body:
        if isinstance(node, ast.AsyncFunctionDef) and node.name == "run":
            return node.lineno, " (this one is async)"
    if line := _assigned_at(body, ("run",)):
        return line, " (this is no def)"
    for part in ast.walk(ast.Module(body, [])):
        if isinstance(part, ast.FunctionDef) and part.name == "run":
            return part.lineno, " (this one stands inside something else)"
    for node in body:
        if isinstance(node, ast.FunctionDef) and node.name.lower().strip("_") in ("run", "main"):
            return node.lineno, f" (this one is called {node.name})"
    return 1, ""


def _assigned_at(body: list[ast.stmt], names: tuple[str, ...]) -> int | None:
    """The first line at the top level that gives one of these names a value."""
    for node in body:
        if isinstance(node, ast.Assign) and any(
            isinstance(target, ast.Name) and target.id in names for target in node.targets
        ):
            return node.lineno
    return None
