"""One run as the sidecar lives through it: keyframes in, verdicts out."""

from __future__ import annotations

import logging
import math
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from ..errors import StoreError
from ..run_view import RECOVERY
from ..vision.camera import Frame
from ..vision.view import ViewWatch
from ..vocabulary import Keyframe, Outcome, Verdict
from .alerts import Alerts, RunTrouble
from .analysis import Analyser
from .bell import Bell
from .journal import event
from .orders import Orders
from .run_record import RunRecord
from .run_verdicts import RunVerdicts
from .store import SILENT, Captured, Store
from .wire import Action, Decision, HoldReport, OrderRequest, WireError
from .worker import AnalysisWorker

log = logging.getLogger(__name__)

Grab = Callable[[Keyframe, float, ViewWatch | None, float], Frame]
"""Grabs the first frame exposed at or after a moment and before another, in which the view shows
what it should; raises CameraError."""


UNSERVED = ("camera", "busy", "link")
LAYER1 = "layer1"
"""Resolutions of a pause that began because the robot was not served."""
OPERATOR = "operator"
"""Resolution of a hold that a person ordered."""
LATELY_S = 60.0
"""What the camera shows has nothing to do with a keyframe that is older, s."""


class RunSession:
    """One run in memory. Made from the store, so a restart loses nothing.

    Args:
        run: Identifier of the run; known to the store.
        store, analyser, bell: Shared by all sessions.
        grab: Takes a frame.
        alerts: Hears of bad verdicts and of trouble.
        operator_timeout: How long an undecided verdict is held back for the operator, s.
        view: Looks at each frame before it counts; ``None``: every frame counts.

    Attributes:
        asked: When it was last asked for, ``time.monotonic``, s.
        record: Writes what comes of the run.
        verdicts: As the robot and the page may see them.
        nonce: Of the start that it is; empty if its guard has none.
    """

    def __init__(
        self,
        run: str,
        store: Store,
        analyser: Analyser,
        bell: Bell,
        grab: Grab,
        alerts: Alerts,
        operator_timeout: float = 0.0,
        view: ViewWatch | None = None,
    ) -> None:
        self.run = run
        self.asked = time.monotonic()
        self._store = store
        self._bell = bell
        self._grab = grab
        self._trouble = RunTrouble(run, alerts)
        self.record = RunRecord(
            run, store, lambda why: self._trouble.begins("store", str(why)), bell.ring
        )
        self._view = view
        self._capturing = threading.Lock()
        self._state = threading.Lock()
        start = store.start_of(run)
        self.nonce = "" if start is None else start.nonce
        store.forget_torn(run)
        self._next = store.next_sequence(run)
        self._at = 0
        self._kept_at = -math.inf
        self._known = {hold["trajectory"] for hold in store.holds(run)}
        judged = store.verdicts(run)
        self.verdicts = RunVerdicts(run, store, [v for v, _, _ in judged], operator_timeout)
        self._orders = Orders(store.actions(run), store.holds(run))
        self._paused: set[int] = set()
        self._worker = AnalysisWorker(
            run, analyser, [(v, evidence) for v, evidence, _ in judged], store, self._publish
        )
        self._resume()

    @property
    def idle(self) -> bool:
        """Whether every capture was analysed."""
        return self._worker.idle

    @property
    def empty(self) -> bool:
        """Whether nothing was captured yet: then the store alone knows all of it."""
        return self._next == 0

    def capture(self, keyframe: Keyframe, moment: float, until: float = math.inf) -> Captured:
        """Take the frame for a keyframe, keep both, and queue them for the analyser.

        Args:
            keyframe: From the robot.
            moment: When the request arrived, ``time.monotonic``, s.
            until: How long the robot surely stands still, likewise.

        Returns:
            What was kept, now or when the same keyframe came before.

        Raises:
            WireError: 409, with the number expected, if one is missing or taken.
            CameraError: No frame in time, or none that tells anything; the number is not used up.
            StoreError: It could not be kept; the number is not used up.
        """
        # A resent keyframe waits here for its twin, and is then answered from the store.
        with self._capturing:
            if keyframe.sequence < self._next:
                return self._again(keyframe)
            if keyframe.sequence > self._next:
                raise WireError(
                    409,
                    "gap",
                    f"Keyframe {keyframe.sequence} came, but {self._next} is the next.",
                    "Resend from the expected number.",
                    expected=self._next,
                )
            frame = self._grab(keyframe, moment, self._view, until)
            captured = Captured(keyframe, max(0.0, frame.exposed_at - moment), time.time())
            try:
                if frame.simulated:
                    self._store.mark_simulated(self.run)
                self._store.add_keyframe(captured, frame.jpeg)
                self._store.reopen(self.run)
            except StoreError as error:
                self._trouble.begins("store", str(error))
                raise
            self._next += 1
            self._at, self._kept_at = keyframe.trajectory, time.monotonic()
            self._known.add(keyframe.trajectory)
            self._resumed()
            self._worker.submit(keyframe, frame)
            with self._trouble.at_most_logged():  # it is kept, and in the analyser's queue
                self.catch_up()
                self._trouble.look_at_clocks(keyframe)
        self._bell.ring()
        return captured

    def ask(self, trajectory: int) -> Verdict | None:
        """The robot asks for a verdict; ``None`` where it has to ask again."""
        is_new = self.verdicts.note_question(trajectory)
        verdict = self.verdicts.for_robot(trajectory)
        if is_new and verdict is None:
            self._bell.ring()
        return verdict

    @property
    def under_way(self) -> int | None:
        """The delivery of the last keyframe, if that was kept lately: what the camera shows now
        has to do with it."""
        lately = time.monotonic() - self._kept_at < LATELY_S
        return self._at if lately else None

    def abandon(self, trajectory: int, reason: str) -> None:
        """The trajectory will have no further keyframes and needs no verdict."""
        self._worker.drop(trajectory)
        self.record.abandon(trajectory, reason)

    def held(self, hold: HoldReport, watched: bool) -> None:
        """The robot says how a hold ended: by a pause, if the operator is to look at the well.

        Args:
            hold: What it says.
            watched: Whether the run carries no guard: its keyframes come in a pause, too.
        """
        with self._state:
            self._known.add(hold.trajectory)
            verdict = self.verdicts.measured.get(hold.trajectory)
            unsure = verdict is not None and verdict.outcome is Outcome.UNDECIDED
            if hold.resolution in (OPERATOR, LAYER1, RECOVERY, *UNSERVED):
                self._orders.taken()
            elif hold.policy == "pause" and unsure and not watched:
                self._paused.add(hold.trajectory)
        self.record.hold(hold)

    def _resumed(self) -> None:
        """The robot moves: whoever was asked by a pause has looked, and let the run go on."""
        with self._state:
            paused, self._paused = self._paused, set()
        for trajectory in sorted(paused):
            if trajectory not in self.verdicts.decisions:
                self._worker.confirm(trajectory)

    def decide(self, trajectory: int, decision: Decision) -> Verdict:
        """The operator confirms or corrects a verdict; deciding again is allowed.

        Raises:
            WireError: 404 if there is no such delivery, 409 if there is no verdict yet.
        """
        self._require_known(trajectory)
        verdict, row, decided = self.verdicts.decide(trajectory, decision, not self.idle)
        if decision.outcome is Outcome.PASS and verdict.outcome is Outcome.UNDECIDED:
            self._worker.confirm(trajectory)
        self.record.decision(trajectory, decision, row)
        return decided

    def act(self, trajectory: int, action: Action) -> None:
        """A person tells the robot, paused at this trajectory, to go on or to end the run; to end
        it, wherever the robot is.

        Raises:
            WireError: 404 if there is no such delivery, 409 if the run has ended, or is to end.
        """
        self._require_known(trajectory)
        self._require_running()
        at = time.time()
        with self._state:
            self._orders.require_going_on(action)
            self._orders.answer(trajectory, action, at)
        self.record.action(trajectory, action, at)
        event("action", run=self.run, trajectory=trajectory, action=action.action, by=action.by)

    def order(self, order: OrderRequest) -> None:
        """A person tells the moving robot to pause, or to end the run, at its next exchange.

        Raises:
            WireError: 409 if the run has ended, or is to end.
        """
        self._require_running()
        at, trajectory = time.time(), self._at
        with self._state:
            self._orders.require_going_on(order)
            self._orders.order(order, at)
        self.record.action(trajectory, order, at)
        event("action", run=self.run, action=order.action, by=order.by)

    def action(self, trajectory: int, within_s: float | None = None) -> dict[str, Any] | None:
        """What a person told the robot that is paused at this trajectory last, within the last so
        many seconds; ``None`` if nothing."""
        with self._state:
            return self._orders.answered(trajectory, within_s)

    def ordered(self) -> dict[str, Any] | None:
        """What the moving robot is to do, until it says that it does; ``None`` if nothing."""
        with self._state:
            return self._orders.pending

    def close(self) -> None:
        """End the worker. Idempotent."""
        self._worker.close()
        self.record.close()

    def _require_known(self, trajectory: int) -> None:
        if trajectory not in self._known:
            raise WireError(
                404,
                "no_such_delivery",
                f"This run has no delivery {trajectory}.",
                "Choose a well on the run's page.",
            )

    def _require_running(self) -> None:
        known = (self._store.run(self.run) or {}).get("finished")
        ended = next(iter(self.record.rows("end")), known)
        if ended and ended["outcome"] != SILENT:  # such a robot may stand in a pause still
            raise WireError(
                409,
                "ended",
                f"This run has ended ({ended['outcome']}); its robot hears of it no more.",
                "If it still moves, press stop on its own screen.",
            )

    def _again(self, keyframe: Keyframe) -> Captured:
        kept = self._store.keyframe(self.run, keyframe.sequence)
        if kept is None:
            raise StoreError(f"Keyframe {keyframe.sequence} is missing from the store.")
        # Whether it comes late is no part of the moment that it is for.
        if replace(kept.keyframe, late=keyframe.late) != keyframe:
            raise WireError(
                409,
                "taken",
                f"Keyframe {keyframe.sequence} was another moment: the "
                f"{kept.keyframe.kind.value} of trajectory {kept.keyframe.trajectory}, with other "
                "content than this one.",
                "A run that starts anew needs a new identifier.",
                expected=self._next,
            )
        if keyframe.late and not kept.keyframe.late:
            self.verdicts.withdraw(kept.keyframe)
        return kept

    def _resume(self) -> None:
        """Queue again what a killed sidecar had kept but not judged."""
        settled = self.verdicts.measured.keys() | self._store.abandoned(self.run).keys()
        for captured in self._store.keyframes(self.run):
            self._known.add(captured.keyframe.trajectory)
            if captured.keyframe.trajectory not in settled:
                self._worker.submit(captured.keyframe, None)

    def _publish(self, verdict: Verdict, evidence: dict[str, Any]) -> None:
        """Called by the worker. A verdict that cannot be kept still reaches the robot."""
        verdict = self.verdicts.as_it_counts(verdict)
        self.record.verdict(verdict, evidence)
        self.verdicts.add(verdict)
        self._bell.ring()
        event("verdict", run=self.run, trajectory=verdict.trajectory, outcome=verdict.outcome.value,
              route=verdict.route.value, gate=verdict.gate.value, score=verdict.score,
              failure=verdict.failure.value if verdict.failure else None)  # fmt: skip
        if verdict.outcome is not Outcome.PASS:
            self._trouble.bad(verdict)
        if said := evidence.get("model_trouble"):
            self._trouble.begins("model", str(said))
        elif evidence.get("costs"):
            with self._trouble.at_most_logged():  # a raise would end the run's analysis
                self._trouble.is_over("model")

    def catch_up(self) -> None:
        """The store takes what is written again: keep what it could not."""
        self.record.write()
        self._trouble.is_over("store")
