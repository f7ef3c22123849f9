"""Scores one run while its robot moves on, in a thread that lasts as long as there is work."""

from __future__ import annotations

import logging
import math
import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from typing import Any

from ..errors import CameraError, StoreError
from ..vision.camera import Frame
from ..vocabulary import Keyframe, KeyframeKind, Verdict
from .analysis import Analyser, Judged, RunAnalysis, plain, tell_late, undecided
from .cameras.codec import decode_jpeg
from .store import Store

log = logging.getLogger(__name__)

FRAMES_IN_MEMORY = 8
"""Captured frames that may wait decoded; further ones are read from the store again, so that a
slow analyser costs time and not memory, and never holds up the robot's answer."""
HEAD_START_S = 0.005
"""How long scoring waits, s, so that the answer to the robot is out before both want the
interpreter; without it the answer took 3 ms more (measured on two cores)."""
LINGER_S = 10.0
"""How long a thread waits for more, s. A run that has nothing to score holds none: a robot may be
silent for hours, and whoever registers a thousand runs gets no thousand threads."""


class AnalysisWorker:
    """Feeds captures to the run's analyser in order, and hands on its verdicts.

    Whatever the analyser raises becomes an undecided verdict that says so.

    Args:
        run: Identifier of the run.
        analyser: Makes the run's analyser, in the worker thread, when there is something to score.
        history: What was judged before a restart.
        store: Where waiting frames are read from.
        publish: Called with each verdict and its plain evidence.
    """

    def __init__(
        self,
        run: str,
        analyser: Analyser,
        history: Sequence[Judged],
        store: Store,
        publish: Callable[[Verdict, dict[str, Any]], None],
    ) -> None:
        self._run = run
        self._analyser = analyser
        self._history = history
        self._store = store
        self._publish = publish
        self._tasks: deque[tuple[Keyframe, Frame | None, float]] = deque()
        self._confirmed: deque[int] = deque()
        self._frames_waiting = 0
        self._news = threading.Condition()
        self._closed = False
        self._busy = False
        self._dropped: set[int] = set()
        self._failed: dict[int, str] = {}
        self._seen: dict[int, set[KeyframeKind]] = {}
        self._analysis: RunAnalysis | None = None
        self._trouble: str | None = None
        self._thread: threading.Thread | None = None

    @property
    def idle(self) -> bool:
        """Whether everything submitted was dealt with."""
        with self._news:
            return not (self._tasks or self._busy) or not self._at_work

    @property
    def _at_work(self) -> bool:
        return self._thread is not None and self._thread.is_alive()

    def submit(self, keyframe: Keyframe, frame: Frame | None) -> None:
        """Queue a capture; ``None`` reads its frame from the store. Never blocks."""
        with self._news:
            if frame is not None and self._frames_waiting >= FRAMES_IN_MEMORY:
                frame = None
            self._frames_waiting += frame is not None
            self._tasks.append((keyframe, frame, time.monotonic() + HEAD_START_S))
            self._wake()

    def confirm(self, trajectory: int) -> None:
        """The operator found an undecided trajectory right: told before what comes after it."""
        with self._news:
            self._confirmed.append(trajectory)
            self._wake()

    def drop(self, trajectory: int) -> None:
        """The trajectory was abandoned: do not judge it."""
        with self._news:
            self._dropped.add(trajectory)

    def close(self, timeout: float = 2.0) -> None:
        """End after the capture in hand. What waits is in the store. Idempotent."""
        with self._news:
            self._closed = True
            self._news.notify()
            thread = self._thread
        if thread is not None:
            thread.join(timeout)

    def _wake(self) -> None:
        """There is work: a thread takes it. The caller holds the lock."""
        if self._closed:
            return
        if not self._at_work:
            name = f"analysis-{self._run}"
            self._thread = threading.Thread(target=self._work, name=name, daemon=True)
            self._thread.start()
        self._news.notify()

    def _work(self) -> None:
        self._begin()
        run = self._analysis
        while (task := self._next(run)) is not None:
            keyframe, frame, begin = task
            time.sleep(max(0.0, begin - time.monotonic()))
            if keyframe.trajectory in self._dropped:
                continue
            self._seen.setdefault(keyframe.trajectory, set()).add(keyframe.kind)
            if keyframe.late:
                self._failed[keyframe.trajectory] = tell_late(keyframe.kind)
            elif run is not None:
                self._observe(run, keyframe, frame)
            else:
                self._failed[keyframe.trajectory] = self._trouble or ""
            if keyframe.kind is KeyframeKind.POST_DISPENSE:
                self._publish(*self._judge(run, keyframe.trajectory))

    def _begin(self) -> None:
        """Make the run's analyser, once."""
        if self._trouble is not None:
            return
        self._trouble = ""
        try:
            self._analysis = self._analyser.begin(self._run, self._history)
        except Exception as error:
            log.exception("The analyser could not begin run %s", self._run)
            self._trouble = f"The analyser could not begin: {_say(error)}"

    def _next(self, run: RunAnalysis | None) -> tuple[Keyframe, Frame | None, float] | None:
        """What is to be scored next; ``None`` if the thread is to end."""
        with self._news:
            while True:
                self._busy = False
                if not self._closed and not self._tasks and not self._confirmed:
                    self._news.wait_for(self._has_news, LINGER_S)
                if self._closed or not (self._tasks or self._confirmed):
                    self._thread = None
                    return None
                self._busy = True
                if self._confirmed:
                    self._confirm(run, self._confirmed.popleft())
                    continue
                task = self._tasks.popleft()
                self._frames_waiting -= task[1] is not None
                return task

    def _has_news(self) -> bool:
        return bool(self._tasks or self._confirmed or self._closed)

    def _observe(self, run: RunAnalysis, keyframe: Keyframe, frame: Frame | None) -> None:
        try:
            self._store.settle(keyframe.run, keyframe.sequence)
            run.observe(keyframe, self._reload(keyframe) if frame is None else frame)
        except Exception as error:
            log.exception("Keyframe %d of run %s", keyframe.sequence, self._run)
            self._failed[keyframe.trajectory] = (
                f"The {keyframe.kind.value} frame could not be analysed: {_say(error)}"
            )

    def _confirm(self, run: RunAnalysis | None, trajectory: int) -> None:
        try:
            if run is not None:
                run.confirm(trajectory)
        except Exception:
            log.exception("Trajectory %d of run %s, confirmed", trajectory, self._run)

    def _judge(self, run: RunAnalysis | None, trajectory: int) -> tuple[Verdict, dict[str, Any]]:
        failed = self._failed.pop(trajectory, None)
        if self._seen.pop(trajectory, set()) != set(KeyframeKind):
            failed = failed or "Not all four of its moments are kept: nobody saw the others."
        if run is None or failed is not None:
            return undecided(self._run, trajectory, failed or "There is no analyser."), {}
        try:
            verdict, evidence = run.judge(trajectory)
            problem = _problem(verdict, self._run, trajectory)
            if problem:
                return undecided(self._run, trajectory, problem), {}
            return verdict, plain(evidence)
        except Exception as error:
            log.exception("Trajectory %d of run %s", trajectory, self._run)
            return undecided(self._run, trajectory, f"The analyser failed: {_say(error)}"), {}

    def _reload(self, keyframe: Keyframe) -> Frame:
        jpeg = self._store.frame(keyframe.run, keyframe.sequence)
        if jpeg is None:
            raise StoreError("its frame is not in the store")
        # The exposure's moment on the clock of an earlier process means nothing now.
        simulated = bool((self._store.run(keyframe.run) or {}).get("simulated"))
        return Frame(jpeg, decode_jpeg(jpeg), 0.0, simulated)


def _problem(verdict: Any, run: str, trajectory: int) -> str:
    """What is wrong with an analyser's verdict, or nothing."""
    if not isinstance(verdict, Verdict):
        return f"The analyser returned {type(verdict).__name__} and no verdict."
    if (verdict.run, verdict.trajectory) != (run, trajectory):
        return f"The analyser judged trajectory {verdict.trajectory} of run {verdict.run} instead."
    for name in ("score", "measured_ul", "expected_ul"):
        value = getattr(verdict, name)
        if value is not None and not math.isfinite(value):
            return f"The analyser's {name} is {value}, which is no number."
    return ""


def _say(error: Exception) -> str:
    text = str(error).splitlines()[0] if str(error) else ""
    if isinstance(error, (CameraError, StoreError)):
        return text
    return f"{type(error).__name__}: {text}" if text else type(error).__name__
