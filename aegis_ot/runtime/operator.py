"""Asks a person: by the run's own pause where somebody can resume it, else at the console."""

from __future__ import annotations

import select
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from enum import Enum
from typing import Any

from ..adapters.opentrons.run_state import can_be_resumed
from ..errors import RunAborted
from ..vocabulary import one_line
from .legacy_run import LegacyRun
from .page_answers import PageAnswers

_REMIND_S = 60.0
_POLL_S = 0.15
_ASK_S = 0.3
"""How long the page may take to answer while the console is listened to as well, s."""


class OperatorAnswer(Enum):
    """What the operator, or the mended cause, says."""

    RESUME = "resume"
    ABORT = "abort"


LONGEST = 4000
"""Characters of one comment. It is one line: what a person or a protocol named must not look like
a line of somebody else's in the run log, or in that of a CI job."""

Poll = Callable[[], "OperatorAnswer | None"]

_ON_PAGE = {"resume": OperatorAnswer.RESUME, "stop": OperatorAnswer.ABORT}


def no_news() -> OperatorAnswer | None:
    """A :data:`Poll` where nothing mends by itself."""
    return None


class Operator:
    """The person who watches one run.

    Args:
        protocol: The context; its ``pause`` and ``comment`` are used.
        simulating: In simulation a pause is only reported.
        rest: Sleeps in short slices and raises when the run is being stopped.
    """

    def __init__(self, protocol: Any, simulating: bool, rest: Callable[[float], None]) -> None:
        self._protocol = protocol
        self._simulating = simulating
        self._rest = rest
        self._legacy_run = LegacyRun.of(protocol)
        self.busy = False
        """Whether the guard itself is pausing or commenting just now."""

    @property
    def is_legacy(self) -> bool:
        """Whether words have to come before an announcement that is kept back for them."""
        return self._legacy_run is not None

    @property
    def can_be_answered(self) -> bool:
        """Whether somebody could answer a pause without the sidecar's page."""
        return self._simulating or can_be_resumed() or _is_terminal()

    def begin(self) -> None:
        """The run begins."""
        if self._legacy_run is not None:
            self._legacy_run.begin()

    def end(self) -> None:
        """The run is over; leave its context as it was. Idempotent."""
        if self._legacy_run is not None:
            self._legacy_run.end()

    def proceed(self) -> None:
        """Nothing more is to be said before the operation that the protocol asked for."""
        if self._legacy_run is not None:
            self._legacy_run.announce()

    def aside(self) -> AbstractContextManager[None]:
        """While the guard does commands of its own, before the operation that waits."""
        if self._legacy_run is not None:
            return self._legacy_run.aside()
        return _step_group(self._protocol, "aegis_ot: recovery")

    def comment(self, text: str) -> None:
        """Write into the run log."""
        with self._speaking():
            self._protocol.comment(f"aegis_ot: {one_line(text, LONGEST)}")

    def pause(self, text: str, poll: Poll, page: PageAnswers | None = None) -> str:
        """Wait until the operator resumes the run, or cancels it.

        Args:
            text: What happened and what to do.
            poll: Asked now and then where the run cannot be resumed from outside
                (``opentrons_execute``, notebooks): whether the cause is mended.
            page: Knows what is answered on the sidecar's page, and carries it out where the run can
                be resumed.

        Returns:
            Where it was answered: ``"robot"`` (its screen, or the App), ``"page"``,
            ``"console"``; empty in simulation, which does not pause.

        Raises:
            RunAborted: The operator chose so at the console or on the sidecar's page.
            Exception: Whatever Opentrons raises when the run is cancelled during its pause.
        """
        text = one_line(text, LONGEST)
        if self._simulating:
            self.comment(f"{text} (Simulation: on a robot the run would pause here.)")
            return ""
        if not can_be_resumed():
            return self._ask_at_console(text, poll, page)
        with page or nullcontext():
            with self._speaking():
                self._protocol.pause(f"aegis_ot: {text}")
            if self._legacy_run is not None:
                self._legacy_run.wait_for_play(self._protocol, self._rest)
        return "page" if page is not None and page.given else "robot"

    @contextmanager
    def _speaking(self) -> Iterator[None]:
        self.busy = True
        try:
            with nullcontext() if self._legacy_run is None else self._legacy_run.speaking():
                yield
        finally:
            self.busy = False

    def _ask_at_console(self, text: str, poll: Poll, page: PageAnswers | None) -> str:
        # pause() would hang for ever here: nothing can send the "play" that it waits for.
        has_console = _is_terminal()
        how = (
            "Type 'c' and Enter to continue, 'a' and Enter to abort"
            if has_console
            else "Answer on the sidecar's page, or interrupt the program"
        )
        _say(f"{text}\n{how}.")
        reminded = time.monotonic()
        try:
            while True:
                self._rest(_POLL_S)
                on_page = None if page is None else _ON_PAGE.get(page.ask(_ASK_S) or "")
                answer = on_page or (_typed() if has_console else None) or poll()
                if answer is OperatorAnswer.RESUME:
                    return "page" if on_page else "console"
                if answer is OperatorAnswer.ABORT:
                    raise RunAborted(f"The operator ended the run. {text}")
                if time.monotonic() - reminded > _REMIND_S:
                    reminded = time.monotonic()
                    _say(f"Still waiting. {how}.")
        finally:
            if page is not None:
                page.close()


@contextmanager
def _step_group(protocol: Any, name: str) -> Iterator[None]:
    """Shows commands as one step in the App, where it can (apiLevel 2.29)."""
    try:
        group = protocol.create_and_start_step_group(name)
    except Exception:  # an older level, or within a group of the protocol's: there is but one
        group = None
    try:
        yield
    finally:
        if group is not None:
            group.end_group()


def _say(text: str) -> None:
    print(f"aegis_ot: {text}", file=sys.stderr, flush=True)  # noqa: T201


def _is_terminal() -> bool:
    try:
        return sys.stdin is not None and sys.stdin.isatty()
    except (OSError, ValueError):
        return False


def _typed() -> OperatorAnswer | None:
    try:
        ready, _, _ = select.select([sys.stdin], [], [], 0)
        word = sys.stdin.readline().strip().lower() if ready else ""
    except (OSError, ValueError):
        return None
    if word in ("c", "continue", "resume"):
        return OperatorAnswer.RESUME
    if word in ("a", "abort", "stop"):
        return OperatorAnswer.ABORT
    return None
