"""What the page for people shows: values for its templates, from what the sidecar knows."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any
from urllib.parse import quote

from ..account import (
    Box,
    Picture,
    SeenWell,
    doing,
    plate_maps,
    run_account,
    seen_well,
    situations,
    state_of,
)
from ..account.pictures import cut_pictures
from ..account.summary import is_flagged
from ..errors import StoreError
from .service import Sidecar

RUNS_SHOWN = 50


@dataclass(frozen=True)
class ChosenWell:
    """The well whose frames are shown.

    Attributes:
        trajectory: Its number in the run.
        state: See :func:`~aegis_ot.account.state_of`.
        seen: Frames with what was measured.
        entry: The delivery in the run's overview.
        line: Source line of the protocol.
    """

    trajectory: int
    state: str
    seen: SeenWell
    entry: Mapping[str, Any]
    line: int | None


def run_view(sidecar: Sidecar, run: str, chosen: int | None, here: str) -> dict[str, Any]:
    """Values for ``run.html``.

    Args:
        sidecar: Knows the run.
        run: Its identifier.
        chosen: Which delivery to show; ``None``: the one that asks, failed last, or came last.
        here: Path of the page, for links to wells.

    Raises:
        WireError: 404 if the run was never registered.
        StoreError: The store cannot be read.
    """
    overview = sidecar.overview(run)
    asked = situations(overview, time.time())
    account = run_account(overview)
    well = _chosen(sidecar, overview, chosen, [one.trajectory for one in asked])
    return {
        "run": overview,
        "account": account,
        "plates": plate_maps(overview["trajectories"]),
        "situations": asked,
        "asked": [one for one in asked if one.asks],
        "asked_here": any(one.asks and well and one.trajectory == well.trajectory for one in asked),
        "can_order": not overview["finished"] and not any(one.kind == "paused" for one in asked),
        "doing": doing(overview),
        "well": well,
        "here": here,
    }


def history_view(sidecar: Sidecar, search: str, skip: int) -> dict[str, Any]:
    """Values for ``history.html``."""
    found = sidecar.store.runs(search, RUNS_SHOWN + 1, skip)
    return {
        "runs": found[:RUNS_SHOWN],
        "search": search,
        "earlier": max(0, skip - RUNS_SHOWN) if skip else None,
        "later": skip + RUNS_SHOWN if len(found) > RUNS_SHOWN else None,
    }


def live_run(sidecar: Sidecar) -> str | None:
    """The newest run that has not ended, else the newest; ``None`` if there is none."""
    runs = sidecar.store.runs("running", 1) or sidecar.store.runs("", 1)
    return str(runs[0]["run"]) if runs else None


def frame_pictures(sidecar: Sidecar, run: str, sequence: int, box: Box | None) -> Any:
    """A keyframe's pictures, cut once: a page that follows a run shows them again and again."""
    return _cut(sidecar, run, sequence, box)


def _chosen(
    sidecar: Sidecar, overview: Mapping[str, Any], chosen: int | None, asking: list[int | None]
) -> ChosenWell | None:
    entries = {entry["trajectory"]: entry for entry in overview["trajectories"]}
    flagged = [number for number, entry in entries.items() if is_flagged(entry)]
    seen = [number for number, entry in entries.items() if entry["keyframes"]]
    wanted = [chosen, *asking, *reversed(flagged), *reversed(seen)]
    number = next((n for n in wanted if n is not None and n in entries), None)
    if number is None:
        return None
    entry = entries[number]
    run = str(overview["run"])

    def pictures(sequence: int, box: Box | None) -> tuple[Picture | None, Picture | None, str]:
        return _cut(sidecar, run, sequence, box)

    well = seen_well(run, entry, pictures)
    line = entry["keyframes"][-1]["line"] if entry["keyframes"] else None
    return ChosenWell(number, state_of(entry), well, entry, line)


@lru_cache(maxsize=64)
def _cut(
    sidecar: Sidecar, run: str, sequence: int, box: Box | None
) -> tuple[Picture | None, Picture | None, str]:
    def frame(number: int) -> bytes | None:
        try:
            return sidecar.store.frame(run, number)
        except StoreError:
            return None

    return cut_pictures(frame)(sequence, box)


def run_address(run: str, well: int | None = None) -> str:
    """Path of a run's page."""
    return f"/runs/{quote(run, safe='')}" + ("" if well is None else f"?well={well}")
