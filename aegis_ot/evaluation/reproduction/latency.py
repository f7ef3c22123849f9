"""From a failed dispense to the halt of the robot, in real time (paper, Latency)."""

from __future__ import annotations

import statistics
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ...dryrun.runner import UNATTENDED, DryRunSettings, dry_run
from ...errors import StoreError
from ...sidecar import Analyser, make_analyser
from ...sidecar.overview import run_overview
from ...sidecar.store import Store
from ..layer2.figures import COLOURS, Canvas
from .context import Context
from .experiment import Experiment, Outcome, Picture, table
from .live import KINDS, STRUCK, WELLS, script_of

RUNS = 9
"""As many paused runs as in the paper."""

RATE = 30.0
"""Frames per second of the camera."""

SEED = 99_000

PARTS = {
    "exposure_s": "two waits for an exposure to begin",
    "frames_s": "frames drawn and delivered, tip lifted (no time in the simulator)",
    "verdict_s": "last frame to verdict",
    "halt_s": "verdict to halt",
}


def run(context: Context) -> Outcome:
    """Nine runs that the guard stops at the planted failure."""
    analyser = make_analyser(UNATTENDED)
    context.progress.begin("Paused runs in real time", RUNS)
    paused = []
    for number in range(RUNS):
        found = _paused(analyser, SEED + 100 * context.options.seed + number)
        if found is not None:
            paused.append(found)
        context.progress.step()
    if not paused:
        raise StoreError("No run was paused at its planted failure: there is nothing to time.")
    parts = {name: [one[name] for one in paused] for name in PARTS}
    total = [one["total_s"] for one in paused]
    canvas = Canvas(context.pictures("latency"), f"{len(paused)} paused runs (simulated frames)")
    canvas.draw("latency", lambda axes: _bars(axes, paused), width=7.0)
    rows = [(PARTS[name], _spread(values)) for name, values in parts.items()]
    rows.append(("failed dispense to halt", _spread(total)))
    return Outcome(
        data=(
            f"simulated: robot and camera ({RATE:g} frames/s), real sidecar over loopback, "
            f"{RUNS} runs with a partial dispense in well {STRUCK + 1}, in real time",
        ),
        answers={
            "latency": (
                f"{_spread(total)} from the failed dispense to the halt ({len(paused)} of {RUNS} "
                "runs paused), without the robot's own motion and without a vision model"
            )
        },
        tables=(table("Where the time goes, s", ("part", "mean ± standard deviation"), rows),),
        pictures=(Picture(context.picture(canvas.paths[0]), "Latency of each paused run"),),
        notes=(
            "The paper: 4.0 s for frames and 5.5 s for its vision model to the pause call, then "
            "the robot ran on to the next boundary, 13.27 ± 0.47 s in all. This guard holds the "
            "robot at the boundary until the verdict is in, so the halt follows the verdict.",
            "No camera is in this: the time in which a frame is drawn stands where a camera's "
            "transfer would. A vision model's time would be added where it is asked.",
        ),
        figures={"runs": RUNS, "paused": len(paused)},
        timings=parts | {"total_s": total},
    )


def _paused(analyser: Analyser, seed: int) -> dict[str, float] | None:
    """The times of one run that was stopped at its planted failure; ``None`` if it was not."""
    fault = f"{KINDS['partial dispense']}@#{STRUCK + 1}"
    with tempfile.TemporaryDirectory(prefix="aegis-ot-") as place:
        settings = DryRunSettings(
            (fault,), "stop", seed, rules="off", data=Path(place), cascade=UNATTENDED, rate=RATE
        )
        done = dry_run(script_of("red", WELLS), settings, analyser)
        store = Store(Path(place))
        try:
            overview = run_overview(store, str(done.reported.account["run"]))
        finally:
            store.close()
    if done.outcome != "stopped" or not overview["trajectories"]:
        return None
    last = overview["trajectories"][-1]
    if last["trajectory"] != STRUCK or last["hold"] is None or last["judged_at"] is None:
        return None
    return _times(last)


def _times(well: Mapping[str, Any]) -> dict[str, float]:
    frames = {keyframe["kind"]: keyframe for keyframe in well["keyframes"]}
    dispense, after = frames["dispense"], frames["post_dispense"]
    exposure = sum(keyframe["exposed_after_s"] or 0.0 for keyframe in (dispense, after))
    return {
        "exposure_s": exposure,
        "frames_s": after["captured"] - dispense["robot_time"] - exposure,
        "verdict_s": well["judged_at"] - after["captured"],
        "halt_s": well["hold"]["at"] - well["judged_at"],
        "total_s": well["hold"]["at"] - dispense["robot_time"],
    }


def _spread(values: Sequence[float]) -> str:
    deviation = statistics.stdev(values) if len(values) > 1 else 0.0
    return f"{statistics.fmean(values):.3f} ± {deviation:.3f} s"


def _bars(axes: Any, paused: Sequence[Mapping[str, float]]) -> None:
    places = list(range(1, len(paused) + 1))
    left = [0.0] * len(paused)
    for colour, (name, shown) in zip(COLOURS, PARTS.items(), strict=False):
        values = [one[name] for one in paused]
        axes.barh(places, values, left=left, color=colour, label=shown)
        left = [a + b for a, b in zip(left, values, strict=True)]
    axes.set(xlabel="s from the failed dispense", ylabel="paused run")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18))


EXPERIMENT = Experiment(
    "latency",
    "Latency to the halt",
    "Live demonstration, Fig. latency",
    ("latency",),
    (),
    run,
)
