"""Where the content of each well of a run came from: what was meant, and what happened."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from .overview import (
    DeliveryEntry,
    KeyframeEntry,
    RunOverview,
    VerdictEntry,
    WellEntry,
    channels_of,
    verdict_of,
)
from .plates import GRAVITY, deliveries_begun, plates_of, row_and_column, row_letters, wells_of
from .states import state_of

FORMAT = "aegis-ot lineage"
VERSION = 1

Json = dict[str, Any]


def lineage_of(overview: RunOverview, hashes: Mapping[int, str]) -> Json:
    """The lineage of each well, as plain JSON.

    Returns:
        ``run`` and what is known of it; ``wells``, plate by plate in the order in which a plate
        reader reads them (A1, A2, ...), each with its ``deliveries``. A well that was planned and
        got nothing is there, without any. Volumes are in µL.
    """
    about = ("run", "title", "protocol", "protocol_sha256", "robot", "robot_name", "package",
             "registered", "finished")  # fmt: skip
    deliveries = list(_deliveries(overview, hashes))
    wells: dict[tuple[str, str], Json] = {}
    sizes = {plate.key: plate for plate in plates_of(overview)}
    planned = [
        {"labware": one["labware"], "name": name}
        for one in (overview.get("planned") or ())[deliveries_begun(overview) :]
        for name in one["wells"]
    ]
    for place in [*(one["into"] for one in deliveries), *planned]:
        key = str(place["labware"]), str(place["name"])
        wells.setdefault(key, {**_place(place), "still_planned": 0, "deliveries": []})
    for place in planned:
        wells[place["labware"], place["name"]]["still_planned"] += 1
    for one in deliveries:
        into = one.pop("into")
        wells[str(into["labware"]), str(into["name"])]["deliveries"].append(one)
    told = {plate["labware"]: plate for plate in overview.get("plates") or ()}
    order = {key: number for number, key in enumerate(dict.fromkeys(key[0] for key in wells))}
    for (labware, name), well in wells.items():
        if size := told.get(labware):
            well["label"] = well["label"] or size["label"]
            well["slot"] = well["slot"] or size["slot"]
        plate = sizes.get(labware)
        columns = len(plate.columns) if plate else 0
        row, column = row_and_column(name)
        well["read_order"] = row * columns + column + 1 if columns > column >= 0 else None
        states = [one["state"] for one in well["deliveries"]]
        well["state"] = min(states, key=GRAVITY.index) if states else "not delivered"
    found = sorted(
        wells.values(), key=lambda well: (order[well["labware"]], row_and_column(well["well"]))
    )
    return {
        "format": FORMAT,
        "version": VERSION,
        **{name: overview.get(name) for name in about},
        "frames": "simulated" if overview.get("simulated") else "real",
        "wells": found,
    }


def _deliveries(overview: RunOverview, hashes: Mapping[int, str]) -> Iterator[Json]:
    """Each delivery into each well; a row of eight tips is eight."""
    earlier: dict[str, list[int]] = {}
    for trajectory in overview["trajectories"]:
        keyframes = trajectory["keyframes"]
        last = next((k for k in reversed(keyframes) if k["destinations"]), None)
        if last is None:
            continue
        for channel, into in _targets(last):
            tip = tip_of(last, channel)
            yield {
                "into": into,
                "delivery": trajectory["trajectory"],
                "recovers": last.get("recovers"),
                "at": last["captured"],
                "line": last.get("line"),
                "pipette": last["pipette"],
                "mount": last["mount"],
                "nozzle": last["nozzles"][channel] if last.get("nozzles") else None,
                "tip": tip,
                "earlier_with_tip": [*earlier.get(tip, ())],
                "reagent": last.get("reagent"),
                "sources": [_place(well) for well in _sources(last, channel)],
                "commanded_ul": last["commanded_ul"],
                **_estimates(trajectory, last["channels"] > 1),
                **_judged(trajectory, into),
                "frames": [
                    {"moment": k["kind"], "sequence": k["sequence"],
                     "sha256": hashes.get(k["sequence"])}
                    for k in keyframes
                ],
            }  # fmt: skip
        for tip in {tip_of(last, channel) for channel in range(last["channels"])}:
            earlier.setdefault(tip, []).append(trajectory["trajectory"])


def _targets(keyframe: KeyframeEntry) -> Iterator[tuple[int, WellEntry]]:
    """The wells that a delivery goes into, each with the channel above it."""
    targets = keyframe.get("targets") or ()
    if targets:
        yield from ((n, well) for n, well in enumerate(targets) if well is not None)
    else:
        yield from ((min(n, keyframe["channels"] - 1), well)
                    for n, well in enumerate(keyframe["destinations"]))  # fmt: skip


def _sources(keyframe: KeyframeEntry, channel: int) -> Sequence[WellEntry]:
    sources = keyframe["sources"]
    return [sources[channel]] if len(sources) == keyframe["channels"] else sources


def tip_of(keyframe: KeyframeEntry, channel: int) -> str:
    """``"1:B1"``: the tip on a channel; a keyframe names the first one's."""
    first: str = keyframe["tip"]
    nozzles: Sequence[str] = keyframe.get("nozzles") or []
    rack, _, name = first.rpartition(":")
    if not channel or len(nozzles) <= channel or row_and_column(name)[0] < 0:
        return first
    row, column = row_and_column(name)
    from_row, from_column = row_and_column(nozzles[0])
    to_row, to_column = row_and_column(nozzles[channel])
    letter = row_letters(row + to_row - from_row)
    return f"{rack}:{letter}{column + to_column - from_column + 1}"


def _estimates(trajectory: DeliveryEntry, several: bool) -> Json:
    """What the camera tells of a single tip: drawn, left, and the difference, with standard
    uncertainties; of several tips it tells one's alone."""
    verdict: VerdictEntry = trajectory["judged"] or {}
    told = None if several else trajectory["evidence"].get("drawn_ul")
    drawn: list[float] = told if isinstance(told, list) and len(told) == 2 else []
    left = () if several else (verdict.get("left_ul"), verdict.get("left_sigma_ul"))
    read = [round(float(one), 2) for one in left if one is not None]
    both = bool(drawn) and len(read) == 2
    return {
        "drawn_ul": drawn[0] if drawn else None,
        "drawn_sigma_ul": drawn[1] if drawn else None,
        "left_ul": read[0] if read else None,
        "left_sigma_ul": read[1] if len(read) == 2 else None,
        "delivered_ul": round(drawn[0] - read[0], 2) if both else None,
        "delivered_sigma_ul": round(math.hypot(drawn[1], read[1]), 2) if both else None,
    }


def _judged(trajectory: DeliveryEntry, into: WellEntry) -> Json:
    """How the delivery into a well stands, and who said so."""
    verdict = verdict_of(trajectory)
    own = next(
        (one for one in channels_of(trajectory)
         if one["well"] and all(one["well"][key] == into[key] for key in ("name", "labware"))),
        None,
    )  # fmt: skip
    states = {view.well: view.state for _, view in wells_of(trajectory)}
    decisions = trajectory["decisions"]
    gate = verdict.get("gate")
    machine = gate if gate and gate != "none" else verdict.get("route")
    return {
        "state": states.get(str(into["name"]), state_of(trajectory)),
        "failure": (own or verdict).get("failure"),
        "reason": (own and own["reason"]) or verdict.get("reason") or trajectory["unjudged"]
        or trajectory["abandoned"],
        "decided_by": decisions[-1]["by"] if decisions else machine,
        "decisions": [{k: one[k] for k in ("outcome", "by", "note", "at")} for one in decisions],
    }  # fmt: skip


def _place(well: WellEntry) -> Json:
    return {
        "labware": str(well["labware"]),
        "label": str(well.get("label") or ""),
        "slot": str(well.get("slot") or ""),
        "well": str(well["name"]),
    }


def rows_of(lineage: Mapping[str, Any]) -> Iterator[tuple[Json, Json]]:
    """Each well with each of its deliveries; a well without any comes with an empty one."""
    for well in lineage["wells"]:
        yield from itertools.product([well], well["deliveries"] or [{}])
