"""The protocol that makes the deliveries which a stopped run left, where the run's own protocol is
a plain list of deliveries. Written from rehearsal and record; nothing is started."""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any

from ..adapters.opentrons.instrumentation import Event, EventKind, Operation, OperationKind
from ..adapters.opentrons.rehearsal import Recording
from ..vocabulary import WellRef, counted
from .plain_protocol import NotPlain, TipSession, plain_tree, plan_of, tip_sessions
from .rest import HeldWell, Rest

_LEVEL_OF_LIQUIDS = (2, 14)


def finishing_protocol(
    recording: Recording, rest: Rest, again: Sequence[int] = (), fresh_tips: bool = False
) -> str:
    """Write it.

    Args:
        recording: The rehearsal of the run's protocol.
        rest: What the run left, by the plan of that rehearsal.
        again: Deliveries that a person wants made again, whole.
        fresh_tips: Whether the racks are full again.

    Raises:
        NotPlain: The protocol does more than deliver, or other than the run; nothing is open; or
            tips do not suffice.
    """
    tree = plain_tree(recording.text)
    sessions = tip_sessions(recording.log)
    numbers = [number for session in sessions for number in session.deliveries]
    planned = [one.number for one in rest.deliveries]
    if numbers != planned:
        raise NotPlain("it delivers otherwise than one draw, one delivery")
    plan, _ = plan_of(recording)
    for one in rest.deliveries:
        known = plan[one.number]
        same = (one.wells, one.sources) == (known.wells, known.sources)
        if not same or abs((one.volume_ul or 0.0) - (known.volume_ul or 0.0)) > 0.01:
            raise NotPlain(f"delivery {one.number} of the run was another than the protocol's")
    wanted = {one.number for one in rest.deliveries if one.standing == "open"} | set(again)
    if not wanted:
        raise NotPlain("no delivery is open")
    fresh = _fresh_tips(recording, rest, fresh_tips)
    return "".join(f"{line}\n" for line in _lines(recording, tree, rest, sessions, wanted, fresh))


def _lines(
    recording: Recording,
    tree: ast.Module,
    rest: Rest,
    sessions: Sequence[TipSession],
    wanted: set[int],
    fresh: dict[str, list[str]],
) -> Iterator[str]:
    pipettes = {
        item.pipette.mount: item.pipette for item in recording.log if isinstance(item, Operation)
    }
    level, head = _head(tree)
    yield f'"""The rest of the run {_quoted(rest.run)} of {_quoted(recording.file)}.'
    yield ""
    yield f"Written from its record: {counted(len(wanted), 'delivery', 'deliveries')}."
    yield "Compare the deck with it before you run it."
    yield '"""'
    yield ""
    yield "from aegis_ot import guard"
    yield ""
    yield from head
    looked = [one for one in rest.deliveries if one.standing == "look" and one.number not in wanted]
    for one in looked:
        yield f"# Left out, look first: {_quoted(', '.join(one.wells))}: {_quoted(one.why)}"
    yield ""
    yield from _guard(tree)
    yield "def run(protocol):"
    used = {
        well.labware
        for session in sessions
        for pair in session.deliveries.values()
        for operation in pair
        for well in operation.wells
        if well is not None
    }
    names = {
        key: f"labware_{n}"
        for n, (key, info) in enumerate(recording.labware.items(), 1)
        if key in used or info.is_tip_rack
    }
    for key, info in recording.labware.items():
        if key in names:
            label = f", label={info.label!r}" if info.label else ""
            place = f"{info.load_name!r}, {info.slot!r}{label}"
            yield f"    {names[key]} = protocol.load_labware({place})"
    yield from _trash(tree)
    for mount, pipette in pipettes.items():
        yield f"    {mount} = protocol.load_instrument({pipette.name!r}, {mount!r})"
    if level >= _LEVEL_OF_LIQUIDS:
        sources = {s for one in rest.deliveries if one.number in wanted for s in one.sources}
        yield from _liquids(recording, rest, names, sources)
    for session in sessions:
        todo = [pair for number, pair in session.deliveries.items() if number in wanted]
        if not todo:
            continue
        rack, tip = _next_tip(fresh, pipettes[session.pipette].name, session, recording.log)
        yield f"    {session.pipette}.pick_up_tip({names[rack]}[{tip!r}])"
        for draw, give in todo:
            for word, operation in (("aspirate", draw), ("dispense", give)):
                volume = f"{operation.volume:.10g}"
                yield f"    {session.pipette}.{word}({volume}, {_place(operation, names)})"
        yield f"    {session.pipette}.{'return_tip' if session.returns else 'drop_tip'}()"


def _head(tree: ast.Module) -> tuple[tuple[int, int], list[str]]:
    """``metadata`` and ``requirements`` as the protocol has them."""
    lines, level = [], (0, 0)
    for node in tree.body:
        names = [t.id for t in node.targets if isinstance(t, ast.Name)] if isinstance(
            node, ast.Assign) else []  # fmt: skip
        if not isinstance(node, ast.Assign) or not {"metadata", "requirements"} & set(names):
            continue
        try:
            value = dict(ast.literal_eval(node.value))
        except (ValueError, TypeError):
            raise NotPlain(f"its {names[0]} is no literal") from None
        if "protocolName" in value:
            value["protocolName"] = f"Rest of {value['protocolName']}"
        if "apiLevel" in value:
            major, _, minor = str(value["apiLevel"]).partition(".")
            level = int(major), int(minor)
        lines.append(f"{names[0]} = {value!r}")
    return level, lines


def _guard(tree: ast.Module) -> Iterator[str]:
    """The guard of the protocol, where all that it is told is literal."""
    for node in ast.walk(tree):
        for one in node.decorator_list if isinstance(node, ast.FunctionDef) else ():
            if isinstance(one, ast.Call) and ast.unparse(one.func).split(".")[-1] == "guard":
                try:
                    kept = [f"{k.arg}={ast.literal_eval(k.value)!r}" for k in one.keywords if k.arg]
                except (ValueError, TypeError):
                    break
                yield f"@guard({', '.join(kept)})"
                return
    yield "@guard"


def _trash(tree: ast.Module) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            if node.func.attr == "load_waste_chute":
                yield "    protocol.load_waste_chute()"
            elif node.func.attr == "load_trash_bin":
                try:
                    place = ast.literal_eval(node.args[0])
                except (ValueError, TypeError, IndexError):
                    raise NotPlain("says where its trash is by no literal") from None
                yield f"    protocol.load_trash_bin({place!r})"


def _liquids(
    recording: Recording, rest: Rest, names: Mapping[str, str], sources: Collection[str]
) -> Iterator[str]:
    """What the wells hold now. Of an uncertain volume what judges more strictly: the least in a
    well that is drawn from, the most in one that is filled."""
    refs: dict[str, WellRef] = {}
    liquids: dict[str, str] = {}
    for item in recording.log:
        refs.update((one.address, one) for one in item.wells if one is not None)
        if isinstance(item, Event) and item.kind is EventKind.LIQUID_LOADED:
            liquids.update((well.address, item.text) for well in item.wells)
    for one in rest.deliveries:
        if one.standing != "open":
            of = " and ".join(dict.fromkeys(liquids.get(s, f"liquid of {s}") for s in one.sources))
            for well in one.wells:
                liquids.setdefault(well, of)
    made: dict[str, str] = {}
    for held in rest.wells:
        ref = refs.get(held.well)
        if ref is None or ref.labware not in names:
            continue
        place = f"{names[ref.labware]}[{ref.name!r}]"
        if held.began_ul is None:
            yield f"    # {place}: nobody told what it held; {-held.most_ul:.10g} µL were drawn."
            continue
        if held.most_ul - held.least_ul > 0.01:
            yield f"    # {place}: from {held.least_ul:.10g} to {held.most_ul:.10g} µL."
        volume = held.least_ul if held.well in sources else held.most_ul
        if volume > 0:
            liquid = liquids.get(held.well) or "unnamed"
            if liquid not in made:
                made[liquid] = f"liquid_{len(made) + 1}"
                yield (
                    f"    {made[liquid]} = protocol.define_liquid("
                    f"name={liquid!r}, description='', display_color='#88aacc')"
                )
            yield f"    {place}.load_liquid({made[liquid]}, {volume:.10g})"


def _fresh_tips(recording: Recording, rest: Rest, all_fresh: bool) -> dict[str, list[str]]:
    """Tips that are left in each rack, from the first one on that the protocol takes. The run may
    have dropped more than it showed: what its rehearsal picked up for the first delivery that did
    not begin, or before it, is taken for used: a delivery begins only after its draw."""
    used = {tip.tip for tip in rest.tips}
    begun = max(
        (one.number for one in rest.deliveries if one.tips or one.standing != "open"), default=-1
    )
    number = 0
    first: dict[str, str] = {}
    for item in recording.log:
        if isinstance(item, Operation):
            if item.kind is OperationKind.PICK_UP_TIP and item.well is not None:
                first.setdefault(item.well.labware, item.well.name)
                if number <= begun + 1:
                    used |= {well.address for well in item.wells if well is not None}
            number += item.kind is OperationKind.DISPENSE
    racks = {key: recording.labware[key] for key in first}
    if all_fresh:
        return {key: [*info.wells] for key, info in racks.items()}
    return {
        key: [name for name in [*info.wells][[*info.wells].index(first[key]) :]
              if f"{info.slot}:{name}" not in used]
        for key, info in racks.items()
    }  # fmt: skip


def _next_tip(
    fresh: dict[str, list[str]], pipette: str, session: TipSession, log: Sequence[Operation | Event]
) -> tuple[str, str]:
    """Rack and first tip of the next pick-up: from the racks that the pipette used."""
    picks = [
        item
        for item in log
        if isinstance(item, Operation)
        and item.kind is OperationKind.PICK_UP_TIP
        and item.pipette.mount == session.pipette
    ]
    count = len(picks[0].nozzles)
    for rack in dict.fromkeys(item.well.labware for item in picks if item.well is not None):
        left = fresh.get(rack, [])
        for name in left:
            row = [f"{letter}{name[1:]}" for letter in "ABCDEFGH"] if count == 8 else [name]
            if count in (1, 8) and set(row) <= set(left) and name == row[0]:
                fresh[rack] = [one for one in left if one not in row]
                return rack, name
    raise NotPlain(
        f"the racks of {pipette} hold too few tips for the rest: put fresh ones there and say "
        "--fresh-tips"
    )


def _place(operation: Operation, names: Mapping[str, str]) -> str:
    well = operation.wells[operation.lead] or operation.well
    assert well is not None
    place = f"{names[well.labware]}[{well.name!r}]"
    if operation.from_bottom is None:
        return place
    if operation.from_top is not None and operation.from_top >= 0:
        return f"{place}.top({operation.from_top:.4g})"
    return f"{place}.bottom({operation.from_bottom:.4g})"


def _quoted(text: str) -> str:
    """Fit for a comment or a docstring."""
    return " ".join(text.replace("\\", "/").replace('"', "'").split())


def block_of(rest: Rest) -> str:
    """What a protocol that finishes the work has to know, as Python."""

    def volume(held: HeldWell) -> str:
        told = "" if held.began_ul is not None else "  # change; nobody told what it held"
        span = f"({held.least_ul:.10g}, {held.most_ul:.10g})"
        exact = f"{held.least_ul:.10g}"
        same = held.most_ul - held.least_ul <= 0.01
        return f"    {held.well!r}: {exact if same else span},{told}"

    def delivery(number: int, sources: Sequence[str], wells: Sequence[str], ul: Any) -> str:
        return f"    ({list(sources)!r}, {list(wells)!r}, {ul!r}),  # delivery {number}"

    parts = [f"# What the run {_quoted(rest.run)} left.", "VOLUMES_UL = {",
             *(volume(held) for held in rest.wells), "}"]  # fmt: skip
    for name, standing in (("OPEN", "open"), ("LOOK", "look")):
        parts.append(f"{name} = [")
        parts += [
            delivery(one.number, one.sources, one.wells, one.volume_ul)
            for one in rest.deliveries
            if one.standing == standing
        ]
        parts.append("]")
    parts.append(f"USED_TIPS = {[tip.tip for tip in rest.tips]!r}")
    return "\n".join(parts) + "\n"
