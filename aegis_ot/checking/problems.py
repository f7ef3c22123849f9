"""Whatever kept a protocol from being judged, as one sentence for people, with its line."""

from __future__ import annotations

import dataclasses
import os
import re
import traceback
from pathlib import Path

from ..errors import AegisError, RehearsalError, RehearsalTimeout
from ..preflight.rehearsal import in_words, line_of
from .result import Problem

PASSED_ON = "AEGIS_OT_PROTOCOL_ENV"
"""Names the environment variables that a rehearsal gets beside what Python and Opentrons need."""


def problem_of(error: BaseException, script_name: str) -> Problem:
    """What a task raised, without the file name and line that stand beside it anyway."""
    if isinstance(error, RehearsalError):
        return _of_rehearsal(error, script_name)
    if isinstance(error, AegisError):
        return Problem(str(error))
    line = line_of(error, script_name)
    if isinstance(error, SystemExit):
        return Problem("the protocol ends the Python process (sys.exit); it must return.", line)
    if isinstance(error, KeyboardInterrupt):
        return Problem("the protocol raises KeyboardInterrupt.", line)
    if not isinstance(error, Exception):
        return Problem(f"the protocol raises {in_words(error)}", line)
    frames = traceback.extract_tb(error.__traceback__)
    if any("opentrons" in Path(frame.filename).parts for frame in frames):
        return Problem(f"Opentrons cannot run it: {in_words(error)}", line)
    place = frames[-1]
    return Problem(
        f"aegis-ot itself failed: {in_words(error)} ({place.name}, line {place.lineno}). "
        "This is a bug in aegis-ot; please report it.",
        line,
        bug=True,
    )


def with_helper(problem: Problem, folder: Path) -> Problem:
    """Tells what to do where the module that is missing lies beside the protocol."""
    name = problem.missing.partition(".")[0]
    if not name or not ((folder / f"{name}.py").is_file() or (folder / name).is_dir()):
        return problem
    told = (
        f"it imports {problem.missing}, which lies beside it; but Opentrons loads a protocol "
        f"alone. Check it with PYTHONPATH={folder}, and mind that the robot needs {name} as well."
    )
    return dataclasses.replace(problem, message=told)


def _of_rehearsal(error: RehearsalError, script_name: str) -> Problem:
    cause = error.__cause__
    if isinstance(cause, ModuleNotFoundError) and cause.name:
        told = f"it imports {cause.name}, which is not installed beside aegis-ot."
        return Problem(told, error.line, cause.name)
    if isinstance(cause, ImportError):
        return Problem(f"the protocol cannot import something: {cause}", error.line)
    if isinstance(cause, KeyError) and (name := _environment_variable(cause)):
        told = (
            f"it needs the environment variable {name}, and a rehearsal gets few of them. "
            f"Set it, and {PASSED_ON}={name}, to pass it on."
        )
        return Problem(told, error.line)
    text = str(error)
    start = re.match(
        rf"(?:Opentrons cannot load )?{re.escape(script_name)}"
        r"(?:(?:, line \d+)?: | (?=did not end|defines no|is written))",
        text,
    )
    text = text[start.end() :] if start else text
    if re.search(r'Labware "[^"]*" not found', text):
        text = text.rstrip(".") + "; if it is your own, give its definition with --labware."
    file = re.search(r"CSV parameter (\w+) needs a file", text)
    if file:
        text = f"{text.rstrip('.')}; give it with --csv {file[1]}=PATH."
    if isinstance(error, RehearsalTimeout):
        return late(text, error.line)
    return Problem(text, error.line)


def late(told: str, line: int | None) -> Problem:
    """A protocol that did not end in time; where it was, if it was anywhere."""
    if line is None:
        told += " No line of it was running then: this machine is busy, or Opentrons hangs."
    return Problem(told, line)


def _environment_variable(error: KeyError) -> str:
    """The variable that ``os.environ[...]`` did not find, or ``""`` if it was something else."""
    frames = traceback.extract_tb(error.__traceback__)
    in_os = frames and os.path.basename(frames[-1].filename) in ("os.py", "<frozen os>")
    return str(error.args[0]) if in_os and frames[-1].name == "__getitem__" else ""
