"""The verdicts of one run, as its robot and the page may see them."""

from __future__ import annotations

import threading
import time

from ..run_view.overview import DecisionEntry
from ..vocabulary import Keyframe, Outcome, Verdict
from .analysis import tell_late, undecided
from .decisions import effective
from .overview import run_overview
from .store import Store
from .wire import Decision, WireError

ASKS_S = 3.0
"""A robot that holds asks every 0.15 s; one that has not asked for so long does something else."""


class RunVerdicts:
    """Analyser's verdicts, operator's decisions, and who waits for which. Safe to use from threads.

    Args:
        run: Identifier of the run.
        store: Holds those of before a restart.
        judged: The verdicts that it holds.
        operator_timeout: How long an undecided verdict is held back for the operator, s.

    Attributes:
        measured: The analyser's, by delivery.
        decisions: What people decided of them, oldest first.
    """

    def __init__(
        self, run: str, store: Store, judged: list[Verdict], operator_timeout: float
    ) -> None:
        self._run, self._store = run, store
        self._operator_timeout = operator_timeout
        self._lock = threading.Lock()
        self.measured = {verdict.trajectory: verdict for verdict in judged}
        self.decisions = store.decisions(run)
        self._late: set[int] = set()
        self._release: dict[int, float] = {}
        self._asks: dict[int, tuple[float, float]] = {}

    def for_robot(self, trajectory: int) -> Verdict | None:
        """The verdict as the robot may see it now; ``None`` while the operator is waited for."""
        with self._lock:
            verdict = self.measured.get(trajectory)
            if verdict is None or self._is_held_back(trajectory):
                return None
            return effective(verdict, self.decisions.get(trajectory, []))

    def note_question(self, trajectory: int) -> bool:
        """The robot asks for a verdict, again and again while it holds; whether it is the first
        time."""
        now = time.monotonic()
        with self._lock:
            first, last = self._asks.get(trajectory, (now, now))
            is_new = trajectory not in self._asks
            self._asks[trajectory] = (first if now - last < ASKS_S else now, now)
        return is_new

    def held_for(self, trajectory: int) -> float | None:
        """For how long the robot has held for this verdict, s; ``None`` if it does not."""
        now = time.monotonic()
        with self._lock:
            first, last = self._asks.get(trajectory, (now, -ASKS_S))
            return now - first if now - last < ASKS_S else None

    def awaits_operator(self, trajectory: int) -> bool:
        """Whether an undecided verdict is being held back for the operator."""
        with self._lock:
            return self._is_held_back(trajectory)

    def operator_has(self, trajectory: int) -> float:
        """How long the verdict will still be held back for the operator, s."""
        return max(0.0, self._release.get(trajectory, 0.0) - time.monotonic())

    def as_it_counts(self, verdict: Verdict) -> Verdict:
        """An analyser's verdict, before it is kept: on a frame that came late it is none."""
        with self._lock:
            if verdict.trajectory in self._late:
                return undecided(self._run, verdict.trajectory, tell_late())
        return verdict

    def add(self, verdict: Verdict) -> None:
        """An analyser's verdict; an undecided one is first the operator's to see."""
        with self._lock:
            self.measured[verdict.trajectory] = verdict
            if verdict.outcome is Outcome.UNDECIDED and self._operator_timeout > 0:
                self._release[verdict.trajectory] = time.monotonic() + self._operator_timeout

    def withdraw(self, keyframe: Keyframe) -> None:
        """The robot moved on before it heard of this capture: the frame may show anything."""
        with self._lock:
            self._late.add(keyframe.trajectory)
            self._store.mark_late(self._run, keyframe.sequence)
            if keyframe.trajectory in self.measured:
                unseen = undecided(self._run, keyframe.trajectory, tell_late(keyframe.kind))
                self._store.withdraw_verdict(unseen)
                self.measured[keyframe.trajectory] = unseen

    def decide(
        self, trajectory: int, decision: Decision, analysing: bool
    ) -> tuple[Verdict, DecisionEntry, Verdict]:
        """The operator confirms or corrects a verdict; deciding again is allowed.

        Args:
            trajectory: The delivery.
            decision: What they say.
            analysing: Whether the analyser is at work, so that a verdict may come yet.

        Returns:
            The analyser's verdict, the decision as the run's overview shows it, and the verdict
            that follows.

        Raises:
            WireError: 409 if there is no verdict yet.
        """
        with self._lock:
            verdict = self.measured.get(trajectory) or self._give_up(trajectory, analysing)
            if verdict is None:
                raise WireError(409, "no_verdict", f"Trajectory {trajectory} has no verdict yet.")
            row: DecisionEntry = {
                "outcome": decision.outcome.value,
                "by": decision.by,
                "note": decision.note,
                "at": time.time(),
            }
            decided_so_far = self.decisions.setdefault(trajectory, [])
            decided_so_far.append(row)
            return verdict, row, effective(verdict, decided_so_far)

    def _give_up(self, trajectory: int, analysing: bool) -> Verdict | None:
        """Undecided, and a person's to decide, is a delivery of which no verdict will come."""
        deliveries = run_overview(self._store, self._run, analysing)["trajectories"]
        for delivery in deliveries:
            if delivery["trajectory"] == trajectory and delivery["unjudged"] is not None:
                verdict = undecided(self._run, trajectory, delivery["unjudged"])
                self._store.add_verdict(verdict, {})
                self.measured[trajectory] = verdict
                return verdict
        return None

    def _is_held_back(self, trajectory: int) -> bool:
        release = self._release.get(trajectory)
        return (
            release is not None and trajectory not in self.decisions and time.monotonic() < release
        )
