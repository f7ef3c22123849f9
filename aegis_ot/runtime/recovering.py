"""Puts failed deliveries right without a person, where the settings and the policy allow it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from ..adapters.opentrons.instrumentation import Operation, OperationKind, Tap
from ..settings import Settings
from ..vocabulary import Outcome, Verdict, WellRef
from .pipette_state import in_place
from .recovery_policy import NotAllowed, Plan, plan_recovery
from .spare_tips import TipForecast, spare_tips
from .strokes import Strokes
from .summary import WatchSummary

Report = Callable[[Mapping[str, Any]], None]


@dataclass(frozen=True)
class TipKnowledge:
    """What Layer 1 knows of the tips of a run.

    Attributes:
        forecast: Which tips the run will use.
        touched: Wells that the tip has touched which last dispensed into a well, a well of which
            nothing is known counting as full; ``None`` if that cannot be told.
    """

    forecast: TipForecast
    touched: Callable[[WellRef], frozenset[WellRef] | None] = lambda well: None


@dataclass(frozen=True)
class RecoveryAnswer:
    """What is done about a judged delivery.

    Attributes:
        begins: Whether :meth:`RunRecoveries.carry_out` puts it right.
        refusal: Why it is left to a person, in a sentence; empty where that needs no words.
    """

    begins: bool = False
    refusal: str = ""


NO_RECOVERY = RecoveryAnswer()


class RunRecoveries:
    """The recoveries of one run.

    Args:
        settings: Policies and limits.
        tips: What Layer 1 knows of them.
        tap: Does operations again.
        say: Writes a comment into the run log.
        report: Tells the sidecar of a recovery (``RecoveryReport`` in the wire protocol).
        check: Raises when the run is being stopped.
        result: Recovered wells are counted here.

    Attributes:
        strokes: Has to hear of every operation and keyframe.
        of_mount: Which failed trajectory the pipettes are recovering just now.
    """

    def __init__(
        self,
        settings: Settings,
        tips: TipKnowledge,
        tap: Tap,
        say: Callable[[str], None],
        report: Report,
        check: Callable[[], None],
        result: WatchSummary,
    ) -> None:
        self._settings = settings
        self._tips = tips
        self._tap = tap
        self._say = say
        self._report = report
        self._check = check
        self._result = result
        self._due: tuple[Plan, int] | None = None
        self._attempts: Counter[int] = Counter()
        self._actions: dict[int, str] = {}
        self._words: dict[int, str] = {}
        self._spent: set[str] = set()
        self.strokes = Strokes()
        self.of_mount: dict[str, int] = {}

    @property
    def is_due(self) -> bool:
        """Whether something is to be put right before the protocol goes on."""
        return self._due is not None

    def judged(
        self, trajectory: int, verdict: Verdict | None, boundary: Operation | None
    ) -> RecoveryAnswer:
        """A hold has ended."""
        delivery = self.strokes.delivery(trajectory)
        recovers = None if delivery is None else delivery.keyframe.recovers
        root = trajectory if recovers is None else recovers
        if recovers is not None:
            self._ended(root, trajectory, verdict)
        if verdict is None or verdict.outcome is not Outcome.FAIL or verdict.failure is None:
            return NO_RECOVERY
        action = self._settings.recover.get(verdict.failure.value)
        if action is None:
            return NO_RECOVERY
        try:
            well = None if delivery is None else delivery.destination
            touched = None if well is None else self._tips.touched(well)
            plan = plan_recovery(action, delivery, verdict, boundary, touched)
            self._check_means(plan, root, boundary)
        except Exception as why:  # NotAllowed; or what nobody foresaw, which must not end the run
            self._actions[root] = action
            self._tell(root, "refused", f"Left to a person: {why}.", again=True)
            return RecoveryAnswer(refusal=f"The robot does not put it right by itself: {why}.")
        self._attempts[root] += 1
        self._actions[root] = action
        self._due = (plan, root)
        return RecoveryAnswer(begins=True)

    def carry_out(self) -> None:
        """Change the tip and do the delivery again; the watcher sees it like any other.

        Raises:
            Exception: Whatever Opentrons raises, and ``check`` when the run is being stopped.
        """
        assert self._due is not None
        (plan, root), self._due = self._due, None
        mount = plan.failed.mount
        words = _in_words(plan)
        self._words[root] = words
        self._say(f"Recovery {self._attempts[root]} of {self._settings.recover_limit}: {words}")
        self._tell(root, "begun", words)
        pipette = self._tap.instrument(mount)
        self._spent.discard(mount)
        self.of_mount[mount] = root
        try:
            if plan.saves:
                draws = (
                    stroke.operation
                    for stroke in plan.strokes
                    if stroke.operation.kind is OperationKind.ASPIRATE
                )
                source = next(draws).arguments["location"].labware.as_well()
                self._do(pipette, "blow_out", source.top())
            self._change_tip(pipette)
            for stroke in plan.strokes:
                self._check()
                self._tap.repeat(stroke.operation, stroke.volume)
        finally:
            del self.of_mount[mount]
        self._spent.add(mount)

    def needs_clean_tip(self, operation: Operation) -> bool:
        """Whether ``operation`` would take a recovery's tip to further wells."""
        mount = operation.pipette.mount
        if mount not in self._spent or operation.kind is OperationKind.DROP_TIP:
            self._spent.discard(mount)
            return False
        return not (operation.disposal or in_place(operation))

    def give_clean_tip(self, operation: Operation) -> None:
        """Change a recovery's tip before the protocol goes on with ``operation``.

        Raises:
            Exception: Whatever Opentrons raises.
        """
        self._spent.discard(operation.pipette.mount)
        self._change_tip(self._tap.instrument(operation.pipette.mount))

    def _check_means(self, plan: Plan, root: int, boundary: Operation | None) -> None:
        settings, forecast = self._settings, self._tips.forecast
        mount = plan.failed.mount
        if self._due is not None or self.of_mount:
            raise NotAllowed("another delivery is being put right")
        if self._attempts[root] >= settings.recover_limit:
            raise NotAllowed(f"it was tried {self._attempts[root]} times")
        if self._attempts.total() >= settings.recover_run_limit:
            raise NotAllowed(f"this run has had {self._attempts.total()} recoveries")
        if not forecast.complete:
            raise NotAllowed("the protocol was not rehearsed, so nobody knows its spare tips")
        if mount in forecast.returning:
            raise NotAllowed("the protocol puts tips back")
        pipette = self._tap.instrument(mount)
        if plan.missing_ul < float(pipette.min_volume):
            raise NotAllowed(f"{plan.missing_ul:g} µL are less than {pipette.name} can handle")
        try:
            pipette.trash_container  # noqa: B018
        except Exception:  # a Flex without a trash bin
            raise NotAllowed("there is no trash for the failed tip") from None
        drops = boundary is not None and boundary.kind is OperationKind.DROP_TIP
        # A tip that has been to a well that failed goes to no other.
        # Other pipettes may owe a clean tip from the same racks.
        needed = (1 if drops else 2) + len(self._spent - {mount})
        if len(spare_tips(pipette, forecast, self._tap.slot_of)) < needed:
            raise NotAllowed("no tip is left that the protocol does not need itself")

    def _change_tip(self, pipette: Any) -> None:
        (fresh, *_) = spare_tips(pipette, self._tips.forecast, self._tap.slot_of)
        self._do(pipette, "drop_tip")
        self._do(pipette, "pick_up_tip", fresh)

    def _do(self, pipette: Any, name: str, *args: Any) -> None:
        self._check()
        # The class's own: a protocol may have put another method in front on its instance.
        getattr(type(pipette), name)(pipette, *args)

    def _ended(self, root: int, trajectory: int, verdict: Verdict | None) -> None:
        self._result.attempts[trajectory] = root
        if verdict is not None and verdict.outcome is Outcome.PASS:
            self._result.recovered.add(root)
            state, said = "recovered", "It was seen to pass."
        else:
            state = "failed"
            said = "There is no verdict on it." if verdict is None else verdict.reason
        self._tell(root, state, f"{self._words[root]} {said}", trajectory)

    def _tell(
        self, root: int, state: str, text: str, by: int | None = None, again: bool = False
    ) -> None:
        self._report(
            {
                "trajectory": root,
                "attempt": self._attempts[root] + again,
                "action": self._actions[root],
                "state": state,
                "by": by,
                "text": text[:2000],
            }
        )


def _in_words(plan: Plan) -> str:
    well = plan.failed.destinations[0]
    source = " and ".join(str(one) for one in plan.failed.sources)
    saved = "what is left in the tip goes back to its source, " if plan.saves else ""
    again = "again" if plan.action == "retry" else "more"
    words = (
        f"{saved}the failed tip goes to the trash, and a fresh one delivers "
        f"{plan.missing_ul:g} µL {again} from {source} into {well}."
    )
    return words[0].upper() + words[1:]
