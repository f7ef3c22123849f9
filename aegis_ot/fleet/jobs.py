"""A protocol as a fleet sees it: its text, what it needs of a robot, and how long it takes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from ..adapters.opentrons.instrumentation import Operation, OperationKind
from ..adapters.opentrons.rehearsal import Script, record
from ..dryrun import read_script

_SECONDS = {
    OperationKind.PICK_UP_TIP: 6.0,
    OperationKind.DROP_TIP: 4.0,
    OperationKind.ASPIRATE: 3.0,
    OperationKind.DISPENSE: 3.0,
    OperationKind.BLOW_OUT: 1.5,
    OperationKind.AIR_GAP: 1.0,
    OperationKind.TOUCH_TIP: 2.0,
}
"""Motion of one operation at a robot's usual speeds, s: enough to order protocols by."""
_STROKE_S = 1.0
"""A whole stroke of a plunger takes about as long at Opentrons' default flow rates, s."""


@dataclass(frozen=True)
class JobNeeds:
    """What a protocol asks of a robot.

    Attributes:
        robot_type: ``"OT-2"`` or ``"Flex"``.
        pipettes: Opentrons pipette name by mount.
        modules: Models, ``"temperatureModuleV2"``, one for each that is loaded.
        labware: Load names, tip racks included.
    """

    robot_type: str
    pipettes: Mapping[str, str] = field(default_factory=dict)
    modules: tuple[str, ...] = ()
    labware: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Job:
    """One protocol that some robot shall run.

    Attributes:
        name: Unique in a fleet's run: the file name, numbered where it comes twice.
        script: The protocol.
        needs: What it asks of a robot.
        expected_s: Robot time as rehearsed: motion, strokes and waits, s.
        faults: Planted on simulated robots, ``"partial:50@B3"``; real ones have their own.
    """

    name: str
    script: Script
    needs: JobNeeds
    expected_s: float
    faults: tuple[str, ...] = ()

    def to_wire(self) -> dict[str, Any]:
        """What an agent is sent of it, as plain JSON values."""
        script = self.script
        return {
            "name": self.name,
            "script": {
                "text": script.text,
                "file_name": script.file_name,
                "parameters": dict(script.parameters),
                "extra_labware": dict(script.extra_labware),
            },
            "needs": asdict(self.needs) | {"labware": sorted(self.needs.labware)},
            "expected_s": self.expected_s,
            "faults": list(self.faults),
        }

    @classmethod
    def from_wire(cls, values: Mapping[str, Any]) -> Job:
        """The reverse of :meth:`to_wire`."""
        needs = values["needs"]
        return cls(
            str(values["name"]),
            Script(**values["script"]),
            JobNeeds(
                needs["robot_type"],
                dict(needs["pipettes"]),
                tuple(needs["modules"]),
                frozenset(needs["labware"]),
            ),
            float(values["expected_s"]),
            tuple(values["faults"]),
        )


def read_job(
    path: Path,
    labware: Sequence[Path] = (),
    parameters: Sequence[str] = (),
    faults: Sequence[str] = (),
    timeout_s: float = 120.0,
) -> Job:
    """Read a protocol file and rehearse it.

    Args:
        path, labware, parameters: As for :func:`aegis_ot.dryrun.read_script`.
        faults: As in :class:`Job`.
        timeout_s: Longest rehearsal, s.

    Raises:
        ConfigurationError: A file cannot be read.
        RehearsalError: It cannot be rehearsed.
    """
    script = read_script(path, labware, parameters)
    deck = _Deck()
    recording = record(script, timeout_s=timeout_s, look=deck.look)
    moving = sum(_seconds(step) for step in recording.log if isinstance(step, Operation))
    names = {info.load_name for info in recording.labware.values() if not info.is_trash}
    needs = JobNeeds(deck.robot_type, deck.pipettes, tuple(deck.modules), frozenset(names))
    return Job(path.name, script, needs, moving + deck.waits_s, tuple(faults))


def numbered(jobs: Sequence[Job]) -> list[Job]:
    """The same jobs under names that are unique."""
    seen: dict[str, int] = {}
    found: list[Job] = []
    for job in jobs:
        seen[job.name] = count = seen.get(job.name, 0) + 1
        name = job.name if count == 1 else f"{job.name} ({count})"
        found.append(Job(name, job.script, job.needs, job.expected_s, job.faults))
    return found


def _seconds(step: Operation) -> float:
    stroke = step.kind in (OperationKind.ASPIRATE, OperationKind.DISPENSE)
    return _SECONDS.get(step.kind, 0.0) + (_STROKE_S if stroke else 0.0)


class _Deck:
    """What a rehearsed protocol has loaded, and how long it waits."""

    def __init__(self) -> None:
        self.robot_type = "OT-2"
        self.pipettes: dict[str, str] = {}
        self.modules: list[str] = []
        self.waits_s = 0.0

    def look(self, context: Any) -> None:
        core = context._core
        self.robot_type = "Flex" if "OT-3" in str(core.robot_type) else "OT-2"
        self.pipettes = {
            mount: str(pipette.name) for mount, pipette in context.loaded_instruments.items()
        }
        self.modules = [
            str(getattr(module, "model", type(module).__name__))
            for module in context.loaded_modules.values()
        ]
        client = getattr(core, "_engine_client", None)
        if client is not None:  # before API level 2.14 a delay leaves no trace
            commands = client.state.commands.get_all()
            waits = [c for c in commands if c.commandType == "waitForDuration"]
            self.waits_s = float(sum(wait.params.seconds for wait in waits))
