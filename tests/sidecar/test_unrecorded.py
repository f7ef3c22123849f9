"""A full disk: what people say counts at once, and is written when there is room."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from aegis_ot.sidecar import SidecarConfig, run_record, running_sidecar
from aegis_ot.sidecar.store import Store

from .helpers import Robot, StubAnalyser, StubCamera

HOLD = {"number": 0, "trajectory": 0, "seconds": 0.2, "resolution": "verdict", "policy": "pause"}


class Disk:
    """A small file system of its own, that can be filled to its last byte."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._ballast = folder / "ballast"

    def fill(self) -> None:
        with self._ballast.open("ab", buffering=0) as file, contextlib.suppress(OSError):
            while True:
                file.write(b"\0" * 512)

    def free(self) -> None:
        self._ballast.unlink()


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Disk]:
    folder = tmp_path / "disk"
    folder.mkdir()
    if sys.platform != "linux" or os.geteuid() != 0:
        pytest.skip("only root can mount a file system")
    mount = ["mount", "-t", "tmpfs", "-o", "size=2m", "tmpfs", str(folder)]
    if subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("no file system can be mounted here")
    try:
        yield Disk(folder)
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)


def in_time(is_so: Any) -> None:
    until = time.monotonic() + 60
    while not is_so():
        assert time.monotonic() < until
        time.sleep(0.02)


def page(robot: Robot, path: str, answer: str, note: str = "") -> None:
    form = {"by": "Ada", "answer": answer, "note": note}
    told = robot.http.post(f"/runs/{robot.run}/{path}", data=form)
    assert told.status_code == 303, told.text


def test_what_people_say_counts_while_the_disk_is_full(
    disk: Disk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run_record, "TRY_EVERY_S", 0.05)
    config = SidecarConfig(port=0, data=disk.folder / "data")
    with running_sidecar(config, StubCamera(), StubAnalyser(fails=[0])) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        assert robot.verdict(0)["verdict"]["outcome"] == "fail"
        disk.fill()
        page(robot, "order", "pause")
        answer = robot.send(4)
        assert (answer.status_code, answer.json()["error"]["code"]) == (503, "store")
        assert answer.json()["order"]["action"] == "pause"
        assert robot.verdict(0)["order"]["action"] == "pause"
        assert robot.post("hold", HOLD | {"resolution": "operator"}).status_code == 200
        assert "order" not in robot.verdict(0)
        seen = robot.http.get(f"/runs/{robot.run}").text
        assert "Ada paused the robot" in seen
        assert "Not yet on record" in seen
        assert "Ada: pause" in seen
        page(robot, "wells/0", "pass stop", "it is fine, but stop")
        assert robot.verdict(0)["verdict"]["outcome"] == "pass"
        action = robot.http.get(f"/v1/runs/{robot.run}/trajectories/0/action").json()["action"]
        assert (action["action"], action["by"]) == ("stop", "Ada")
        assert robot.post("finish", {"outcome": "stopped"}).status_code == 200
        assert robot.overview()["finished"]["outcome"] == "stopped"
        reader = Store(config.data)
        assert (reader.actions(robot.run), reader.decisions(robot.run)) == ([], {})
        disk.free()
        in_time(lambda: not robot.overview()["unrecorded"] and reader.decisions(robot.run))
        assert [one["action"] for one in reader.actions(robot.run)] == ["pause", "stop"]
        assert reader.decisions(robot.run)[0][0]["note"] == "it is fine, but stop"
        assert reader.holds(robot.run)[0]["resolution"] == "operator"
        ended = reader.run(robot.run)
        assert ended is not None
        assert ended["finished"]["outcome"] == "stopped"
        assert "Not yet on record" not in robot.http.get(f"/runs/{robot.run}").text
        reader.close()


def test_what_the_robot_says_counts_while_the_disk_is_full(disk: Disk) -> None:
    config = SidecarConfig(port=0, data=disk.folder / "data")
    recovery = {"trajectory": 0, "attempt": 1, "action": "retry", "state": "begun"}
    outage = {"kind": "link", "seconds": 30, "text": "It was away."}
    with running_sidecar(config, StubCamera(), StubAnalyser(fails=[0])) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        assert robot.verdict(0)["verdict"]["outcome"] == "fail"
        disk.fill()
        given_up = {"reason": "the run was aborted"}
        assert robot.post("trajectories/1/abandon", given_up).status_code == 200
        assert robot.post("recovery", recovery).status_code == 200
        assert robot.post("recovery", recovery | {"state": "failed"}).status_code == 200
        assert robot.post("incident", outage).status_code == 200
        assert robot.post("finish", {"outcome": "aborted"}).status_code == 200
        seen = robot.overview()
        assert seen["finished"]["outcome"] == "aborted"
        assert [one["abandoned"] for one in seen["trajectories"]] == [None, given_up["reason"]]
        assert [one["state"] for one in seen["recoveries"]] == ["failed"]
        assert {"link", "store"} <= {one["kind"] for one in seen["incidents"]}
        disk.free()
    with contextlib.closing(Store(config.data)) as store:
        assert store.abandoned(robot.run) == {1: given_up["reason"]}
        assert [one["state"] for one in store.recoveries(robot.run)] == ["failed"]
        assert "link" in {one["kind"] for one in store.incidents(robot.run)}
        ended = store.run(robot.run)
        assert ended is not None
        assert ended["finished"]["outcome"] == "aborted"


def test_what_waits_is_kept_in_order_and_written_at_a_clean_stop(
    config: SidecarConfig, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The database may not grow; there is room again as the sidecar is stopped."""
    monkeypatch.setattr(run_record, "TRY_EVERY_S", 60.0)
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        assert robot.verdict(0)["verdict"]["outcome"] == "pass"
        limited: list[Store] = []
        real = Store._write

        def write(store: Store, statement: str, values: tuple[Any, ...]) -> int:
            if not limited:
                limited.append(store)
                (pages,) = store._db.execute("PRAGMA page_count").fetchone()
                store._db.execute(f"PRAGMA max_page_count = {pages}")
            return real(store, statement, values)

        monkeypatch.setattr(Store, "_write", write)
        for number in range(8):
            page(robot, "wells/0", "resume", f"{number} " + "x" * 4900)
        told = robot.overview()["actions"]
        assert [one["note"][0] for one in told] == list("01234567")
        assert robot.overview()["unrecorded"]
        limited[0]._db.execute("PRAGMA max_page_count = 1000000")
    store = Store(config.data)
    assert [one["note"][0] for one in store.actions("run-1")] == list("01234567")
    assert [one["at"] for one in store.actions("run-1")] == [one["at"] for one in told]
    store.close()
