"""What Opentrons or Python refuses, in one sentence for people, with the protocol's line.

Opentrons wraps an error in its own codes and names, and tells some at length.
"""

from __future__ import annotations

import ast
import inspect
import re
import traceback
from collections.abc import Sequence
from typing import Any

from ....errors import RehearsalError

_NOZZLES = "configure_nozzle_layout"
_WRAPPED = re.compile(r"^\w+: Error \d+ [A-Z_]+ \((?P<kind>\w+)\): (?P<text>.*)$", re.DOTALL)
_NAMED = re.compile(r"^(?:PythonException: )?(?=\w+(?:Error|Exception): )")


def in_words(error: BaseException) -> str:
    """``"LocationIsOccupiedError: Labware ... is already present ..."``, without codes."""
    name = type(error).__name__
    text = str(error).strip()
    if not text:
        no_tips = f"{name}: no tip is left in the racks of the pipette."
        return no_tips if name == "OutOfTipsError" else name
    said = f"{name}: {text}"
    wrapped = _WRAPPED.match(said)
    if wrapped is None:
        return said
    inner = _NAMED.match(wrapped["text"])
    if inner is not None:  # it names its own kind, which says more than the wrapping
        return wrapped["text"][inner.end() :]
    return f"{wrapped['kind']}: {wrapped['text']}"


def stopped(
    error: Exception, file_name: str, run: Any = None, lacking: Sequence[str] = (), text: str = ""
) -> RehearsalError:
    """The error of a protocol that raised: at ``run`` if no line of it ran. It may be that CSV
    parameters are ``lacking`` a file. Its ``text`` tells where a pipette lost its racks.
    """
    line = line_of(error, file_name)
    if line is None and callable(run):
        code = getattr(inspect.unwrap(run), "__code__", None)
        line = getattr(code, "co_firstlineno", None)
    told = _without_racks(error, line, text) or in_words(error)
    if type(error).__name__ == "RuntimeParameterRequired" and lacking:
        told = f"the CSV parameter {lacking[0]} needs a file, and has none."
    return error_at(file_name, line, told)


def _without_racks(error: Exception, line: int | None, text: str) -> str:
    """That a pipette has no tip rack at all, and which statement left it without; else nothing."""
    if type(error).__name__ != "OutOfTipsError":
        return ""
    racks: Any = None
    for frame, _ in traceback.walk_tb(error.__traceback__):
        racks = getattr(frame.f_locals.get("self"), "_tip_racks", racks)
    if racks is None or racks:
        return ""
    layouts = [
        node.lineno
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Call) and getattr(node.func, "attr", "") == _NOZZLES
        if all(word.arg not in ("tip_racks", None) for word in node.keywords)
    ]
    before = [at for at in layouts if line is None or at <= line] or layouts
    where = f"{_NOZZLES} at line {max(before)} names none" if before else "none was given"
    return f"the pipette has no tip rack: {where}. Write tip_racks=[...] there."


def refuse_unexecuted(result: Any, file_name: str) -> None:
    """Refuse a ``run`` that gives a generator or a coroutine, and so executes nothing."""
    told = "it is async"
    if inspect.isgenerator(result):
        code, told = result.gi_code, "it is a generator: a yield stands in it"
    elif inspect.isasyncgen(result):
        code = result.ag_code
    elif inspect.iscoroutine(result):
        code = result.cr_code
        result.close()  # else Python warns that nobody awaits it
    else:
        return
    line = code.co_firstlineno if code.co_filename == file_name else None
    name = "run" if code.co_name == "run" else f"what run returns, {code.co_name},"
    told = f"{name} is never executed, since {told}. No step of it was rehearsed."
    raise error_at(file_name, line, told)


def error_at(file_name: str, line: int | None, told: str) -> RehearsalError:
    """An error that begins with the file, and the line if that is known."""
    where = f"{file_name}, line {line}" if line else file_name
    return RehearsalError(f"{where}: {told}", line)


def line_of(error: BaseException, file_name: str) -> int | None:
    """The innermost line of the protocol in a traceback."""
    seen: BaseException | None = error
    while seen is not None:
        for entry in reversed(traceback.extract_tb(seen.__traceback__)):
            if entry.filename == file_name:
                return entry.lineno
        seen = seen.__cause__
    return getattr(error, "lineno", None)
