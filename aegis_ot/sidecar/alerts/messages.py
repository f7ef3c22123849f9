"""What a notification says: protocol, robot, well, what was seen, what to do, and where to look."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from urllib.parse import quote

from ...vocabulary import one_line
from ..overview import run_overview
from ..store import Store
from .notices import Notice
from .sending import Notification

_MOST = 5
"""Wells that are told one by one."""


def compose(store: Store, notices: Sequence[Notice], address: str) -> Notification:
    """One message of notices of the same run and kind.

    Args:
        store: Where the run is kept.
        notices: At least one.
        address: Of the sidecar's page; without one there is no link.

    Raises:
        StoreError: The run cannot be read.
    """
    first = notices[0]
    row = store.run(first.run) or {}
    wells = {t["trajectory"]: t["well"] for t in run_overview(store, first.run)["trajectories"]}
    named = ["" if n.trajectory is None else wells.get(n.trajectory, "") for n in notices]
    protocol = str(row.get("protocol") or first.run)
    robot = str(row.get("robot_name") or row.get("robot") or "the robot")
    what = " ".join(filter(None, (_short(named), first.what)))
    lines = [f"{protocol} on {robot}" + (" (simulated)" if row.get("simulated") else "")]
    for notice, well in list(zip(notices, named, strict=True))[:_MOST]:
        lines.append(f"{well}: {notice.seen}" if well else notice.seen)
    if len(notices) > _MOST:
        lines.append(f"and {len(notices) - _MOST} more")
    lines.append(first.todo)
    if address:
        well = "" if first.trajectory is None else f"?well={first.trajectory}"
        lines.append(f"{address}/runs/{quote(first.run, safe='')}{well}")
    said = "\n".join(one_line(line, 2000) for line in lines)
    return Notification(one_line(f"aegis-ot: {what}, {protocol}"), said, _frames(store, first))


def _short(wells: Sequence[str]) -> str:
    """``"B3 of plate in slot 4"``, or the first well and how many more."""
    known = [well for well in wells if well]
    if not known:
        return ""
    more = f" and {len(known) - 1} more" if len(known) > 1 else ""
    return f"{known[0]}{more}:"


def _frames(store: Store, notice: Notice) -> list[Path]:
    return [
        store.frame_path(notice.run, captured.keyframe.sequence)
        for captured in store.keyframes(notice.run)
        if captured.keyframe.trajectory == notice.trajectory
    ]
