"""What must be true after each incident: nothing lost, nothing hanging, everything named."""

from __future__ import annotations

import json
import urllib.request
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path

from aegis_ot.sidecar.store import Store

from .robot import Acknowledged

_DIRECT = urllib.request.build_opener(urllib.request.ProxyHandler({}))


def problems(
    folder: Path, url: str, run: str, told: Acknowledged, wanted: Mapping[str, int]
) -> list[str]:
    """All that is wrong after a run.

    Args:
        folder: The sidecar's data folder.
        url: Where the sidecar answers, for its report.
        run: Identifier.
        told: What it had acknowledged to the robot.
        wanted: Incidents that the report must name: kind, and how often at least.
    """
    store = Store(folder)
    try:
        kept = list(_lost(store, run, told)) + list(_hanging(store, run))
    finally:
        store.close()
    return kept + list(_unnamed(url, run, wanted))


def _lost(store: Store, run: str, told: Acknowledged) -> Iterator[str]:
    sequences = {one.keyframe.sequence for one in store.keyframes(run)}
    for sequence in sorted(told.keyframes):
        if sequence not in sequences:
            yield f"keyframe {sequence} was acknowledged and is lost"
        elif not store._frames.is_whole(run, sequence):
            yield f"the frame of keyframe {sequence} was acknowledged and is not whole"
    verdicts = {v.trajectory: v.outcome.value for v, _, _ in store.verdicts(run)}
    for number, outcome in sorted(told.verdicts.items()):
        if verdicts.get(number) != outcome:
            yield f"delivery {number} was told to be {outcome}, kept is {verdicts.get(number)}"
    held = {hold["trajectory"] for hold in store.holds(run)}
    for number in sorted(told.holds - held):
        yield f"the hold at delivery {number} was acknowledged and is lost"
    kept = ((store.run(run) or {}).get("finished") or {}).get("outcome")
    if kept != told.finished:
        yield f"the run's end was told as {told.finished or 'nothing'}, kept is {kept}"


def _hanging(store: Store, run: str) -> Iterator[str]:
    verdicts = {v.trajectory for v, _, _ in store.verdicts(run)}
    holds = store.holds(run)
    settled = verdicts | store.abandoned(run).keys() | {hold["trajectory"] for hold in holds}
    open_ = {one.keyframe.trajectory for one in store.keyframes(run)} - settled
    if open_:
        yield f"deliveries {sorted(open_)} have neither verdict nor end"
    for hold in holds:
        if hold["policy"] == "pause" and hold["paused_s"] is None:
            yield f"the pause at delivery {hold['trajectory']} never ended"
    for incident in store.incidents(run):
        if incident["ended"] is None:
            yield f"the incident {incident['kind']!r} never ended: {incident['text']}"


def _unnamed(url: str, run: str, wanted: Mapping[str, int]) -> Iterator[str]:
    report = json.loads(_get(f"{url}/runs/{run}/report.json"))
    page = _get(f"{url}/runs/{run}/report.html").decode()
    found = Counter(incident["kind"] for incident in report["incidents"])
    for kind, times in wanted.items():
        if found[kind] < times:
            yield f"the report names {found[kind]} incidents {kind!r}, {times} happened"
    for incident in report["incidents"]:
        if incident["kind"] not in page:
            yield f"the HTML report does not name the incident {incident['kind']!r}"


def _get(url: str) -> bytes:
    with _DIRECT.open(url, timeout=20) as answer:
        return bytes(answer.read())
