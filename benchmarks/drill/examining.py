"""What must be true after each incident: nothing lost, nothing hanging, everything named."""

from __future__ import annotations

import json
import urllib.parse
import urllib.request
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path

from aegis_ot.sidecar.overview import runs_overview
from aegis_ot.sidecar.store import Store

from .robot import Acknowledged
from .workstation import exposed_at

_DIRECT = urllib.request.build_opener(urllib.request.ProxyHandler({}))


def problems(
    folder: Path,
    url: str,
    run: str,
    told: Acknowledged,
    wanted: Mapping[str, int],
    may_be_open: bool = False,
) -> list[str]:
    """All that is wrong after a run.

    Args:
        folder: The sidecar's data folder.
        url: Where the sidecar answers, for its report.
        run: Identifier.
        told: What it had acknowledged to the robot.
        wanted: Incidents that the report must name: kind, and how often at least.
        may_be_open: Whether deliveries may be left without a verdict.
    """
    store = Store(folder)
    try:
        kept = [*_lost(store, run, told), *_hanging(store, run, may_be_open)]
        kept += [*_unseen(store, run, told), *_miscounted(store, url, run)]
    finally:
        store.close()
    return kept + list(unnamed(url, run, wanted))


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


def _unseen(store: Store, run: str, told: Acknowledged) -> Iterator[str]:
    for sequence in sorted(told.keyframes):
        frame = store.frame(run, sequence)
        early = told.triggers[sequence] - exposed_at(frame) if frame else 0.0
        if early > 0:
            yield f"the frame of keyframe {sequence} was exposed {early:.2f} s before its trigger"


def _miscounted(store: Store, url: str, run: str) -> Iterator[str]:
    """A delivery without a verdict is undecided, in the report and in the list of runs."""
    judged = {verdict.trajectory for verdict, _, _ in store.verdicts(run)}
    report = json.loads(_get(f"{url}/runs/{run}/report.json"))
    states = {well["trajectory"]: well["state"] for well in report["wells"]}
    for number, state in states.items():
        if number not in judged and state not in ("undecided", "abandoned"):
            yield f"delivery {number} has no verdict and counts as {state}"
    (row,) = [row for row in runs_overview(store) if row["run"] == run]
    counted = sum(state != "abandoned" for state in states.values())
    if sum(wells for state, wells in row["wells"].items() if state != "abandoned") != counted:
        yield f"of {counted} deliveries the list of runs counts {row['wells']}"


def _hanging(store: Store, run: str, may_be_open: bool) -> Iterator[str]:
    verdicts = {v.trajectory for v, _, _ in store.verdicts(run)}
    holds = store.holds(run)
    settled = verdicts | store.abandoned(run).keys() | {hold["trajectory"] for hold in holds}
    open_ = {one.keyframe.trajectory for one in store.keyframes(run)} - settled
    if open_ and not may_be_open:
        yield f"deliveries {sorted(open_)} have neither verdict nor end"
    for hold in holds:
        if hold["policy"] == "pause" and hold["paused_s"] is None:
            yield f"the pause at delivery {hold['trajectory']} never ended"
    for incident in store.incidents(run):
        if incident["ended"] is None:
            yield f"the incident {incident['kind']!r} never ended: {incident['text']}"


def unnamed(url: str, run: str, wanted: Mapping[str, int]) -> Iterator[str]:
    """Incidents that the run's report does not name. Arguments as of :func:`problems`."""
    report = json.loads(_get(f"{url}/runs/{run}/report.json"))
    page = _get(f"{url}/runs/{run}/report.html").decode()
    found = Counter(incident["kind"] for incident in report["incidents"])
    for kind, times in wanted.items():
        if found[kind] < times:
            yield f"the report names {found[kind]} incidents {kind!r}, {times} happened"
    for incident in report["incidents"]:
        if incident["kind"] not in page:
            yield f"the HTML report does not name the incident {incident['kind']!r}"
    said = (report["layer1"] or {}).get("verdict", "")
    if "layer1" in wanted and said != "not as rehearsed":
        yield f"the report says of Layer 1: {said!r}"


def page_at(url: str, form: Mapping[str, str] | None = None) -> str:
    """A page as a person sees it, after sending a form if one is given."""
    body = None if form is None else urllib.parse.urlencode(form).encode()
    with _DIRECT.open(url, body, timeout=20) as answer:
        return bytes(answer.read()).decode()


def _get(url: str) -> bytes:
    with _DIRECT.open(url, timeout=20) as answer:
        return bytes(answer.read())
