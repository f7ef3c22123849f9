"""A run that a sidecar has kept, well by well, for a person to look at."""

from __future__ import annotations

from ..progress import Progress
from ..run_view import Inspection, seen_well, state_of
from ..run_view.delivery_view import no_pictures
from ..run_view.pictures import cut_pictures
from ..sidecar.overview import run_overview
from ..sidecar.store import Store
from ..worldmodel.recorded import run_source
from .choosing import pictured


def inspect_run(
    store: Store, run: str, most: int = 200, progress: Progress | None = None
) -> Inspection:
    """Gather what a person wants to see of a run; nothing is judged anew.

    Args:
        store: An open store.
        run: A run in it.
        most: Wells with pictures at most; the others keep their numbers. Flagged ones first.
        progress: Told how far it is.

    Raises:
        StoreError: The store cannot be read. A single frame that is missing or damaged is said
            in its place.
    """
    progress = progress or Progress()
    overview = run_overview(store, run)
    entries = overview["trajectories"]
    flagged = [state_of(entry) in ("fail", "recovered", "undecided") for entry in entries]
    chosen = pictured([(flag, False) for flag in flagged], most)
    progress.begin("Cutting pictures", len(entries))

    wells, pictures = [], cut_pictures(store.frames_of(run))
    for entry, show in zip(entries, chosen, strict=True):
        wells.append(seen_well(run, entry, pictures if show else no_pictures))
        progress.step()
    source = run_source(overview)
    finished = overview.get("finished")
    facts = [
        ("frames", source),
        ("protocol", str(overview.get("protocol") or "unknown")),
        ("run", finished["outcome"] if finished else "not finished"),
    ]
    names = {name for entry in entries for name in entry["evidence"].get("scores", {})}
    return Inspection(run, source, facts, wells, ", ".join(sorted(names)))
