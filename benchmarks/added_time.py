"""What the guard adds to each well, in real time, where all passes.

``python -m benchmarks.added_time [--wells 16]``: the same protocol on Opentrons' own engine without
and with the guard. The hardware simulator moves in no time, so each motion is given one here,
roughly an OT-2's: the guard's own lift takes time, and scoring overlaps with motion. The sidecar
is a process of its own; its camera is a stream over loopback of simulated frames, 640x480 at 30
frames/s.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import functools
import inspect
import itertools
import json
import math
import os
import statistics
import tempfile
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from unittest import mock

from tests.runtime.live import LiveRun

from .drill.robot import Robot, fill
from .drill.workstation import Sidecar, StreamCamera, closing
from .figure import Figure

MOTION_S = {"aspirate": 1.1, "dispense": 1.1, "pick_up_tip": 2.0, "drop_tip": 1.0}
"""What a step takes beside the way to it: 100 µL at a p300's 92 µL/s; the others are estimates."""
SPEED_MM_S = (400.0, 125.0)
"""Of the gantry and of the mount: the least of an OT-2's three axes, opentrons' own defaults."""
ADDED_MS, VERDICT_MS = 150.0, 250.0
FPS = 30.0
_DIRECT = urllib.request.build_opener(urllib.request.ProxyHandler({}))


def figures(wells: int = 16) -> Iterator[Figure]:
    """Added time per well, and the verdict after the last keyframe."""
    with tempfile.TemporaryDirectory() as folder, _motion():
        bare = _per_well(_unguarded(wells))
        camera = StreamCamera(3, FPS)
        seen = {"camera": {"spec": camera.spec, "latency_s": 0.02}}
        sidecar = Sidecar(Path(folder), seen)
        with closing(camera):
            sidecar.start()
            try:
                # The first run fills the camera's memory: drawing a frame takes this machine long.
                for name in ("first", "second"):
                    robot = Robot(name, sidecar.url, wells, camera.show, {})
                    failed = robot.play(lambda keyframes: None, lambda: True)
                    if failed or robot.pauses:
                        raise RuntimeError(f"no silent run: {failed or 'it paused'}")
                guarded = _per_well(robot.commands)
                report = json.loads(_get(f"{sidecar.url}/runs/second/report.json"))
            finally:
                sidecar.stop()
    data = f"{wells} wells, 4 keyframes each, engine's simulator with imitated motion"
    added = 1e3 * (statistics.median(guarded) - statistics.median(bare))
    exposure = report["latency"]["trigger_to_exposure_s"]["median"]
    hold = report["latency"]["hold_s"]["median"]
    yield Figure(
        "added time per well in a silent pass, median", data, "simulated", added, "ms", ADDED_MS,
        note=f"a well takes {statistics.median(bare):.2f} s without the guard; medians of a "
        f"keyframe's wait for its exposure {1e3 * exposure:.0f} ms, of a hold {1e3 * hold:.0f} ms",
    )  # fmt: skip
    yield Figure(
        "verdict after the last keyframe, 95th percentile", data, "simulated",
        1e3 * report["latency"]["last_frame_to_verdict_s"]["p95"], "ms", VERDICT_MS,
    )  # fmt: skip


def _unguarded(wells: int) -> list[Any]:
    text = "from typing import Any\nmetadata = {'apiLevel': '2.15'}\n" + inspect.getsource(fill)
    run = LiveRun(f"{text}\ndef run(protocol):\n    fill(protocol, {wells})\n").start()
    return run.join(600.0).commands


def _per_well(commands: list[Any]) -> list[float]:
    """From one dropped tip to the next, s."""
    moments = [one.completedAt for one in commands if one.commandType.startswith("dropTip")]
    return [(b - a).total_seconds() for a, b in itertools.pairwise(moments)]


@contextlib.contextmanager
def _motion() -> Iterator[None]:
    """Let the hardware simulator take its time."""
    from opentrons.hardware_control import API

    def slow(name: str, seconds: float) -> Any:
        motion = getattr(API, name)

        @functools.wraps(motion)
        async def moves(*args: Any, **kwargs: Any) -> Any:
            await asyncio.sleep(seconds)
            return await motion(*args, **kwargs)

        return moves

    move, places = API.move_to, dict[Any, Any]()

    async def move_to(self: Any, mount: Any, abs_position: Any, **kwargs: Any) -> Any:
        to, before = abs_position, places.get(mount, abs_position)
        across = math.hypot(to.x - before.x, to.y - before.y) / SPEED_MM_S[0]
        await asyncio.sleep(max(across, abs(to.z - before.z) / SPEED_MM_S[1]))
        places[mount] = to
        return await move(self, mount, to, **kwargs)

    changed = {name: slow(name, seconds) for name, seconds in MOTION_S.items()}
    with mock.patch.multiple(API, move_to=move_to, **changed):
        yield


def _get(url: str) -> bytes:
    with _DIRECT.open(url, timeout=20) as answer:
        return bytes(answer.read())


def main() -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.added_time", description=__doc__)
    parser.add_argument("--wells", type=int, default=16)
    given = parser.parse_args()
    print(f"{os.cpu_count()} cores, load before the start {os.getloadavg()[0]:.1f}.", flush=True)
    for figure in figures(given.wells):
        print(figure.line(), flush=True)


if __name__ == "__main__":
    main()
