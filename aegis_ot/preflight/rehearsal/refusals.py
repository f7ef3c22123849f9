"""What Opentrons or Python refuses, in one sentence for people, with the protocol's line.

Opentrons wraps an error in its own codes and names, tells some at length, and gives a line to
few: a file that it cannot load has none.
"""

from __future__ import annotations

import ast
import inspect
import re
import traceback
from collections.abc import Sequence
from typing import Any

from ...errors import RehearsalError
from .script import Script

_WRAPPED = re.compile(r"^\w+: Error \d+ [A-Z_]+ \((?P<kind>\w+)\): (?P<text>.*)$", re.DOTALL)
_NAMED = re.compile(r"^(?:PythonException: )?(?=\w+(?:Error|Exception): )")
_DECLARED = ("apiLevel", "metadata", "requirements", "robotType")


def in_words(error: BaseException) -> str:
    """``"LocationIsOccupiedError: Labware ... is already present ..."``, without codes."""
    name = type(error).__name__
    text = str(error).strip()
    if not text:
        silent = {"OutOfTipsError": "no tip is left in the racks of the pipette."}
        return f"{name}: {silent[name]}" if name in silent else name
    said = f"{name}: {text}"
    wrapped = _WRAPPED.match(said)
    if wrapped is None:
        return said
    inner = _NAMED.match(wrapped["text"])
    if inner is not None:  # it names its own kind, which says more than the wrapping
        return wrapped["text"][inner.end() :]
    return f"{wrapped['kind']}: {wrapped['text']}"


def stopped(
    error: Exception, file_name: str, run: Any = None, lacking: Sequence[str] = ()
) -> RehearsalError:
    """The error of a protocol that raised.

    Args:
        error: What it raised.
        file_name: Of the protocol.
        run: Where the error stands if no line of it ran.
        lacking: CSV parameters without a file.
    """
    line = line_of(error, file_name)
    if line is None and callable(run):
        code = getattr(inspect.unwrap(run), "__code__", None)
        line = getattr(code, "co_firstlineno", None)
    where = f"{file_name}, line {line}" if line else file_name
    told = in_words(error)
    if type(error).__name__ == "RuntimeParameterRequired" and lacking:
        told = f"the CSV parameter {lacking[0]} needs a file, and has none."
    return RehearsalError(f"{where}: {told}", line)


def never_executed(result: Any, file_name: str) -> RehearsalError | None:
    """The error of a ``run`` that gives a generator or a coroutine, and so executes nothing;
    ``None`` for any other result.
    """
    told = "it is async"
    if inspect.isgenerator(result):
        code, told = result.gi_code, "it is a generator: a yield stands in it"
    elif inspect.isasyncgen(result):
        code = result.ag_code
    elif inspect.iscoroutine(result):
        code = result.cr_code
        result.close()  # else Python warns that nobody awaits it
    else:
        return None
    line = code.co_firstlineno if code.co_filename == file_name else None
    where = f"{file_name}, line {line}" if line else file_name
    name = "run" if code.co_name == "run" else f"what run returns, {code.co_name},"
    told = f"{where}: {name} is never executed, since {told}. No step of it was rehearsed."
    return RehearsalError(told, line)


def unloadable(error: Exception, script: Script) -> RehearsalError:
    """The error of a protocol that Opentrons does not even load; the text itself is Python."""
    body = ast.parse(script.text).body
    runs = [node for node in body if isinstance(node, ast.FunctionDef) and node.name == "run"]
    short = getattr(error, "short_message", "") or str(error)
    if type(error).__name__ == "ApiDeprecationError":
        told = (
            f"is written for version {getattr(error, 'version', 1)} of the Python API, which "
            "Opentrons ended with its software 4.0: it has to be rewritten for version 2."
        )
        return RehearsalError(f"{script.file_name} {told}", _line_of_declaration(body))
    if not runs and "run" in short:
        line, hint = _instead_of_run(body)
        told = f"{script.file_name} defines no function run(protocol) at its top level{hint}."
        return RehearsalError(told, line)
    line = runs[1].lineno if len(runs) > 1 else _line_of_declaration(body)
    return RehearsalError(f"Opentrons cannot load {script.file_name}: {short}", line)


def too_deep(script: Script) -> RehearsalError:
    """The error of a protocol with a statement of thousands of parts in each other."""
    told = f"{script.file_name}: not valid Python: nested too deeply to be compiled"
    return RehearsalError(told)


def too_new(script: Script, wanted: Any, newest: Any) -> RehearsalError:
    """The error of a protocol for a newer API than the opentrons installed here knows."""
    told = (
        f"{script.file_name} is written for API version {wanted}, and the opentrons installed "
        f"here knows up to {newest}: install a newer one, or lower the apiLevel."
    )
    return RehearsalError(told, _line_of_declaration(ast.parse(script.text).body))


def _instead_of_run(body: list[ast.stmt]) -> tuple[int, str]:
    """Where something stands that was meant to be ``run``, or the first line."""
    for node in body:
        if isinstance(node, ast.AsyncFunctionDef) and node.name == "run":
            return node.lineno, " (this one is async)"
        if isinstance(node, ast.Assign) and any(
            isinstance(target, ast.Name) and target.id == "run" for target in node.targets
        ):
            return node.lineno, " (this is no def)"
    for statement in body:
        for part in ast.walk(statement):
            if isinstance(part, ast.FunctionDef) and part.name == "run":
                return part.lineno, " (this one stands inside something else)"
    for node in body:
        if isinstance(node, ast.FunctionDef) and node.name.lower().strip("_") in ("run", "main"):
            return node.lineno, f" (this one is called {node.name})"
    return 1, ""


def _line_of_declaration(body: list[ast.stmt]) -> int:
    """Where the protocol says which apiLevel it is for, or the first line."""
    for node in body:
        if isinstance(node, ast.Assign) and any(
            isinstance(target, ast.Name) and target.id in _DECLARED for target in node.targets
        ):
            return node.lineno
    return 1


def line_of(error: BaseException, file_name: str) -> int | None:
    """The innermost line of the protocol in a traceback."""
    seen: BaseException | None = error
    while seen is not None:
        for entry in reversed(traceback.extract_tb(seen.__traceback__)):
            if entry.filename == file_name:
                return entry.lineno
        seen = seen.__cause__
    return getattr(error, "lineno", None)
