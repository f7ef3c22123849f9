"""Whatever kept a protocol from being judged, as one sentence for people, with its line."""

from __future__ import annotations

import dataclasses
import os
import re
import shlex
import traceback
from collections.abc import Iterator
from pathlib import Path

from ..adapters.opentrons.rehearsal import in_words, line_of
from ..errors import AegisError, RehearsalError, RehearsalTimeout
from .result import Problem
from .surroundings import NO_SOURCES

_NO_LABWARE = re.compile(r'Labware "[^"]*" not found|Unable to find a labware\s+definition')

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


def lacks_labware(problem: Problem) -> bool:
    """Whether labware that nobody defined kept a protocol from being judged."""
    return _NO_LABWARE.search(problem.message) is not None


def with_helper(problem: Problem, file: Path, root: Path, engine: str = "") -> Problem:
    """Tells what to type where a module lacks: its folder, where the repository holds it once.
    A package goes into the ``engine`` of this version, if there was one."""
    name = problem.missing.partition(".")[0]
    if not name:
        return problem
    found = {path.parent for path in _sources(root, name)}
    if len(found) == 1:
        folder = shlex.quote(str(found.pop()))
        told = f"{name} of this repository is found with: PYTHONPATH={folder} aegis-ot check {file}"
    else:
        package = "is installed where aegis-ot is, with pip"
        if engine:
            package = f"goes into its engine: aegis-ot engines install {engine} --with {name}"
        told = (
            "if it is a file of yours, give its folder: PYTHONPATH=FOLDER aegis-ot check "
            f"{file}; a package {package}"
        )
    return dataclasses.replace(problem, message=f"{problem.message.rstrip('.')}; {told}.")


def _sources(root: Path, name: str) -> Iterator[Path]:
    """The modules of this name anywhere in a repository."""
    for place, folders, files in os.walk(root):
        folders[:] = [f for f in folders if not f.startswith(".") and f not in NO_SOURCES]
        if f"{name}.py" in files:
            yield Path(place, f"{name}.py")
        if name in folders and Path(place, name, "__init__.py").is_file():
            yield Path(place, name)


def _of_rehearsal(error: RehearsalError, script_name: str) -> Problem:
    cause = error.__cause__
    if isinstance(cause, ModuleNotFoundError) and (cause.name or "").startswith("opentrons."):
        return Problem(
            f"it imports {cause.name}, which is not in this release of Opentrons: it was written "
            "for another. An editor may have added the line; if nothing needs it, take it out.",
            error.line,
        )
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
    if _NO_LABWARE.search(text):
        text = " ".join(text.split()).rstrip(".")
        text += "; if it is your own, give its definition: --labware FOLDER."
    if isinstance(cause, FileNotFoundError) and cause.filename:
        told = f"it reads {cause.filename}, which is not there"
        return Problem(
            f"{told}; a rehearsal runs in the protocol's own folder: put it there.", error.line
        )
    file = re.search(r"CSV parameter (\w+) needs a file", text)
    if file:
        text = f"{text.rstrip('.')}; give it with --csv {file[1]}=PATH."
    if isinstance(error, RehearsalTimeout):
        return late(text, error.line)
    return Problem(text, error.line)


def late(told: str, line: int | None) -> Problem:
    """A protocol that did not end in time; where it was, if it was anywhere."""
    if line is not None:
        told += " It stood at this line; --timeout SECONDS gives it more."
    else:
        told += " No line of it was running then: this machine is busy, or Opentrons hangs."
    return Problem(told, line)


def _environment_variable(error: KeyError) -> str:
    """The variable that ``os.environ[...]`` did not find, or ``""`` if it was something else."""
    frames = traceback.extract_tb(error.__traceback__)
    in_os = frames and os.path.basename(frames[-1].filename) in ("os.py", "<frozen os>")
    return str(error.args[0]) if in_os and frames[-1].name == "__getitem__" else ""
