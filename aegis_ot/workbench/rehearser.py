"""This side of the rehearsing process: starts it, asks it, ends it when it hangs."""

from __future__ import annotations

import contextlib
import os
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..errors import RehearsalError
from .engines import Engine
from .link import Link, LinkAnswer
from .problems import PASSED_ON, late
from .result import Problem
from .tasks import Task
from .warm_process import Joined, join, place_of, seconds_to_keep

_MAIN = """import os, sys
sys.path[:] = sys.argv.pop(1).split(os.pathsep)
from aegis_ot.workbench.rehearsal_process import main
main()"""
# Not `-m`: that puts the working folder first, where a json.py of the user's may lie.

_LENT = """import sys
sys.path[:] = [place for place in sys.path if place]
from importlib.util import module_from_spec, spec_from_file_location
folder = sys.argv.pop(1)
spec = spec_from_file_location("aegis_ot", folder + "/__init__.py",
                               submodule_search_locations=[folder])
sys.modules["aegis_ot"] = package = module_from_spec(spec)
spec.loader.exec_module(package)
from aegis_ot.workbench.rehearsal_process import main
main()"""
"""The same in an engine, which gets this very package and nothing else of this environment."""

_NEEDED = re.compile(
    "PATH|PATHEXT|HOME|USER|LOGNAME|SHELL|TZ|LANG|LANGUAGE|VIRTUAL_ENV|TMPDIR|TMP|TEMP|USERPROFILE|"
    "USERNAME|APPDATA|LOCALAPPDATA|PROGRAMDATA|SYSTEMROOT|SYSTEMDRIVE|WINDIR|COMSPEC|"
    "(?:DY)?LD_LIBRARY_PATH|DEV_ROBOT_NAME|RUNNING_ON_(?:PI|VERDIN)|"
    "(?:LC_|XDG_|PYTHON|OT_|OPENTRONS_|AEGIS_OT_|OPENBLAS_|OMP_|NPY_).*"
)
_SECRET = re.compile(r"TOKEN|KEY|SECRET|PASS|CREDENTIAL|NOTIFY")

_START_S = 180.0
"""Longest wait for opentrons to be loaded; slow on a busy machine with a cold disk."""

_MORE_STARTS = 3
"""How often a process is started anew where what it loaded was written meanwhile: by whoever
installs, or by Python, which keeps what it compiled when a new installation first runs."""

_AROUND_S = 60.0
"""Longest wait for all of a task but the protocol itself, which has a clock of its own."""

_TIMED_OUT = "Timeout ("
"""How the last words of a process begin that its own clock has ended."""


_GARBLED = Problem("the protocol wrote into the pipe that carries what came of its rehearsal.")


def environment_of_protocols(whole: Mapping[str, str]) -> dict[str, str]:
    """What a rehearsal gets of the environment: what Python, Opentrons and this package need.

    A protocol is somebody's program, and keys of models or of a CI are none of its business. What
    it does need the user names in :data:`~.problems.PASSED_ON`, parted by commas.
    """
    named = {name.strip() for name in whole.get(PASSED_ON, "").split(",")}
    return {
        name: value
        for name, value in whole.items()
        if name in named or (_NEEDED.fullmatch(name.upper()) and not _SECRET.search(name.upper()))
    }


class TaskFailed(Exception):
    """A task has no result; :attr:`problem` says why."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem.message)
        self.problem = problem


class _Started:
    """A process that was started for one rehearser."""

    def __init__(self, process: subprocess.Popen[bytes]) -> None:
        assert process.stdin
        assert process.stdout
        self._process = process
        self.link = Link(process.stdout, process.stdin)

    def kill(self) -> None:
        _kill(self._process)

    def end(self) -> str:
        self.kill()
        self.link.close()
        if self._process.stderr:
            self._process.stderr.close()
        return f"exit status {self._process.wait()}"


class Rehearser:
    """Performs tasks in another process, replaced whenever it had to be ended.

    Args:
        rules: Paths of further rules, loaded ahead.
        engine: Whose ``opentrons``; the one here if left out.
        lasting: Whether a process that outlives this one may serve it, and be started for it;
            see :mod:`.warm`.
    """

    def __init__(
        self, rules: Sequence[str] = (), engine: Engine | None = None, lasting: bool = False
    ) -> None:
        self._rules = tuple(rules)
        self._engine = engine
        self._lasting = lasting
        self._process: _Started | Joined | None = None
        self._cancelled = threading.Event()
        folder = tempfile.mkdtemp(prefix="aegis-ot-")
        self._folder = Path(folder)
        self._stacks = self._folder / "stacks"

    def __enter__(self) -> Rehearser:
        self._start()
        return self

    def __exit__(self, *_: object) -> None:
        self._end()
        self._stacks.unlink(missing_ok=True)
        with contextlib.suppress(OSError):  # removed with the system's temporary files
            self._folder.rmdir()

    def perform(self, task: Task) -> Any:
        """Do a task and return its result.

        Raises:
            TaskFailed: It raised, did not end in time, took its process with it, or was
                cancelled.
        """
        self.get_ready()
        if self._cancelled.is_set():
            raise TaskFailed(Problem("was interrupted."))
        limit_s = 2 * task.timeout_s + _AROUND_S
        answer = self._ask(task, limit_s)
        for _ in range(_MORE_STARTS):
            if answer is None or not answer.stale:
                break
            self._end()
            self.get_ready()
            answer = self._ask(task, limit_s)
        if answer is not None and answer.stale:
            raise TaskFailed(Problem("what is installed here changed just now; check it again."))
        if answer is None:
            message = f"gave no answer within {limit_s:g} s, and was ended."
            raise TaskFailed(Problem(message))
        if answer.died:
            stacks = self._last_words()
            line = _line(task, stacks)
            if stacks.startswith(_TIMED_OUT):
                message = f"did not end within {task.timeout_s:g} s of rehearsal."
                raise TaskFailed(late(message, line))
            message = f"the protocol ended the Python process ({answer.died})."
            raise TaskFailed(Problem(message, line))
        if answer.problem is not None:
            raise TaskFailed(answer.problem)
        return answer.value

    def get_ready(self) -> None:
        """Start the process unless it runs: that takes seconds, which no task is to blame for."""
        if not self._cancelled.is_set() and self._process is None:
            self._start()

    def cancel(self) -> None:
        """End what another thread has it do now, and refuse all further tasks."""
        self._cancelled.set()
        process = self._process
        if process is not None:
            process.kill()

    def _start(self) -> None:
        python = self._python()
        environment = environment_of_protocols(os.environ)
        keep_s = seconds_to_keep(os.environ) if self._lasting else 0.0
        place = place_of(environment, python) if keep_s else None
        if place is not None:
            self._process = join(place, self._stacks)
            if self._process is not None:
                return
        lasting = ("", "") if place is None else (str(place), f"{keep_s:g}")
        try:
            process = subprocess.Popen(
                [*python, str(self._stacks), *lasting, *self._rules],
                env=environment,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                start_new_session=True,
            )
        except OSError as error:
            raise RehearsalError(self._does_not_start(f": {error}")) from None
        self._process = _Started(process)
        if self._cancelled.is_set():  # in between, so it was not there to be ended
            self._process.kill()
            return
        ready = self._ask(None, _START_S)
        if ready is None or ready.value != "ready":
            why = f": {ready.problem.message}" if ready and ready.problem else ""
            raise RehearsalError(self._does_not_start(why))
        if place is not None:
            self._process.end()  # it has detached itself, and listens
            self._process = join(place, self._stacks)
            if self._process is None:
                self._lasting = False
                self._start()

    def _does_not_start(self, why: str) -> str:
        told = f"The rehearsing process does not start{why}."
        if self._engine is not None and self._engine.python:
            version = self._engine.version
            return f"{told} Type: aegis-ot engines remove {version}, and install it again."
        return f"{told} Rehearsing needs opentrons; install it with: aegis-ot engines install"

    def _python(self) -> list[str]:
        if self._engine is not None and self._engine.python:
            return [self._engine.python, "-c", _LENT, str(Path(__file__).resolve().parents[1])]
        path = os.pathsep.join(map(os.path.abspath, filter(None, sys.path)))
        return [sys.executable, "-c", _MAIN, path]

    def _ask(self, task: Task | None, limit_s: float) -> LinkAnswer | None:
        """Send a task and wait for its answer; ``None`` when it had to be ended."""
        assert self._process is not None
        overdue = threading.Event()
        process = self._process

        def end() -> None:
            overdue.set()
            process.kill()

        timer = threading.Timer(limit_s, end)
        timer.daemon = True
        timer.start()
        answer: LinkAnswer | None
        try:
            if task is not None:
                process.link.send(task)
            answer = process.link.receive()
            if not isinstance(answer, LinkAnswer):
                raise pickle.UnpicklingError
        except pickle.UnpicklingError:
            answer = LinkAnswer(problem=_GARBLED)
        except (EOFError, OSError):
            answer = None
        finally:
            timer.cancel()
        if answer is not None and answer.problem == _GARBLED:
            self._end()  # what else it wrote would be taken for the next one's answer
        elif answer is None or overdue.is_set():
            how = self._end()
            if not overdue.is_set():
                return LinkAnswer(died=how)
            return None
        return answer

    def _end(self) -> str:
        process, self._process = self._process, None
        return process.end() if process is not None else ""

    def _last_words(self) -> str:
        """The stacks of all threads at the moment of its death, as far as it could tell."""
        try:
            return self._stacks.read_text(encoding="utf-8", errors="replace")
        except OSError:
            return ""


def _line(task: Task, stacks: str) -> int | None:
    """The innermost line of the protocol in these stacks."""
    found = re.search(rf'File "{re.escape(task.file_name)}", line (\d+)', stacks)
    return int(found[1]) if found else None


def _kill(process: subprocess.Popen[bytes]) -> None:
    """End a process and all that it started."""
    try:
        if os.name == "posix":
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
    except (ProcessLookupError, PermissionError):
        pass
