"""What the robot's server says, as far as it is used here. Fields that it leaves out are empty."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime, timezone
from typing import Any

from .deck_needs import Needs, needs_of
from .places import Place, places_of

ENDED = frozenset({"succeeded", "failed", "stopped"})
"""Run statuses after which nothing moves."""
DONE = frozenset({"succeeded", "failed"})
"""Command statuses after which the command is over."""

OWN_WORDS = "aegis_ot: "
"""How comments and pause messages of a guard begin."""


@dataclass(frozen=True)
class Pipette:
    """A pipette of a run.

    Attributes:
        id: As commands name it.
        name: ``"p300_single_gen2"``.
        mount: ``"left"`` or ``"right"``.
    """

    id: str
    name: str
    mount: str


@dataclass(frozen=True)
class Labware:
    """A labware of a run; ``slot`` is empty off the deck."""

    id: str
    load_name: str
    uri: str
    label: str
    slot: str


@dataclass(frozen=True)
class Command:
    """One command of a run.

    Attributes:
        index: Its place in the run, from 0.
        kind: ``"aspirate"``, ``"comment"``, ``"waitForResume"``...
        status: ``"queued"``, ``"running"``, ``"succeeded"`` or ``"failed"``.
        params: As the server has them.
        started, completed: Seconds since the epoch on the robot's clock, or ``None``.
        error: Why it failed, in words.
        error_kind: Likewise, ``"liquidNotFound"``...
        id: As the server names it.
    """

    index: int
    kind: str
    status: str
    params: Mapping[str, Any]
    started: float | None = None
    completed: float | None = None
    error: str = ""
    error_kind: str = ""
    id: str = ""

    @property
    def message(self) -> str:
        """Text of a comment or pause."""
        return str(self.params.get("message") or "")

    @property
    def is_guards(self) -> bool:
        """Whether it is a comment or pause of a guard."""
        return self.kind in ("comment", "waitForResume") and self.message.startswith(OWN_WORDS)


@dataclass(frozen=True)
class Page:
    """A slice of a run's commands; ``total`` counts all that there are so far."""

    commands: tuple[Command, ...]
    total: int


@dataclass(frozen=True)
class RunSnapshot:
    """A run as its server shows it.

    Attributes:
        id: Identifier.
        status: ``"idle"``, ``"running"``, ``"paused"``, ``"stop-requested"``, ``"succeeded"``...
        protocol: Identifier of its protocol, or ``""``.
        errors: What ended it, in words.
        pipettes, labware: Loaded so far.
        actions: ``"play"``, ``"pause"``, ``"stop"``: what people and programs did.
        liquids: Names of the liquids that it declares, by identifier.
        lost: Whether the server has lost what it was: it was restarted meanwhile.
    """

    id: str
    status: str
    protocol: str = ""
    errors: tuple[str, ...] = ()
    pipettes: tuple[Pipette, ...] = ()
    labware: tuple[Labware, ...] = ()
    actions: tuple[str, ...] = ()
    liquids: Mapping[str, str] = field(default_factory=dict)
    lost: bool = False

    @property
    def ended(self) -> bool:
        """Whether nothing moves any more."""
        return self.status in ENDED


@dataclass(frozen=True)
class Analysis:
    """The server's analysis of a protocol.

    Attributes:
        id: Identifier.
        done: Whether it is completed.
        ok: Whether the protocol runs to its end.
        errors: What ended it, in words.
        kinds: Types of its commands, in order.
        guard_words: Comments of a guard, without their mark.
        places: Of the labware, wherever it stands in turn.
        needs: What else it uses on the deck.
        flex: Whether it is for a Flex.
        parameters: Names of its runtime parameters.
        files_lacking: Those that need a file and were given none.
    """

    id: str
    done: bool
    ok: bool = False
    errors: tuple[str, ...] = ()
    kinds: tuple[str, ...] = ()
    guard_words: tuple[str, ...] = field(default=())
    places: tuple[Place, ...] = ()
    needs: Needs = field(default=Needs())
    flex: bool = False
    parameters: tuple[str, ...] = ()
    files_lacking: tuple[str, ...] = ()


def read_analysis(data: Mapping[str, Any]) -> Analysis:
    """From ``/protocols/{id}/analyses``."""
    commands = [read_command(n, c) for n, c in enumerate(data.get("commands") or ())]
    parameters = data.get("runTimeParameters") or ()
    return Analysis(
        id=str(data.get("id", "")),
        done=data.get("status") == "completed",
        ok=data.get("result") == "ok",
        errors=tuple(_tell(error) for error in data.get("errors") or ()),
        kinds=tuple(command.kind for command in commands),
        guard_words=tuple(c.message[len(OWN_WORDS) :] for c in commands if c.is_guards),
        places=tuple(places_of(data.get("commands") or ())),
        needs=needs_of(data.get("commands") or ()),
        flex=str(data.get("robotType", "")).startswith("OT-3"),
        parameters=tuple(str(one.get("variableName", "")) for one in parameters),
        files_lacking=tuple(
            str(one.get("variableName", ""))
            for one in parameters
            if one.get("type") == "csv_file" and not one.get("file")
        ),
    )


def read_run(data: Mapping[str, Any]) -> RunSnapshot:
    """From ``/runs/{id}``."""
    return RunSnapshot(
        id=str(data["id"]),
        status=str(data.get("status", "")),
        protocol=str(data.get("protocolId") or ""),
        errors=tuple(_tell(error) for error in data.get("errors") or ()),
        pipettes=tuple(
            Pipette(str(p["id"]), str(p.get("pipetteName", "")), str(p.get("mount", "")))
            for p in data.get("pipettes") or ()
        ),
        labware=tuple(_read_labware(labware) for labware in data.get("labware") or ()),
        actions=tuple(str(a.get("actionType", "")) for a in data.get("actions") or ()),
        liquids={
            str(known["id"]): str(known.get("displayName", ""))
            for known in data.get("liquids") or ()
        },
        lost=data.get("ok") is False,
    )


def read_command(index: int, data: Mapping[str, Any]) -> Command:
    """From ``/runs/{id}/commands``."""
    error = data.get("error")
    return Command(
        index=index,
        kind=str(data.get("commandType", "")),
        status=str(data.get("status", "")),
        params=data.get("params") or {},
        started=read_time(data.get("startedAt")),
        completed=read_time(data.get("completedAt")),
        error=_tell(error) if error else "",
        error_kind=str(error.get("errorType") or "") if error else "",
        id=str(data.get("id", "")),
    )


def read_time(text: str | None) -> float | None:
    """Seconds since the epoch; the server writes UTC, with or without saying so."""
    if not text:
        return None
    moment = datetime.fromisoformat(text.replace("Z", "+00:00"))
    if moment.tzinfo is None:
        moment = moment.replace(tzinfo=timezone.utc)
    return moment.timestamp()


def _read_labware(data: Mapping[str, Any]) -> Labware:
    location = data.get("location")
    place = location if isinstance(location, Mapping) else {}
    load_name = str(data.get("loadName", ""))
    return Labware(
        id=str(data["id"]),
        load_name=load_name,
        uri=str(data.get("definitionUri", "")),
        label=str(data.get("displayName") or load_name),
        slot=str(place.get("slotName") or place.get("addressableAreaName") or ""),
    )


def _tell(error: Mapping[str, Any]) -> str:
    """The innermost words, which are the protocol's own where it raised."""
    return str(error.get("detail") or error.get("errorType") or "an error without words")
