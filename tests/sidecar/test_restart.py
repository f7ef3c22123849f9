"""What a sidecar that ends, or is killed, leaves behind and takes up again."""

from __future__ import annotations

import contextlib
import json
import os
import re
import signal
import sqlite3
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from aegis_ot.errors import StoreError
from aegis_ot.sidecar import SidecarConfig, running_sidecar, service
from aegis_ot.sidecar.cameras.codec import decode_jpeg
from aegis_ot.sidecar.store import DATABASE, Captured, Store
from aegis_ot.sidecar.store.frames import FrameFiles
from aegis_ot.sidecar.store.schema import MIGRATIONS
from aegis_ot.sidecar.wire import RunStart

from .helpers import Robot, StubAnalyser, StubCamera, make_jpeg, make_keyframe


def test_a_run_goes_on_after_a_restart(config: SidecarConfig) -> None:
    with running_sidecar(config, StubCamera(), StubAnalyser(fails=[0])) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        assert robot.verdict(0)["verdict"]["outcome"] == "fail"
        robot.send(4)
    second = StubAnalyser()
    with running_sidecar(config, StubCamera(), second) as url, Robot(url) as robot:
        robot.register()
        assert robot.verdict(0)["verdict"]["outcome"] == "fail"
        answer = robot.send(6)
        assert (answer.status_code, answer.json()["expected"]) == (409, 5)
        for sequence in (4, 5, 6, 7):
            assert robot.send(sequence).status_code == 200
        assert robot.verdict(1)["verdict"]["outcome"] == "pass"
        (history,) = second.histories
        assert [verdict.trajectory for verdict, _ in history] == [0]
        assert history[0][1]["blobs"] == 3
        assert second.observed == [("run-1", n) for n in (4, 5, 6, 7)]


def test_what_was_captured_and_not_judged_is_judged_after_a_restart(
    config: SidecarConfig,
) -> None:
    stuck = StubAnalyser()
    stuck.gate.clear()
    with running_sidecar(config, StubCamera(), stuck) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        assert robot.verdict(0, wait=0)["verdict"] is None
        threading.Timer(0.1, stuck.gate.set).start()
    Store(config.data)._db.execute("DELETE FROM verdicts")
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
        assert robot.verdict(0)["verdict"]["outcome"] == "pass"


@pytest.mark.parametrize("silent", [False, True])
def test_runs_that_robots_left_without_a_word_leave_memory_and_come_back(
    config: SidecarConfig, silent: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A robot that is switched off in its run never says how it ended."""
    if silent:
        monkeypatch.setattr(service, "SILENT_S", -1.0)
        monkeypatch.setattr(service, "EMPTY_S", -1.0)
    analyser = StubAnalyser(fails=[0])
    with running_sidecar(config, StubCamera(), analyser) as url, Robot(url, "first") as first:
        first.register()
        first.cycle(0)
        assert first.verdict(0)["verdict"]["outcome"] == "fail"
        first.send(4)
        for number in range(service.SESSIONS_KEPT):
            with Robot(url, f"left-{number}") as robot:
                robot.register()
        assert first.verdict(0)["verdict"]["outcome"] == "fail"
        for sequence in (5, 6, 7):
            assert first.send(sequence).status_code == 200
        assert first.verdict(1)["verdict"]["outcome"] == "pass"
    assert len(analyser.histories) == (2 if silent else 1)


@contextlib.contextmanager
def sidecar_process(settings: Path, limit: int | None = None) -> Iterator[tuple[int, str]]:
    """A sidecar in a process of its own, whose files may grow to ``limit`` bytes: pid, URL."""
    code = "import sys, aegis_ot.sidecar.__main__ as m; sys.exit(m.main(sys.argv[1:]))"
    if limit is not None:
        code = f"import resource as r; r.setrlimit(r.RLIMIT_FSIZE, ({limit}, {limit})); {code}"
    process = subprocess.Popen(
        [sys.executable, "-c", code, str(settings)],
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"OMP_NUM_THREADS": "1"},
    )
    assert process.stderr is not None
    try:
        seen = []
        for line in process.stderr:
            seen.append(line)
            if found := re.search(r"address=(\S+)", line):
                yield process.pid, found[1]
                return
        pytest.fail("the sidecar did not start: " + "".join(seen))
    finally:
        process.kill()
        process.stderr.close()
        process.wait()


@pytest.fixture
def settings(tmp_path: Path) -> Path:
    path = tmp_path / "sidecar.json"
    path.write_text(
        json.dumps({"port": 0, "data": str(tmp_path / "data"), "camera": {"spec": "pattern"}})
    )
    return path


def test_kill_9_loses_no_acknowledged_keyframe(settings: Path, tmp_path: Path) -> None:
    acknowledged: list[int] = []
    with sidecar_process(settings) as (pid, url), Robot(url) as robot:
        robot.register()
        with contextlib.suppress(httpx.TransportError):
            while True:
                answer = robot.send(len(acknowledged))
                acknowledged.append(answer.json()["sequence"])
                if len(acknowledged) == 1:
                    # Killed from outside while keyframes are under way, at no chosen moment.
                    threading.Timer(0.3, os.kill, (pid, signal.SIGKILL)).start()
    assert acknowledged
    with sidecar_process(settings) as (_, url), Robot(url) as robot:
        answer = robot.send(len(acknowledged) + 5)
        expected = answer.json()["expected"]
        # The one under way may have been kept without its answer being heard.
        assert expected - len(acknowledged) in (0, 1)
        assert robot.send(len(acknowledged)).status_code == 200
        assert robot.send(len(acknowledged) + 1).status_code == 200
        kept = [k for t in robot.overview()["trajectories"] for k in t["keyframes"]]
        assert [k["sequence"] for k in kept] == list(range(len(acknowledged) + 2))
        for keyframe in kept:
            decode_jpeg(robot.http.get(keyframe["frame"]).content)
    database = sqlite3.connect(tmp_path / "data" / DATABASE)
    assert database.execute("PRAGMA integrity_check").fetchone() == ("ok",)


def test_a_full_disk_is_told_and_nothing_is_half_kept(settings: Path) -> None:
    """Files of the process may not grow beyond a limit: writing fails as on a full disk."""
    refused = None
    with sidecar_process(settings, limit=250_000) as (_, url), Robot(url) as robot:
        robot.register()
        kept = 0
        for sequence in range(200):
            answer = robot.send(sequence)
            if answer.status_code != 200:
                refused = answer
                break
            kept += 1
        assert refused is not None
        assert refused.status_code == 503
        assert refused.json()["error"]["code"] == "store"
        assert "free space" in refused.json()["error"]["message"]
        assert robot.http.get("/v1/health").status_code == 200
    with sidecar_process(settings) as (_, url), Robot(url) as robot:
        assert robot.send(kept).status_code == 200
        found = [k["sequence"] for t in robot.overview()["trajectories"] for k in t["keyframes"]]
        assert found == list(range(kept + 1))


def test_a_half_written_frame_is_written_again(tmp_path: Path) -> None:
    """Killed after the frame and before its row: the number is free, the file is replaced."""
    store = Store(tmp_path)
    store.register(RunStart(run="r"))
    keyframe = make_keyframe("r", 0)
    path = FrameFiles(tmp_path).path("r", 0)
    path.parent.mkdir(parents=True)
    path.write_bytes(b"old")
    assert store.next_sequence("r") == 0
    assert store.frame("r", 0) is None
    store.add_keyframe(Captured(keyframe, 0.01, 5.0), make_jpeg())
    assert Store(tmp_path).frame("r", 0) == make_jpeg()
    assert store.next_sequence("r") == 1


@pytest.mark.parametrize("left", [b"", b"\xff\xd8\xff half a frame", None])
def test_what_a_power_cut_tore_is_asked_for_again(
    left: bytes | None, config: SidecarConfig
) -> None:
    """A row can outlive its frame: nothing is forced onto the disk while the robot waits."""
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        assert robot.verdict(0)["verdict"]["outcome"] == "pass"
        for sequence in (4, 5, 6):
            robot.send(sequence)
    frames = FrameFiles(config.data)
    for sequence in (0, 5):  # what was judged needs its frame no more
        path = frames.path("run-1", sequence)
        path.unlink() if left is None else path.write_bytes(left)
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
        answer = robot.send(7)
        assert (answer.status_code, answer.json()["expected"]) == (409, 5)
        for sequence in (5, 6, 7):
            assert robot.send(sequence, late=True).status_code == 200
        assert robot.verdict(1)["verdict"]["outcome"] == "undecided"
        kept = [k["sequence"] for t in robot.overview()["trajectories"] for k in t["keyframes"]]
        assert kept == list(range(8))


def test_a_keyframe_is_kept_as_it_was_sent(tmp_path: Path) -> None:
    store = Store(tmp_path)
    store.register(RunStart(run="r"))
    keyframe = make_keyframe("r", 0, position=(1.0, 2.5, 3.0), reagent="müsli")
    store.add_keyframe(Captured(keyframe, 0.01, 5.0), make_jpeg())
    assert Store(tmp_path).keyframe("r", 0) == Captured(keyframe, 0.01, 5.0)


def test_a_store_of_a_newer_sidecar_is_refused(tmp_path: Path) -> None:
    Store(tmp_path)._db.execute(f"PRAGMA user_version = {len(MIGRATIONS) + 1}")
    with pytest.raises(StoreError, match="newer sidecar"):
        Store(tmp_path)


def test_an_unusable_data_folder_is_told(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    with pytest.raises(StoreError, match="Cannot open the store"):
        Store(tmp_path / "file")
    (tmp_path / "broken").mkdir()
    (tmp_path / "broken" / DATABASE).write_bytes(b"not a database" * 100)
    with pytest.raises(StoreError, match="not a database"):
        Store(tmp_path / "broken")


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_stop_is_clean(number: signal.Signals, tmp_path: Path) -> None:
    """Whoever waits is answered, the exit status is 0, and the folder is free."""
    command = [
        sys.executable, "-c", "from aegis_ot.cli import main; main()", "sidecar",
        "--camera", "pattern", "--port", "0", "--data", str(tmp_path),
    ]  # fmt: skip
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        url = process.stdout.readline().split()[-1]
        answers: list[int] = []
        version = httpx.get(f"{url}/v1/news", trust_env=False).json()["version"]

        def wait() -> None:
            query = {"after": version, "wait": 20}
            answer = httpx.get(f"{url}/v1/news", params=query, trust_env=False, timeout=60)
            answers.append(answer.status_code)

        page = threading.Thread(target=wait)
        page.start()
        page.join(0.5)
        process.send_signal(number)
        assert process.wait(60) == 0
        page.join(60)
        assert answers == [200]
    Store(tmp_path, alone=True).close()
