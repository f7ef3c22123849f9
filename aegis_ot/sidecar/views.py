"""What the page for people shows: values for its templates, from what the sidecar knows."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import lru_cache
from typing import Any
from urllib.parse import quote, urlencode

from ..run_view import Box, Picture, RunView, SeenWell, run_account, run_view, seen_well, state_of
from ..run_view.overview import DeliveryEntry, RunOverview
from ..run_view.pictures import cut_pictures
from ..run_view.plates import short_name
from .overview import runs_overview
from .service import Sidecar

RUNS_SHOWN = 50


@dataclass(frozen=True)
class Wanted:
    """Which well a person wants to see.

    Attributes:
        well: Number of its delivery; ``None``: the one that is asked about, failed or came last.
        run: Of which run; ``""``: of the one that is shown.
        during: The delivery that was asked about when it was chosen: what is asked about later is
            shown first.
    """

    well: int | None = None
    run: str = ""
    during: int | None = None


@dataclass(frozen=True)
class ChosenWell:
    """The well whose frames are shown.

    Attributes:
        trajectory: Its number in the run.
        state: See :func:`~aegis_ot.run_view.state_of`.
        name: In short, ``"C2"``.
        seen: Frames with what was measured.
        entry: The delivery in the run's overview.
        line: Source line of the protocol.
        before, after: The flagged deliveries around it; ``None`` where there is none.
    """

    trajectory: int
    state: str
    name: str
    seen: SeenWell
    entry: DeliveryEntry
    line: int | None
    before: int | None
    after: int | None


def run_page(sidecar: Sidecar, run: str, wanted: Wanted, here: str) -> dict[str, Any]:
    """Values for ``run.html``.

    Args:
        sidecar: Knows the run.
        run: Its identifier.
        wanted: Which well a person has chosen.
        here: Path of the page, for links to wells.

    Raises:
        WireError: 404 if the run was never registered.
        StoreError: The store cannot be read.
    """
    overview = sidecar.overview(run)
    view = run_view(overview, time.time())
    asked = view.asks[0].trajectory if view.asks else None
    known = {entry["trajectory"] for entry in overview["trajectories"]}
    still = wanted.well in known and wanted.run in ("", run)
    if asked is not None and asked not in (wanted.well, wanted.during):
        still = False
    query = {"of": run} if here == "/" else {}
    query |= {} if asked is None else {"during": str(asked)}
    paused = any(one.kind == "paused" and not one.answered for one in view.asks)
    return {
        "run": overview,
        "view": view,
        "account": run_account(overview),
        "well": _chosen(sidecar, overview, view, wanted.well if still else asked),
        "browsing": still and wanted.well != asked,
        "can_order": view.state != "ended" and not paused,
        "here": here,
        "wells": f"{here}?{urlencode([*query.items(), ('well', '')])}",
        "now": time.time(),
    }


def history_view(sidecar: Sidecar, search: str, skip: int) -> dict[str, Any]:
    """Values for ``history.html``."""
    found = runs_overview(sidecar.store, search, RUNS_SHOWN + 1, skip)
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


def _chosen(
    sidecar: Sidecar, overview: RunOverview, view: RunView, chosen: int | None
) -> ChosenWell | None:
    entries = {entry["trajectory"]: entry for entry in overview["trajectories"]}
    seen = [number for number, entry in entries.items() if entry["keyframes"]]
    judged = [number for number in seen if entries[number]["verdict"]]
    wanted = [chosen, *reversed(view.flagged), *reversed(judged), *reversed(seen)]
    number = next((n for n in wanted if n is not None and n in entries), None)
    if number is None:
        return None
    entry = entries[number]
    run = str(overview["run"])

    def pictures(sequence: int, box: Box | None) -> tuple[Picture | None, Picture | None, str]:
        return _cut(sidecar, run, sequence, box)

    return ChosenWell(
        number,
        state_of(entry),
        short_name(entry),
        seen_well(run, entry, pictures),
        entry,
        entry["keyframes"][-1]["line"] if entry["keyframes"] else None,
        max((one for one in view.flagged if one < number), default=None),
        min((one for one in view.flagged if one > number), default=None),
    )


@lru_cache(maxsize=64)
def _cut(
    sidecar: Sidecar, run: str, sequence: int, box: Box | None
) -> tuple[Picture | None, Picture | None, str]:
    """A keyframe's pictures, cut once: a page that follows a run shows them again and again."""
    return cut_pictures(sidecar.store.frames_of(run))(sequence, box)


def run_address(run: str, well: int | None = None) -> str:
    """Path of a run's page."""
    return f"/runs/{quote(run, safe='')}" + ("" if well is None else f"?well={well}")
