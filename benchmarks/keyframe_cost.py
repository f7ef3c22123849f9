"""What one keyframe costs the robot: the real client, a real sidecar process, a free camera."""

from __future__ import annotations

import random
import statistics
import tempfile
import time
from collections.abc import Iterator

from aegis_ot.runtime.sidecar_client import SidecarClient
from aegis_ot.vocabulary import Keyframe, KeyframeKind, WellRef

from .figure import Figure
from .sidecar_process import sidecar_process

FPS = 30.0
KEYFRAMES = 120
TARGET_MS = 1000 / FPS + 10
_RUN = "bench"


def figures() -> Iterator[Figure]:
    """Median and 95th percentile of the time for which the robot stands still."""
    taken, delays = measure()
    data = f"{len(taken)} keyframes over loopback, 640x480 at {FPS:g} frames/s, own process"
    yield Figure(
        "robot-side cost of a keyframe, median", data, "test pattern",
        1e3 * statistics.median(taken), "ms", TARGET_MS,
        note=f"of it waiting for the exposure to begin: {1e3 * statistics.median(delays):.1f} ms",
    )  # fmt: skip
    yield Figure(
        "robot-side cost of a keyframe, 95th percentile", data, "test pattern",
        1e3 * statistics.quantiles(taken, n=20)[-1], "ms",
    )  # fmt: skip


def measure() -> tuple[list[float], list[float]]:
    """Time of each keyframe, and of it until the exposure began, s."""
    rng = random.Random(1)
    taken, delays = [], []
    with (
        tempfile.TemporaryDirectory() as data,
        sidecar_process("--camera", "pattern", "--port", "0", "--data", data) as (url, _),
    ):
        link = SidecarClient(url, None, lambda: None)
        link.start(_RUN, about(), 10)
        for number in range(KEYFRAMES + 4):
            keyframe = make_keyframe(_RUN, number)
            # The robot moves meanwhile; at random, or the camera's phase would decide.
            time.sleep(rng.uniform(0.08, 0.16))
            begun = time.perf_counter()
            captured = link.keyframe(keyframe, 10)
            if number >= 4:  # the first ones open the connection
                taken.append(time.perf_counter() - begun)
                delays.append(captured.exposed_after_s or 0.0)
        link.finish(_RUN, "succeeded", "", 5)
        link.close()
    return taken, delays


def about(run: str = _RUN) -> dict[str, object]:
    """Of a registration."""
    return {
        "run": run, "protocol": "bench.py", "robot": "OT-2 Standard", "api_level": "2.20",
        "simulated": True, "started": time.time(), "package": "bench",
    }  # fmt: skip


def make_keyframe(run: str, number: int) -> Keyframe:
    """One of a run whose deliveries follow each other, four each."""
    kinds = tuple(KeyframeKind)
    well = WellRef("labware-2", f"{'ABCDEFGH'[number // 4 % 8]}1", "plate", "3")
    return Keyframe(
        run=run, sequence=number, trajectory=number // 4, kind=kinds[number % 4],
        pipette="p300_single_gen2", mount="right", channels=1, tip="1:A1", sources=(well,),
        destinations=(well,), commanded_ul=100.0, expected_ul=100.0, capacity_ul=300.0,
        robot_time=time.time(),
    )  # fmt: skip
