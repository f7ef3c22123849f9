"""The audit of one run as one HTML page: no script, no link, pictures inside."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..run_view import PlateView, SeenWell, plates_of, seen_well
from ..run_view.delivery_view import no_pictures
from ..run_view.overview import RunOverview
from ..run_view.pictures import cut_pictures
from .html_page import html_page
from .plate_views import PlateViews

LEAST_SHOWN, MOST_SHOWN = 5, 40
"""Suspects with frames: the first ones even where none stands out, and no more than that."""


@dataclass(frozen=True)
class ShownSuspect:
    """One entry of the ranked list.

    Attributes:
        told: As the audit tells it.
        well: Its frames, or those of the well that shows it best.
    """

    told: Mapping[str, Any]
    well: SeenWell


def audit_html(
    overview: RunOverview,
    audit: Mapping[str, Any],
    frame: Callable[[int], bytes | None],
    views: PlateViews | None = None,
) -> str:
    """Render the audit of a run.

    Args:
        overview: Answer of ``GET /v1/runs/{run}``.
        audit: The audit, as plain JSON.
        frame: The JPEG of a keyframe's number; ``None`` where it is missing.
        views: Of the pictures of a plate that the audit tells of; ``None`` where they are not at
            hand: a store keeps none.
    """
    suspects: Sequence[Mapping[str, Any]] = audit["suspects"]
    standing = [one for one in suspects if one["stands_out"]]
    shown = suspects[: min(max(len(standing), LEAST_SHOWN), MOST_SHOWN)]
    plates: list[PlateView] = plates_of(overview)
    return html_page(
        "aegis_ot.reports",
        "audit.html",
        {},
        title=str(overview.get("protocol") or overview["run"]),
        overview=overview,
        audit=audit,
        standing=standing,
        suspects=_shown(overview, shown, frame),
        ranked=suspects,
        plates=plates,
        ranks=ranks_of(suspects, len(shown)),
        pictured=audit.get("plate"),
        views=views,
        singles=sum(one["kind"] == "well" for one in suspects),
    )


def ranks_of(suspects: Sequence[Mapping[str, Any]], most: int) -> dict[int, int]:
    """Best rank of each delivery among the first ``most`` entries, for the plate map."""
    ranks: dict[int, int] = {}
    for one in suspects[:most]:
        for trajectory in one["trajectories"]:
            ranks.setdefault(int(trajectory), int(one["rank"]))
    return ranks


def _shown(
    overview: RunOverview,
    suspects: Sequence[Mapping[str, Any]],
    frame: Callable[[int], bytes | None],
) -> list[ShownSuspect]:
    entries = {entry["trajectory"]: entry for entry in overview["trajectories"]}
    pictures = cut_pictures(frame)
    pictured: set[int] = set()
    shown = []
    for one in suspects:
        entry = entries.get(one["shown"])
        if entry is None:
            continue
        chosen = no_pictures if one["shown"] in pictured else pictures
        pictured.add(one["shown"])
        shown.append(ShownSuspect(one, seen_well(str(overview["run"]), entry, chosen)))
    return shown
