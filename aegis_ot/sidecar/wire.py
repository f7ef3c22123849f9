"""The bodies and errors of docs/reference/wire.md."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from ..vocabulary import Outcome, one_line

WIRE = 1
MAX_BODY = 64 * 1024
"""Longest body of a request, bytes. A keyframe of an 8-channel pipette takes about 2 kB."""
MAX_COUNT = 10_000_000
"""Largest sequence or trajectory number."""
MAX_WAIT = 1.0
"""Longest wait of one request for a verdict, s."""

Count = Annotated[int, Field(ge=0, le=MAX_COUNT)]
Word = Annotated[str, Field(max_length=200), AfterValidator(one_line)]
"""A name: one line that can be shown anywhere."""
Person = Annotated[str, Field(min_length=1, max_length=200), AfterValidator(one_line)]
Text = Annotated[str, Field(max_length=5000)]


class WireError(Exception):
    """An answer other than 200, in the wire's shape.

    Attributes:
        status: HTTP status.
        code: Word for programs.
        message: One sentence.
        hint: What to do.
        extra: Further members of the answer, beside ``error``.
    """

    def __init__(self, status: int, code: str, message: str, hint: str = "", **extra: Any) -> None:
        super().__init__(message)
        self.status = status
        self.code = code
        self.message = message
        self.hint = hint
        self.extra = extra

    def body(self) -> dict[str, Any]:
        """The answer's body."""
        error = {"code": self.code, "message": self.message, "hint": self.hint}
        return {"error": error, **self.extra}


class Body(BaseModel):
    """Base of request bodies. Unknown members are ignored: an older sidecar, a newer robot."""

    # Built when first used: to list runs, none is.
    model_config = ConfigDict(frozen=True, allow_inf_nan=False, defer_build=True)


class GuardWords(Body):
    """What the guard will do: its policies, and how long it waits for a verdict, s."""

    hold: Word = ""
    on_fail: Word = ""
    on_undecided: Word = ""
    on_link_loss: Word = ""
    verdict_timeout_s: Annotated[float, Field(ge=0, le=86_400)] | None = None
    recover: Word = ""


class Layer1Finding(Body):
    """One finding of Layer 1, for the page."""

    rule: Word
    severity: Word = "warning"
    message: Text = ""
    why: Text = ""
    fix: Text = ""
    lines: Annotated[list[int], Field(max_length=50)] = []
    wells: Annotated[list[Word], Field(max_length=50)] = []


class Layer1Open(Body):
    """A rule that Layer 1 could not judge."""

    rule: Word
    reason: Text = ""


class Layer1Words(Body):
    """What Layer 1 said of the protocol, for the page."""

    verdict: Word = ""
    findings: Annotated[list[Layer1Finding], Field(max_length=50)] = []
    more: Count = 0
    undecided: Annotated[list[Layer1Open], Field(max_length=50)] = []
    note: Text = ""


class PlateSize(Body):
    """A piece of labware that the run delivers into, and how many rows and columns it has."""

    labware: Word
    label: Word = ""
    slot: Word = ""
    rows: Annotated[int, Field(ge=1, le=100)]
    columns: Annotated[int, Field(ge=1, le=100)]


class RackLabel(Body):
    """A tip rack that the protocol gave a label: its lot, say."""

    slot: Word
    label: Word


class PlannedDelivery(Body):
    """A delivery of the rehearsal: the wells, none where it was given up."""

    labware: Word = ""
    wells: Annotated[list[Word], Field(max_length=384)] = []


class RunStart(Body):
    """A run registers. ``nonce`` is this start's own: drawn anew whenever a guard begins.

    ``plates`` and ``planned`` are what the rehearsal delivered, ``planned_wells`` into how many
    wells; of a long run ``planned`` holds the beginning.
    """

    run: str
    nonce: Word = ""
    protocol_sha256: Word = ""
    protocol: Word = ""
    title: Word = ""
    robot: Word = ""
    robot_name: Word = ""
    api_level: Word = ""
    simulated: bool = False
    started: float = 0.0
    package: Word = ""
    mode: Literal["guard", "watch"] = "guard"
    guard: GuardWords | None = None
    layer1: Layer1Words | None = None
    plates: Annotated[list[PlateSize], Field(max_length=100)] = []
    racks: Annotated[list[RackLabel], Field(max_length=100)] = []
    planned: Annotated[list[PlannedDelivery], Field(max_length=5000)] = []
    planned_wells: Count = 0

    def is_again(self, other: RunStart) -> bool:
        """Whether this is the same start, told once more, and not another one of this name.

        What one of both leaves out (an older guard, an older sidecar) tells nothing apart.
        """
        always = ("protocol", "robot", "robot_name", "simulated", "started", "mode")
        told = [
            (getattr(self, name), getattr(other, name)) for name in ("nonce", "protocol_sha256")
        ]
        return all(getattr(self, name) == getattr(other, name) for name in always) and all(
            mine == theirs for mine, theirs in told if mine and theirs
        )


class AbandonReport(Body):
    """A trajectory ends without further keyframes."""

    reason: Text = ""


class HoldReport(Body):
    """How long the robot held, what ended it, and what it does then.

    Told again, under the same number, when a pause is over, with how long it lasted and who ended
    it: ``"page"``, ``"robot"`` (its own screen, or the App) or ``"console"``. A guard that counts
    no holds has one for each trajectory. ``next`` is what the robot does when it goes on.
    """

    number: Count = 0
    trajectory: Count
    seconds: Annotated[float, Field(ge=0)]
    resolution: Word
    policy: Word | None = None
    paused_s: Annotated[float, Field(ge=0)] | None = None
    answered: Word | None = None
    next: Word = ""


class RecoveryReport(Body):
    """What the robot does by itself about a failed delivery, told when it begins and again when
    it has ended. ``by`` is the delivery that put it right, or failed to.
    """

    trajectory: Count
    attempt: Count
    action: Literal["retry", "top_up"]
    state: Literal["begun", "recovered", "failed", "refused"]
    by: Count | None = None
    text: Text = ""


class Incident(Body):
    """What befell a run on the robot's side: for so long the sidecar did not serve it, or it does
    otherwise than its rehearsal."""

    kind: Literal["link", "layer1"]
    seconds: Annotated[float, Field(ge=0, le=1e7)]
    text: Text = ""


class Finish(Body):
    """A run ends; ``layer1`` where that says another thing than at the start. ``trajectories`` and
    ``keyframes``: how many the robot itself had begun, and meant to have captured.
    """

    outcome: Literal["succeeded", "failed", "stopped", "aborted"]
    detail: Text = ""
    layer1: Layer1Words | None = None
    trajectories: Count | None = None
    keyframes: Count | None = None


class Decision(Body):
    """The operator decides a flagged trajectory."""

    outcome: Literal[Outcome.PASS, Outcome.FAIL]
    by: Person
    note: Text = ""


class Action(Body):
    """The operator tells a paused robot to go on, to try a failed step again, or to end the run."""

    action: Literal["resume", "retry", "stop"]
    by: Person
    note: Text = ""


class OrderRequest(Body):
    """The operator tells a robot that moves to pause, or to end the run."""

    action: Literal["pause", "stop"]
    by: Person
    note: Text = ""


def check_run(run: str) -> str:
    """``run`` itself, if it can name a run.

    Raises:
        WireError: 422, if it is empty, longer than 128 characters, or unprintable.
    """
    if not run or len(run) > 128 or not run.isprintable() or "/" in run or run.strip() != run:
        raise WireError(
            422,
            "run",
            "A run is named by 1 to 128 printable characters, without '/' or outer spaces.",
        )
    return run
