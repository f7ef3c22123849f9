"""Reads a protocol that is a plain list of deliveries: its plan, and what each tip does."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..adapters.opentrons.instrumentation import Event, EventKind, Operation, OperationKind
from ..adapters.opentrons.rehearsal import Recording
from ..errors import ConfigurationError
from ..runtime.planner import Planner
from ..workbench.engines import EngineMissing, engine_for, need_of
from ..workbench.files import read_protocol
from ..workbench.rehearser import TaskFailed
from ..workbench.shelf import with_own_values
from ..workbench.side_by_side import LazyRehearser
from ..workbench.surroundings import Placed, root_of, surroundings_of
from ..workbench.tasks import RecordTask
from .rest import RehearsedDelivery

_TIMEOUT_S = 120.0
_MEANS_MORE = {
    "flow_rate": "sets flow rates", "default_speed": "sets speeds", "rate": "sets flow rates",
    "speed": "sets speeds", "push_out": "pushes out", "load_module": "uses a module",
    "load_adapter": "uses an adapter", "load_lid": "uses a lid",
    "configure_nozzle_layout": "uses some of the nozzles",
    "configure_for_volume": "configures a pipette", "set_offset": "sets offsets",
    "get_liquid_class": "uses liquid classes", "define_liquid_class": "uses liquid classes",
}  # fmt: skip
"""What a protocol may say that its record does not hold: by the name of attribute or argument."""
_ARGUMENTS = {
    "adapter": "uses an adapter", "lid": "uses a lid", "namespace": "names a namespace of labware",
    "version": "names a version of labware",
}  # fmt: skip
_POSITIONAL = {
    "load_labware": (3, "loads labware by more than name, slot and label"),
    "aspirate": (2, "sets flow rates"), "dispense": (2, "sets flow rates"),
}  # fmt: skip
"""By the name of the call: how many positional arguments its record holds."""
_EVENTS = {
    EventKind.MODULE: "uses a module", EventKind.PAUSED: "pauses",
    EventKind.LABWARE_MOVED: "moves labware", EventKind.LABWARE_MOVING: "moves labware",
    EventKind.TIPS_RESET: "replaces tips", EventKind.CUT_SHORT: "stops early",
}  # fmt: skip


class NotPlain(Exception):
    """The protocol does more than deliver; its text says what."""


@dataclass
class TipSession:
    """What one tip (or row of tips) does from pick-up to drop.

    Attributes:
        pipette: Mount.
        returns: Whether the tip goes back into its rack.
        deliveries: Draw and delivery, by the number of the delivery.
    """

    pipette: str
    returns: bool = False
    deliveries: dict[int, tuple[Operation, Operation]] = field(default_factory=dict)


def rehearsed(path: Path, labware: Mapping[str, Any], parameters: Mapping[str, Any]) -> Recording:
    """Rehearse a protocol where it lies, with the engine that fits it.

    Raises:
        ConfigurationError: It cannot be read or rehearsed.
        RehearsalError: It cannot be read, or the rehearsing process does not start.
    """
    try:
        text = read_protocol(path)
    except ConfigurationError as error:
        raise ConfigurationError(f"{path}: {error}") from None
    around = surroundings_of(path, text, root_of(path, (Path.cwd(),)))
    script = Placed(
        text=with_own_values(path, text),
        file_name=path.name,
        parameters=parameters,
        extra_labware=labware,
        folder=str(path.resolve().parent),
        modules=around.modules,
    )
    with LazyRehearser(()) as rehearsers:
        try:
            process = rehearsers.get(engine_for(need_of(text)))
            found: Recording = process.perform(RecordTask(script, _TIMEOUT_S))
        except (EngineMissing, TaskFailed) as error:
            told = error.problem.message if isinstance(error, TaskFailed) else str(error)
            raise ConfigurationError(f"{path} {told}") from None
    return found


def plan_of(recording: Recording) -> tuple[list[RehearsedDelivery], dict[str, float]]:
    """The protocol's deliveries in order, and what its wells are declared to hold, µL."""
    planner = Planner()
    began: dict[str, float] = {}
    for item in recording.log:
        if isinstance(item, Operation):
            planner.before(item)
            planner.after(item)
        else:
            planner.event(item)
            if item.kind is EventKind.LIQUID_LOADED and item.volume is not None:
                for well in item.wells:
                    began[well.address] = began.get(well.address, 0.0) + item.volume
    planner.finish()
    last = {k.trajectory: k for k in planner.keyframes if k.destinations}
    given_up = planner.about({})["planned"]
    count = max((k.trajectory for k in planner.keyframes), default=-1) + 1
    plan = [
        RehearsedDelivery(
            wells=[well.address for well in last[number].destinations],
            sources=[well.address for well in last[number].sources],
            volume_ul=last[number].commanded_ul,
            channels=last[number].channels,
        )
        if number in last and (number >= len(given_up) or given_up[number]["wells"])
        else RehearsedDelivery(wells=[])
        for number in range(count)
    ]
    return plan, began


def plain_tree(text: str) -> ast.Module:
    """Its syntax tree. Raises NotPlain where it says what its record does not hold."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        name = node.attr if isinstance(node, ast.Attribute) else None
        name = node.arg if isinstance(node, ast.keyword) else name
        if name in _MEANS_MORE:
            raise NotPlain(_MEANS_MORE[name])
        if isinstance(node, ast.keyword) and name in _ARGUMENTS:
            raise NotPlain(_ARGUMENTS[name])
        if isinstance(node, ast.FunctionDef) and (others := _decorators(node) - {"guard"}):
            raise NotPlain(f"{node.name}() does what @{min(others)} makes of it")
        if isinstance(node, ast.Call):
            called = node.func.attr if isinstance(node.func, ast.Attribute) else ""
            most, more = _POSITIONAL.get(called, (len(node.args), ""))
            unread = any(isinstance(arg, ast.Starred) for arg in node.args) or any(
                keyword.arg is None for keyword in node.keywords
            )
            if more and (unread or len(node.args) > most):
                raise NotPlain(more)
    return tree


def _decorators(function: ast.FunctionDef) -> set[str]:
    calls = (d.func if isinstance(d, ast.Call) else d for d in function.decorator_list)
    return {ast.unparse(one).split(".")[-1] for one in calls}


def tip_sessions(log: Sequence[Operation | Event]) -> list[TipSession]:
    """What its tips do, in order. Raises NotPlain where that is more than draw and deliver."""
    sessions: list[TipSession] = []
    on: dict[str, TipSession] = {}
    drawn: dict[str, Operation] = {}
    number = 0
    for item in log:
        if isinstance(item, Event):
            if item.kind in _EVENTS:
                raise NotPlain(_EVENTS[item.kind])
            continue
        mount, kind = item.pipette.mount, item.kind
        if kind is OperationKind.MOVE:
            continue
        if item.mixing or item.is_air or kind in (OperationKind.BLOW_OUT, OperationKind.TOUCH_TIP):
            raise NotPlain(
                f"it does more with a tip than draw and deliver ({item.call or kind.value})"
            )
        if len(item.nozzles) != item.pipette.channels:
            raise NotPlain("uses some of the nozzles")
        if kind is OperationKind.PICK_UP_TIP:
            on[mount] = TipSession(mount)
            sessions.append(on[mount])
        elif kind is OperationKind.DROP_TIP:
            on.pop(mount).returns = not item.disposal
        elif kind is OperationKind.ASPIRATE and mount not in drawn and item.well is not None:
            drawn[mount] = item
        elif kind is OperationKind.DISPENSE and mount in drawn and item.well is not None:
            draw = drawn.pop(mount)
            if abs(draw.volume - item.volume) > 0.01 or mount not in on:
                raise NotPlain("it draws once and delivers in parts")
            on[mount].deliveries[number] = draw, item
            number += 1
        else:
            raise NotPlain("it draws or delivers in parts, or elsewhere than in wells")
    if drawn or on:
        raise NotPlain("it ends with a tip on")
    return [session for session in sessions if session.deliveries]
