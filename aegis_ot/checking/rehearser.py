"""This side of the rehearsing process: starts it, asks it, ends it when it hangs."""

from __future__ import annotations

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
from types import TracebackType
from typing import Any

from ..errors import RehearsalError
from .child import Answer, Link
from .problems import PASSED_ON, late
from .result import Problem
from .tasks import Task

_MAIN = """import os, sys
sys.path[:] = sys.argv.pop(1).split(os.pathsep)
from aegis_ot.checking.child import main
main()"""
# Not `-m`: that puts the working folder first, where a json.py of the user's may lie.

_NEEDED = re.compile(
    "PATH|PATHEXT|HOME|USER|LOGNAME|SHELL|TZ|LANG|LANGUAGE|VIRTUAL_ENV|TMPDIR|TMP|TEMP|USERPROFILE|"
    "USERNAME|APPDATA|LOCALAPPDATA|PROGRAMDATA|SYSTEMROOT|SYSTEMDRIVE|WINDIR|COMSPEC|"
    "(?:DY)?LD_LIBRARY_PATH|DEV_ROBOT_NAME|RUNNING_ON_(?:PI|VERDIN)|"
    "(?:LC_|XDG_|PYTHON|OT_|OPENTRONS_|AEGIS_OT_|OPENBLAS_|OMP_|NPY_).*"
)
_SECRET = re.compile(r"TOKEN|KEY|SECRET|PASS|CREDENTIAL|NOTIFY")

_START_S = 180.0
"""Longest wait for opentrons to be loaded; slow on a busy machine with a cold disk."""

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


class Rehearser:
    """Performs tasks in another process, replaced whenever it had to be ended.

    Args:
        rules: Paths of further rules, loaded ahead.
    """

    def __init__(self, rules: Sequence[str] = ()) -> None:
        self._rules = tuple(rules)
        self._process: subprocess.Popen[bytes] | None = None
        self._link: Link | None = None
        self._cancelled = threading.Event()
        folder = tempfile.mkdtemp(prefix="aegis-ot-")
        self._folder = Path(folder)
        self._stacks = self._folder / "stacks"

    def __enter__(self) -> Rehearser:
        self._start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._end()
        self._stacks.unlink(missing_ok=True)
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
            _kill(process)

    def _start(self) -> None:
        path = os.pathsep.join(map(os.path.abspath, filter(None, sys.path)))
        self._process = subprocess.Popen(
            [sys.executable, "-c", _MAIN, path, str(self._stacks), *self._rules],
            env=environment_of_protocols(os.environ),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
        )
        assert self._process.stdin
        assert self._process.stdout
        self._link = Link(self._process.stdout, self._process.stdin)
        if self._cancelled.is_set():  # in between, so it was not there to be ended
            _kill(self._process)
            return
        ready = self._ask(None, _START_S)
        if ready is None or ready.value != "ready":
            raise RehearsalError(
                "The rehearsing process does not start"
                f"{': ' + ready.problem.message if ready and ready.problem else ''}. "
                "Rehearsing needs opentrons; install it with: pip install 'aegis-ot[ot2]'."
            )

    def _ask(self, task: Task | None, limit_s: float) -> Answer | None:
        """Send a task and wait for its answer; ``None`` when it had to be ended."""
        assert self._link is not None
        assert self._process is not None
        overdue = threading.Event()
        process = self._process

        def end() -> None:
            overdue.set()
            _kill(process)

        timer = threading.Timer(limit_s, end)
        timer.daemon = True
        timer.start()
        answer: Answer | None
        try:
            if task is not None:
                self._link.send(task)
            answer = self._link.receive()
            if not isinstance(answer, Answer):
                raise pickle.UnpicklingError
        except pickle.UnpicklingError:
            answer = Answer(problem=_GARBLED)
        except (EOFError, OSError):
            answer = None
        finally:
            timer.cancel()
        if answer is not None and answer.problem == _GARBLED:
            self._end()  # what else it wrote would be taken for the next one's answer
        elif answer is None or overdue.is_set():
            code = self._end()
            if not overdue.is_set():
                return Answer(died=f"exit status {code}")
            return None
        return answer

    def _end(self) -> int:
        process, link = self._process, self._link
        self._process = self._link = None
        if process is None or link is None:
            return 0
        _kill(process)
        link.close()
        if process.stderr:
            process.stderr.close()
        return process.wait()

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
