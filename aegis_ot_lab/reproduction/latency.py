"""From a failed dispense to the halt of the robot, in real time (paper, Latency)."""

from __future__ import annotations

import statistics
import time
from collections.abc import Mapping, Sequence
from typing import Any

from aegis_ot.dryrun.runner import TRUSTING, DryRunSettings, dry_run
from aegis_ot.errors import StoreError
from aegis_ot.sidecar import Analyser, Judged, RunAnalysis, make_analyser
from aegis_ot.vision.camera import Frame
from aegis_ot.vocabulary import Keyframe, KeyframeKind

from ..evaluation.layer2.figures import COLOURS, Canvas
from .context import Context
from .experiment import Experiment, ExperimentOutcome, ExperimentPicture, table
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


def run(context: Context) -> ExperimentOutcome:
    """Nine runs that the guard stops at the planted failure."""
    analyser = make_analyser(TRUSTING)
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
    return ExperimentOutcome(
        data=(
            f"simulated: robot and camera ({RATE:g} frames/s), real sidecar over loopback, "
            f"{RUNS} runs with a partial dispense in well {STRUCK + 1}, in real time",
        ),
        answers={
            "latency": (
                f"{_spread(total)} from the failed dispense to the halt ({len(paused)} of {RUNS} "
                "runs paused), without the robot's own motion and without a vision model",
            )
        },
        tables=(table("Where the time goes, s", ("part", "mean ± standard deviation"), rows),),
        pictures=(
            ExperimentPicture(context.picture(canvas.paths[0]), "Latency of each paused run"),
        ),
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
    timed = _Timed(analyser)
    settings = DryRunSettings(
        (fault,), on_fail="stop", seed=seed, rules="off", cascade=TRUSTING, rate=RATE
    )
    done = dry_run(script_of("red", WELLS), settings, timed)
    holds = [one for one in done.reported.account["holds"] if one["trajectory"] == STRUCK]
    if done.outcome != "stopped" or not holds or len(done.wells) != STRUCK + 1:
        return None
    begun = timed.triggers[STRUCK, KeyframeKind.DISPENSE]
    seen = timed.seen[STRUCK, KeyframeKind.POST_DISPENSE]
    waits = [
        timed.waits[STRUCK, kind] for kind in (KeyframeKind.DISPENSE, KeyframeKind.POST_DISPENSE)
    ]
    return {
        "exposure_s": sum(waits),
        "frames_s": seen - begun - sum(waits),
        "verdict_s": timed.judged[STRUCK] - seen,
        "halt_s": holds[0]["at"] - timed.judged[STRUCK],
        "total_s": holds[0]["at"] - begun,
    }


class _Timed:
    """An analyser, and when it was told what; all times on the clock of this machine, s.

    Attributes:
        triggers: When the robot stood still for a keyframe.
        waits: From there to the beginning of the exposure.
        seen: When the frame was here.
        judged: When the verdict was in.
    """

    def __init__(self, analyser: Analyser) -> None:
        self._analyser = analyser
        self._run: RunAnalysis | None = None
        self.triggers: dict[tuple[int, KeyframeKind], float] = {}
        self.waits: dict[tuple[int, KeyframeKind], float] = {}
        self.seen: dict[tuple[int, KeyframeKind], float] = {}
        self.judged: dict[int, float] = {}

    def begin(self, run: str, history: Sequence[Judged] = ()) -> RunAnalysis:
        """It follows one run."""
        self._run = self._analyser.begin(run, history)
        return self

    def observe(self, keyframe: Keyframe, frame: Frame) -> None:
        """A frame is here."""
        assert self._run is not None
        key, now = (keyframe.trajectory, keyframe.kind), time.time()
        self.triggers[key], self.seen[key] = keyframe.robot_time, now
        exposed = now - (time.monotonic() - frame.exposed_at)
        self.waits[key] = exposed - keyframe.robot_time
        self._run.observe(keyframe, frame)

    def judge(self, trajectory: int) -> Judged:
        """A verdict is wanted."""
        assert self._run is not None
        judged = self._run.judge(trajectory)
        self.judged[trajectory] = time.time()
        return judged

    def confirm(self, trajectory: int) -> None:
        """The operator found it right."""
        assert self._run is not None
        self._run.confirm(trajectory)


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
