"""``aegis-ot aim``: how well a run's camera is known, and what it sees."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..vocabulary import counted
from .plain_text import echo
from .runs import known_run, open_data

if TYPE_CHECKING:
    from ..inspection.aiming import CameraCheck

app = typer.Typer()

_NAMED = 8


@app.command("aim")
def aim(
    run: Annotated[str | None, typer.Argument(help="Which run; the newest if left out.")] = None,
    data: Annotated[
        Path | None, typer.Option(help="Data folder of a sidecar; its usual one if left out.")
    ] = None,
) -> None:
    """Say how well a run's camera is known, which tips it sees whole, and when it was moved.

    The robot says where each tip was, the frames show where it appeared: from both the camera's
    place follows. A first run of a few wells is enough. Drawn frames tell nothing of a camera.

    Exit codes: 0 the camera is known, stood still and sees every tip, 1 not so, 2 there is nothing
    to tell it from.
    """
    from ..inspection.aiming import check_camera
    from ..vision.detection import HeatmapDetector

    store = open_data(data)
    named = known_run(store, run or "")
    check = check_camera(store, named, HeatmapDetector())
    echo("\n".join(_lines(named, check)))
    raise typer.Exit(0 if check.is_sound else 1)


def _lines(run: str, check: CameraCheck) -> list[str]:
    known = check.registration
    if known is None:
        return [
            f"{run}: the camera is not known. {counted(check.keyframes, 'frame')} were looked at, "
            "and tips at too few different places found in them, or found where the robot did not "
            "hold them. Tips are searched frame by frame. See that tips stand out from what is "
            "behind them, and run a few wells more."
        ]
    lines = [
        f"{run}: the camera is known to {check.error_px:.1f} px (95 % of "
        f"{counted(len(check.places), 'place')}), from {counted(known.sightings, 'sighting')}, "
        f"half of which lie within {known.residual_px:.1f} px.",
        f"It stands {known.camera.distance_mm:.0f} mm from the middle of these places.",
    ]
    advice = {
        "upper end": "A column that reaches above the picture cannot be measured: aim higher.",
        "lower end": "What stays in the tip cannot be seen: aim lower.",
        "tip": "These wells cannot be judged: aim at them, or move the camera back.",
    }
    for part, what_to_do in advice.items():
        wells = dict.fromkeys(p.well.address for p in check.places if p.lacking == part)
        if wells:
            lines.append(f"The {part} is out of view at {_named(list(wells))}. {what_to_do}")
    if not any(place.lacking for place in check.places):
        lines.append("Every tip was in view, from end to end.")
    if check.moved:
        lines.append(
            f"The camera was moved; it was noticed at {_named([w.address for w in check.moved])}. "
            "Fix it where it stands."
        )
    return lines


def _named(wells: list[str]) -> str:
    more = f" and {len(wells) - _NAMED} more" if len(wells) > _NAMED else ""
    return ", ".join(wells[:_NAMED]) + more
