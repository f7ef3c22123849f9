"""``python -m benchmarks.drill [--scale S] [--only NAME ...] [--seed N] [--keep FOLDER]``.

A sidecar in a process of its own, killed and restarted 20 times within a run, then runs in which
its disk is full, its camera is unplugged and back, its vision model is down, its clock and the
robot's are set, the connection is cut for 30 s, 400 silent connections crowd it, the camera hands
on old frames, verdicts are open at the end, and the protocol moves in another order than in its
rehearsal. The robot is Opentrons' own engine on its hardware
simulator; frames are simulated. After each: no record that was acknowledged may be lost, no hold
may hang, no frame may be older than its trigger, no delivery without a verdict may count as passed,
and the run's report must name what happened.

``--scale 0.2`` does a fifth of the restarts and waits a fifth of the times. Exit status 1:
something was wrong. Linux only: the disk is "full" by a limit on the size of the process's files.
"""

from __future__ import annotations

import argparse
import json
import random
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .examining import page_at, problems, unnamed
from .robot import OTHERWISE, Robot
from .workstation import Cable, Crowd, Person, Sidecar, StreamCamera, VisionModel, closing

RESTARTS = 20
FULL_S = 6.0
UNPLUGGED_S = 6.0
DOWN_WELLS = 3
LEAP_S = 3600.0
CUT_S = 30.0
STALE_FPS = 3.0
LATE_S = 20.0
"""How long the slow vision model takes for a well, s."""
CROWD = 400
CROWD_S = 20.0
NAMED_S = 15.0
"""Within which a report must name what happened."""

Step = Callable[[int], None]


@dataclass
class Drill:
    """One incident's run.

    Attributes:
        folder: Of its sidecar.
        scale: Of times and numbers.
        rng: When things happen.
        wells: Of the run.
        settings: Of the sidecar, beside the camera.
        guard: Settings of the guard.
        text: The protocol, if not the usual one.
        wanted: Incidents that the report must name.
        most_pauses: More of them are wrong; ``None``: as many as it takes.
        happened: What was done, in words.
        camera: How the camera differs from a usual one.
        camera_settings: Settings of the sidecar for it.
        at_end: Done when the run is over; then deliveries may be left without a verdict.
        wrong: What the incident itself saw go wrong.
        afterwards: Done when the robot has ended.
    """

    folder: Path
    scale: float
    rng: random.Random
    wells: int = 8
    settings: dict[str, Any] = field(default_factory=dict)
    guard: dict[str, Any] = field(default_factory=dict)
    wanted: dict[str, int] = field(default_factory=dict)
    happened: str = ""
    text: str = ""
    may_resume: Callable[[], bool] = lambda: True
    model: VisionModel | None = None
    robot: Robot | None = None
    most_pauses: int | None = None
    camera: dict[str, Any] = field(default_factory=dict)
    camera_settings: dict[str, Any] = field(default_factory=dict)
    at_end: Callable[[], None] | None = None
    wrong: list[str] = field(default_factory=list)
    afterwards: Callable[[], None] = lambda: None

    def run(
        self, name: str, incident: Callable[[Drill, Sidecar, StreamCamera, Cable], Step]
    ) -> Any:
        """The robot's pauses, and all that was wrong."""
        camera = StreamCamera(self.rng.randrange(1000), **self.camera)
        seen = {"camera": {"spec": camera.spec, "latency_s": 0.1} | self.camera_settings}
        sidecar = Sidecar(self.folder, seen | self.settings)
        cable = Cable(sidecar.port)
        with closing(camera, cable):
            sidecar.start()
            try:
                robot = Robot(name, cable.url, self.wells, camera.show, self.guard, self.text)
                self.robot = robot
                failed = robot.play(
                    incident(self, sidecar, camera, cable), lambda: self.may_resume()
                )
                self.afterwards()
                if self.at_end is not None:
                    self.at_end()
                data, may_be_open = self.folder / "data", self.at_end is not None
                wrong = problems(data, sidecar.url, name, robot.told, self.wanted, may_be_open)
            finally:
                sidecar.stop()
        if self.most_pauses is not None and robot.pauses > self.most_pauses:
            wrong.append(f"the robot paused {robot.pauses} times, {self.most_pauses} were meant")
        return robot, [f"the run failed: {failed}"] * bool(failed) + wrong + self.wrong


def once_at(
    sequence: int, act: Callable[[], None], seconds: float, undo: Callable[[], None]
) -> Step:
    """Act when so many keyframes are acknowledged, and undo it so many seconds later."""
    began: list[float] = []
    done: list[bool] = []

    def step(keyframes: int) -> None:
        if not began and keyframes >= sequence:
            act()
            began.append(time.monotonic())
        elif began and not done and time.monotonic() - began[0] >= seconds:
            undo()
            done.append(True)

    return step


def restarts(drill: Drill, sidecar: Sidecar, camera: StreamCamera, cable: Cable) -> Step:
    """Killed and started again, at moments of no choice."""
    count = max(2, round(RESTARTS * drill.scale))
    drill.wanted = {"restart": count}
    drill.happened = f"killed and restarted {count} times"
    last = 4 * drill.wells - count // 2 - 2
    moments = sorted(drill.rng.sample(range(1, last), count))
    killed_at = [0]

    def step(keyframes: int) -> None:
        # One that was killed before the robot spoke to it is no restart that anybody saw.
        if moments and keyframes >= moments[0] and keyframes > killed_at[0]:
            moments.pop(0)
            time.sleep(drill.rng.uniform(0, 0.3))
            sidecar.kill()
            time.sleep(0.1)  # what was on its way is heard
            assert drill.robot is not None
            killed_at[0] = len(drill.robot.told.keyframes)
            sidecar.start()

    return step


def disk(drill: Drill, sidecar: Sidecar, camera: StreamCamera, cable: Cable) -> Step:
    """No file may grow for a while."""
    seconds = FULL_S * drill.scale
    drill.wanted, drill.happened = {"store": 1}, f"disk full for {seconds:g} s"
    return once_at(8, lambda: sidecar.fill_disk(True), seconds, lambda: sidecar.fill_disk(False))


def camera(drill: Drill, sidecar: Sidecar, camera: StreamCamera, cable: Cable) -> Step:
    """The camera's cable is pulled, and put back."""
    seconds = UNPLUGGED_S * max(drill.scale, 0.5)  # shorter than a frame's patience is no trouble
    drill.wanted, drill.happened = {"camera": 1}, f"camera unplugged for {seconds:g} s"
    return once_at(10, lambda: camera.plug(False), seconds, lambda: camera.plug(True))


def vlm(drill: Drill, sidecar: Sidecar, camera: StreamCamera, cable: Cable) -> Step:
    """The vision model answers with errors for some wells."""
    drill.wanted, drill.happened = {"model": 1}, f"VLM down for {DOWN_WELLS} wells"

    def step(keyframes: int) -> None:
        assert drill.model is not None
        drill.model.up = not 12 <= keyframes < 12 + 4 * DOWN_WELLS

    return step


def clock(drill: Drill, sidecar: Sidecar, camera: StreamCamera, cable: Cable) -> Step:
    """The workstation's clock is set ahead and back, then the robot's."""
    drill.wanted = {"clock": 2}
    drill.happened = f"workstation's and robot's clock set {LEAP_S:g} s ahead, and back"
    steps: list[tuple[int, Callable[[], None]]] = [
        (6, lambda: sidecar.set_clock(LEAP_S)),
        (12, lambda: sidecar.set_clock(0.0)),
        (18, lambda: setattr(drill.robot, "clock_ahead_s", LEAP_S)),
        (24, lambda: setattr(drill.robot, "clock_ahead_s", 0.0)),
    ]

    def step(keyframes: int) -> None:
        if steps and keyframes >= steps[0][0]:
            steps.pop(0)[1]()

    return step


def cut(drill: Drill, sidecar: Sidecar, camera: StreamCamera, cable: Cable) -> Step:
    """Nothing comes through for a while; the robot gives up waiting, and pauses."""
    seconds = CUT_S * drill.scale
    drill.wanted, drill.happened = {"link": 1}, f"connection cut for {seconds:g} s"
    drill.may_resume = lambda: cable.whole
    return once_at(10, lambda: cable.cut(True), seconds, lambda: cable.cut(False))


def page(drill: Drill, sidecar: Sidecar, camera: StreamCamera, cable: Cable) -> Step:
    """The camera's cable is pulled until the robot pauses; it is answered on the page alone."""
    drill.wanted, drill.most_pauses = {"camera": 1}, 1
    drill.happened = "camera unplugged until the page shows the pause, resumed there"
    drill.guard = {"capture_timeout_s": 8.0}
    person = Person(sidecar.url, "page")
    unplugged: list[bool] = []
    drill.may_resume = lambda: (
        unplugged[-1:] == [False]
    )  # nobody stands before the robot until then

    def step(keyframes: int) -> None:
        if keyframes >= 10 and not unplugged:
            camera.plug(False)
            unplugged.append(True)
        elif unplugged == [True] and person.sees_a_pause():
            camera.plug(True)
            person.resumes()
            unplugged.append(False)

    return step


def crowd(drill: Drill, sidecar: Sidecar, camera: StreamCamera, cable: Cable) -> Step:
    """Somebody opens connections and says nothing, or says a request byte by byte."""
    seconds = CROWD_S * drill.scale
    drill.happened = f"{CROWD} silent connections for {seconds:g} s"
    drill.most_pauses = 0
    crowd = Crowd(sidecar.port)
    return once_at(8, lambda: crowd.come(CROWD), seconds, crowd.go)


def orders(drill: Drill, sidecar: Sidecar, camera: StreamCamera, cable: Cable) -> Step:
    """A person at the page tells the robot to pause while no file may grow."""
    seconds = FULL_S * drill.scale
    drill.wanted = {"store": 1}
    drill.happened = f"disk full for {seconds:g} s, and a person's pause in it"

    def fill() -> None:
        sidecar.fill_disk(True)
        form = {"by": "Ada", "answer": "pause", "back": "/runs/orders"}
        if "Not yet on record" not in page_at(f"{sidecar.url}/runs/orders/order", form):
            drill.wrong.append("the page does not say that the order is not yet on record")

    def afterwards() -> None:
        assert drill.robot is not None
        if not drill.robot.pauses:
            drill.wrong.append("the robot did not pause as it was told")
        told = json.loads(page_at(f"{sidecar.url}/v1/runs/orders"))
        if [one["action"] for one in told["actions"]] != ["pause"] or told["unrecorded"]:
            drill.wrong.append("the order is not on record")

    drill.afterwards = afterwards
    return once_at(8, fill, seconds, lambda: sidecar.fill_disk(False))


def twice(drill: Drill, sidecar: Sidecar, camera: StreamCamera, cable: Cable) -> Step:
    """When the run has ended another one begins under its name, and the camera is dead."""
    drill.happened = "its name used again, in front of a dead camera"

    def afterwards() -> None:
        camera.plug(False)
        careless = {"on_link_loss": "continue", "capture_timeout_s": 1.0}
        second = Robot("twice", cable.url, drill.wells, camera.show, careless)
        failed = second.play(lambda keyframes: None, lambda: True)
        if failed or second.told.keyframes or second.told.verdicts:
            drill.wrong.append(
                f"the second run was told {second.told}; it failed: {failed or 'no'}"
            )
        wanted, until = {"identifier": 1, "camera": 1}, time.monotonic() + NAMED_S
        while (left := [*unnamed(sidecar.url, "twice-2", wanted)]) and time.monotonic() < until:
            time.sleep(0.2)  # the last attempt to take a frame may outlast so short a run
        drill.wrong.extend(left)

    drill.afterwards = afterwards
    return lambda keyframes: None


def stale(drill: Drill, sidecar: Sidecar, camera: StreamCamera, cable: Cable) -> Step:
    """Nothing befalls the run: its camera hands on old frames."""
    drill.happened = "a slow stream without lengths, one frame behind"
    return lambda keyframes: None


def late(drill: Drill, sidecar: Sidecar, camera: StreamCamera, cable: Cable) -> Step:
    """The vision model is slow; at the run's end verdicts are open, and the sidecar is killed."""
    assert drill.model is not None
    drill.model.takes_s = LATE_S
    drill.happened = "verdicts open at the run's end, then the sidecar killed and restarted"

    def at_end() -> None:
        sidecar.kill()
        sidecar.start()

    drill.at_end = at_end
    return lambda keyframes: None


def course(drill: Drill, sidecar: Sidecar, camera: StreamCamera, cable: Cable) -> Step:
    """The protocol does otherwise than in its rehearsal, which Layer 1 had passed."""
    drill.wanted, drill.happened = {"layer1": 1}, "moved in another order than rehearsed"
    return lambda keyframes: None


INCIDENTS = {
    "restarts": restarts, "disk": disk, "camera": camera, "vlm": vlm, "clock": clock, "cut": cut,
    "page": page, "crowd": crowd, "stale": stale, "late": late, "course": course,
    "orders": orders, "twice": twice,
}  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> int:
    """Run and print. Returns the exit status."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.drill", description=__doc__)
    parser.add_argument("--scale", type=float, default=1.0, help="of times and numbers")
    parser.add_argument("--only", nargs="+", choices=INCIDENTS, default=list(INCIDENTS))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path, help="folder for data and logs of the sidecars")
    given = parser.parse_args(arguments)
    wrong = 0
    with tempfile.TemporaryDirectory(prefix="aegis-ot-drill-") as temporary:
        for name in given.only:
            wrong += _drill(name, (given.keep or Path(temporary)) / name, given)
    print(f"{len(given.only)} incidents drilled, {wrong} with something wrong (simulated frames).")
    return 1 if wrong else 0


def _drill(name: str, folder: Path, given: argparse.Namespace) -> bool:
    began = time.monotonic()
    drill = Drill(folder, given.scale, random.Random(f"{given.seed} {name}"))
    drill.model = model = VisionModel()
    if name == "restarts":
        drill.wells = max(4, round(24 * given.scale))
        # A busy machine draws its frames late: that is no restart.
        drill.camera_settings = {"timeout_s": 10.0}
        drill.guard = {"capture_timeout_s": 15.0}
    if name in ("vlm", "late"):
        cascade = {"gates": ["volumetric", "vlm"], "spot_check": 1.0, "calibration_wells": 2}
        drill.settings = {"model": {"name": model.name, "timeout_s": 3}, "cascade": cascade}
    if name == "late":
        drill.settings["model"]["timeout_s"] = 2 * LATE_S
        drill.guard = {"hold": "off", "verdict_timeout_s": 1.0, "on_link_loss": "continue"}
    if name == "stale":
        drill.camera = {"fps": STALE_FPS, "lengths": False, "behind": 1}
        drill.camera_settings = {"timeout_s": 5.0}
    if name == "course":
        drill.text = OTHERWISE
    if name == "cut":
        drill.guard = {"capture_timeout_s": 10.0 * given.scale}
    with closing(model):
        robot, wrong = drill.run(name, INCIDENTS[name])
    told = robot.told
    took = time.monotonic() - began
    print(
        f"{name:9} {drill.happened}: {len(told.keyframes)} keyframes, {len(told.verdicts)} "
        f"verdicts and {len(told.holds)} holds acknowledged, {robot.pauses} pauses, {took:.0f} s: "
        f"{'WRONG' if wrong else 'all kept, none hanging, named'}",
        flush=True,
    )
    for one in wrong:
        print(f"    {one}", flush=True)
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
