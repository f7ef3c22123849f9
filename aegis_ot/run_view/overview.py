"""A run as ``GET /v1/runs/{run}`` answers it: what page, report, notification and audit start from.

Plain JSON, so these types cost nothing and change nothing; mypy holds every reader to the names.
``docs/reference/wire.md`` describes the fields. An older guard or sidecar left some out: those are
``NotRequired``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypedDict

from ..vocabulary import NOT_AS_REHEARSED

if TYPE_CHECKING:  # pydantic brings it; Python has it from 3.11 on
    from typing_extensions import NotRequired


class LabwareEntry(TypedDict):
    """A piece of labware, and where it stood."""

    labware: str
    label: str
    slot: str


class WellEntry(LabwareEntry):
    """See :class:`~aegis_ot.vocabulary.WellRef`."""

    name: str


class KeyframeEntry(TypedDict, total=False):
    """See :class:`~aegis_ot.vocabulary.Keyframe`; with its frame's address and moments, s."""

    sequence: int
    trajectory: int
    kind: str
    pipette: str
    mount: str
    channels: int
    tip: str
    sources: list[WellEntry]
    destinations: list[WellEntry]
    commanded_ul: float
    expected_ul: float
    capacity_ul: float
    reagent: str | None
    line: int | None
    late: bool
    recovers: int | None
    nozzles: list[str]
    targets: list[WellEntry | None]
    liquid_found: bool | None
    captured: float
    exposed_after_s: float
    frame: str


class ChannelEntry(TypedDict):
    """See :class:`~aegis_ot.vocabulary.ChannelVerdict`."""

    nozzle: str
    well: WellEntry | None
    outcome: str
    failure: str | None
    reason: str
    measured_ul: float | None
    expected_ul: float | None


class VerdictEntry(TypedDict, total=False):
    """See :class:`~aegis_ot.vocabulary.Verdict`."""

    outcome: str
    route: str
    score: float | None
    gate: str
    failure: str | None
    reason: str
    measured_ul: float | None
    expected_ul: float | None
    left_ul: float | None
    left_sigma_ul: float | None
    channels: list[ChannelEntry]


class DecisionEntry(TypedDict):
    """What a person made of a verdict."""

    outcome: str
    by: str
    note: str
    at: float


class HoldEntry(TypedDict):
    """How long the robot held, and how that ended."""

    number: int
    trajectory: int
    seconds: float
    resolution: str
    policy: str | None
    paused_s: float | None
    answered: str | None
    at: float
    next: NotRequired[str | None]


class ActionEntry(TypedDict):
    """What a person told the robot to do."""

    trajectory: int
    action: str
    by: str
    note: str
    at: float


class IncidentEntry(TypedDict):
    """Trouble; ``ended`` is ``None`` while it lasts."""

    kind: str
    text: str
    at: float
    ended: float | None


class RecoveryEntry(TypedDict):
    """What the robot did by itself about a failed delivery."""

    trajectory: int
    attempt: int
    action: str
    state: str
    by: int | None
    text: str
    at: float


class DeliveryEntry(TypedDict):
    """One delivery: ``verdict`` as it stands, ``judged`` as the analyser gave it."""

    trajectory: int
    well: str
    keyframes: list[KeyframeEntry]
    verdict: VerdictEntry | None
    judged: VerdictEntry | None
    judged_at: float | None
    evidence: dict[str, Any]
    decisions: list[DecisionEntry]
    holds: list[HoldEntry]
    abandoned: str | None
    recovered: NotRequired[bool]
    unjudged: NotRequired[str | None]
    clip: NotRequired[str | None]
    awaiting: NotRequired[str | None]
    awaiting_s: NotRequired[float | None]
    held_for_s: NotRequired[float | None]


class PlannedEntry(TypedDict):
    """A delivery of the rehearsal."""

    labware: str
    wells: list[str]


class PlateEntry(LabwareEntry):
    """One that is delivered into, and its size."""

    rows: int
    columns: int


class EndEntry(TypedDict):
    """How a run ended."""

    at: float | None
    outcome: str
    detail: str | None
    trajectories: NotRequired[int | None]
    keyframes: NotRequired[int | None]


class RunEntry(TypedDict, total=False):
    """The run itself, as a list of runs has it."""

    run: str
    title: str
    protocol: str
    protocol_sha256: str
    robot: str
    robot_name: str
    api_level: str
    package: str
    mode: str
    simulated: bool
    registered: float
    finished: EndEntry | None
    guard: dict[str, Any] | None
    layer1: dict[str, Any] | None
    plates: list[PlateEntry]
    planned: list[PlannedEntry]
    planned_wells: int
    sidecar: dict[str, Any] | None


class RunOverview(RunEntry):
    """All that is known of a run."""

    trajectories: list[DeliveryEntry]
    costs: NotRequired[dict[str, Any] | None]
    actions: NotRequired[list[ActionEntry]]
    unrecorded: NotRequired[list[dict[str, Any]]]
    incidents: NotRequired[list[IncidentEntry]]
    recoveries: NotRequired[list[RecoveryEntry]]
    audit: NotRequired[dict[str, Any] | None]
    order: NotRequired[dict[str, Any] | None]
    version: NotRequired[int]


def last_keyframe(entry: DeliveryEntry) -> KeyframeEntry:
    """Of a delivery; empty where none is kept."""
    return entry["keyframes"][-1] if entry["keyframes"] else {}


def verdict_of(entry: DeliveryEntry) -> VerdictEntry:
    """As it stands; empty before there is one."""
    return entry["verdict"] or {}


def channels_of(entry: DeliveryEntry) -> list[ChannelEntry]:
    """What its verdict says of each tip of a row."""
    return verdict_of(entry).get("channels") or []


def well_name(channel: ChannelEntry) -> str | None:
    """The well below a tip; ``None`` over no well."""
    return channel["well"]["name"] if channel["well"] else None


def is_not_as_rehearsed(overview: RunOverview) -> bool:
    """Whether the robot did otherwise than what Layer 1 had judged."""
    return (overview.get("layer1") or {}).get("verdict") == NOT_AS_REHEARSED
