"""Ten robots on one sidecar, a keyframe a second each.

``python -m benchmarks.ten_robots [--minutes 10] [--robots 10]``. The sidecar is a process of its
own with its own detector and analyser; its camera is a video of simulated frames, 640x480 at 30
frames/s, in which each second shows another moment of a delivery. What the robots send does not
fit it, so verdicts are of no interest: the load is. Robots and sidecar share this machine. Printed:
what was lost, how long acknowledgements and verdicts took, and how the process's memory grew.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import statistics
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from aegis_ot.runtime.sidecar_client import SidecarClient
from aegis_ot.sidecar.store import Store
from aegis_ot.vocabulary import KeyframeKind

from .figure import Figure
from .keyframe_cost import FPS, about, make_keyframe
from .sidecar_process import sidecar_process

ABOVE_FRAME_MS = 100.0
_EXPOSURES = 3


@dataclass
class Heard:
    """What one robot was told: keyframes acknowledged, and how long that and verdicts took, s."""

    run: str
    acknowledged: int = 0
    judged: int = 0
    taken: list[float] = field(default_factory=list)
    verdicts: list[float] = field(default_factory=list)
    trouble: str = ""


def figures(minutes: float = 10.0, robots: int = 10) -> Iterator[Figure]:
    """Lost keyframes, acknowledgements, verdicts, memory."""
    with tempfile.TemporaryDirectory() as folder:
        video = Path(folder) / "delivery.avi"
        make_video(video)
        settings = _settings(video, Path(folder) / "data")
        with sidecar_process("--config", str(settings)) as (url, pid):
            heard, memory = _load(url, pid, 60.0 * minutes, robots)
        lost = _lost(Path(folder) / "data", heard)
    taken = sorted(one for robot in heard for one in robot.taken)
    verdicts = sorted(one for robot in heard for one in robot.verdicts)
    data = f"{robots} robots, {len(taken)} keyframes in {minutes:g} min over loopback"
    yield Figure("keyframes acknowledged and lost", data, "simulated", lost, target=0)
    yield Figure(
        "acknowledgement above the frame time, 95th percentile", data, "simulated",
        1e3 * (_p95(taken) - 1 / FPS), "ms", ABOVE_FRAME_MS,
        note=f"median of the whole acknowledgement {1e3 * statistics.median(taken):.0f} ms, "
        f"longest {1e3 * taken[-1]:.0f} ms",
    )  # fmt: skip
    yield Figure(
        "last keyframe to verdict, 95th percentile", f"{len(verdicts)} deliveries", "simulated",
        1e3 * _p95(verdicts), "ms", note=f"median {1e3 * statistics.median(verdicts):.0f} ms",
    )  # fmt: skip
    quarters = [memory[min(len(memory) - 1, n * len(memory) // 4)] for n in range(5)]
    settled = quarters[1]
    yield Figure(
        "growth of the sidecar's memory after the first quarter", data, "simulated",
        memory[-1] - settled, "MB",
        note=f"MB at the start and after each quarter: {', '.join(f'{q:.0f}' for q in quarters)}",
    )  # fmt: skip
    for robot in heard:
        if robot.trouble:
            sys.stderr.write(f"{robot.run}: {robot.trouble}\n")


def make_video(path: Path) -> None:
    """Three deliveries of a dye, a second for each of their moments."""
    import cv2

    from aegis_ot.simulation import SessionParameters, SimulatedCamera

    camera = SimulatedCamera(1, (), SessionParameters.webcam(1))
    out = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), FPS, (640, 480))
    for number in range(12):
        camera.announce(replace(make_keyframe("video", number), reagent="red dye"))
        shots = [camera.frame_after(0.0, 5.0).image for _ in range(_EXPOSURES)]
        for exposure in range(int(FPS)):
            out.write(shots[exposure % _EXPOSURES])
    out.release()


def _settings(video: Path, data: Path) -> Path:
    # A video knows of no robot: the watch of the view would find it frozen, or without a tip.
    camera = {"spec": f"video:{video}", "watch_view": False}
    settings = data.with_suffix(".json")
    settings.write_text(json.dumps({"camera": camera, "port": 0, "data": str(data)}), "utf-8")
    return settings


def _load(url: str, pid: int, seconds: float, robots: int) -> tuple[list[Heard], list[float]]:
    heard = [Heard(f"robot-{number}") for number in range(robots)]
    begin = time.monotonic() + 1.0
    threads = [
        threading.Thread(target=_drive, args=(url, one, begin, seconds), daemon=True)
        for one in heard
    ]
    for thread in threads:
        thread.start()
    memory = []
    while any(thread.is_alive() for thread in threads):
        memory.append(_resident_mb(pid))
        time.sleep(1.0)
    return heard, memory


def _drive(url: str, heard: Heard, begin: float, seconds: float) -> None:
    """A robot: at each full second of its own a keyframe; after the fourth it waits to go on."""
    rng = random.Random(heard.run)
    link = SidecarClient(url, None, lambda: None)
    due = begin + rng.uniform(0, 1)
    try:
        link.start(heard.run, about(heard.run), 10)
        while due < begin + seconds:
            time.sleep(max(0.0, due - time.monotonic()))
            due += 1.0
            keyframe = make_keyframe(heard.run, heard.acknowledged)
            begun = time.monotonic()
            link.keyframe(keyframe, 10)
            done = time.monotonic()
            heard.acknowledged += 1
            if heard.acknowledged > 4:  # the first ones open the connection
                heard.taken.append(done - begun)
            if keyframe.kind is KeyframeKind.POST_DISPENSE:
                while link.verdict(heard.run, keyframe.trajectory, 0.15, 10) is None:
                    pass
                heard.judged += 1
                heard.verdicts.append(time.monotonic() - done)
        link.finish(heard.run, "succeeded", "", 10)
    except Exception as error:
        heard.trouble = f"{type(error).__name__}: {error}"
    finally:
        link.close()


def _lost(data: Path, heard: list[Heard]) -> int:
    """Acknowledged keyframes without a whole frame, and verdicts that were told and not kept."""
    store = Store(data)
    lost = 0
    for robot in heard:
        kept = store.keyframes(robot.run)
        whole = [one for one in kept if store.frame(robot.run, one.keyframe.sequence)]
        lost += robot.acknowledged - len(whole) + robot.judged - len(store.verdicts(robot.run))
    store.close()
    return lost


def _resident_mb(pid: int) -> float:
    """Resident memory of a process, MB (Linux)."""
    for line in Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024
    raise RuntimeError(f"process {pid} has no memory")


def _p95(values: list[float]) -> float:
    return statistics.quantiles(values, n=20)[-1]


def main() -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.ten_robots", description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--robots", type=int, default=10)
    given = parser.parse_args()
    print(f"{os.cpu_count()} cores, load before the start {os.getloadavg()[0]:.1f}.", flush=True)
    for figure in figures(given.minutes, given.robots):
        print(figure.line(), flush=True)
    print(f"Load at the end {os.getloadavg()[0]:.1f}; robots and sidecar alone make about 1.")


if __name__ == "__main__":
    main()
