"""The store: one process, older versions, damage, silent runs, retention."""

from __future__ import annotations

import json
import sqlite3
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from aegis_ot.errors import StoreError
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.config import RetentionSettings
from aegis_ot.sidecar.housekeeping import tidy
from aegis_ot.sidecar.schema import MIGRATIONS
from aegis_ot.sidecar.store import DATABASE, SILENT, Captured, Store
from aegis_ot.sidecar.wire import Finish, Hold, Recovery, RunStart
from aegis_ot.vocabulary import Outcome, Route, Verdict

from .helpers import Robot, StubAnalyser, StubCamera, make_jpeg, make_keyframe

DAY = 86_400.0


def fill(store: Store, run: str, ended_days_ago: float | None, frames: int = 1) -> None:
    store.register(RunStart(run=run, protocol=f"{run}.py"))
    for sequence in range(frames):
        keyframe = make_keyframe(run, sequence)
        store.add_keyframe(Captured(keyframe, 0.01, time.time()), make_jpeg())
    if ended_days_ago is not None:
        store.finish(run, Finish(outcome="succeeded"))
        at = time.time() - ended_days_ago * DAY
        store._write("UPDATE runs SET finished = ? WHERE run = ?", (at, run))


def names(store: Store) -> list[str]:
    return sorted(row["run"] for row in store.runs())


def test_a_second_sidecar_in_the_same_folder_is_refused(tmp_path: Path) -> None:
    first = Store(tmp_path, alone=True)
    with pytest.raises(StoreError, match=r"Another sidecar \(process \d+\) uses the data folder"):
        Store(tmp_path, alone=True)
    Store(tmp_path).close()  # who only reads may
    first.close()
    Store(tmp_path, alone=True).close()


def test_a_killed_sidecar_leaves_no_lock(tmp_path: Path) -> None:
    script = (
        "import os, sys; from pathlib import Path; from aegis_ot.sidecar.store import Store\n"
        "store = Store(Path(sys.argv[1]), alone=True); os.kill(os.getpid(), 9)"
    )
    subprocess.run([sys.executable, "-c", script, str(tmp_path)], check=False)
    Store(tmp_path, alone=True).close()


def test_an_older_store_becomes_a_newer_one_and_keeps_its_runs(tmp_path: Path) -> None:
    with sqlite3.connect(tmp_path / DATABASE) as db:
        db.executescript(f"{MIGRATIONS[0]} PRAGMA user_version = 1;")
        db.execute(
            "INSERT INTO runs VALUES ('old', 'old', ?, 5.0, 9.0, 'succeeded', '')",
            ('{"run": "old", "protocol": "old.py", "robot": "", "simulated": false}',),
        )
        db.execute("INSERT INTO holds VALUES ('old', 3, 0.5, 'verdict', NULL, 7.0)")
    db.close()
    store = Store(tmp_path, alone=True)
    assert [(row["run"], row["sidecar"]) for row in store.runs()] == [("old", None)]
    (hold,) = store.holds("old")
    assert (hold["trajectory"], hold["seconds"], hold["paused_s"]) == (3, 0.5, None)
    assert store.incidents("old") == store.actions("old") == []
    store.close()


def test_holds_of_the_store_before_go_on_beside_new_ones(tmp_path: Path) -> None:
    with sqlite3.connect(tmp_path / DATABASE) as db:
        for script in MIGRATIONS[:4]:
            db.executescript(script)
        db.execute("PRAGMA user_version = 4")
        for run in ("a", "b"):
            about = json.dumps({"run": run, "protocol": "p.py", "robot": "", "simulated": False})
            db.execute(
                "INSERT INTO runs (run, folder, start, registered) VALUES (?, ?, ?, 5.0)",
                (run, run, about),
            )
            for trajectory in (3, 0):
                db.execute(
                    "INSERT INTO holds VALUES (?, ?, 0.5, 'verdict', 'pause', 7.0, 2.0, 'page')",
                    (run, trajectory),
                )
    db.close()
    store = Store(tmp_path, alone=True)
    store.add_hold("a", Hold(number=0, trajectory=4, seconds=0.1, resolution="verdict"))
    store.add_hold("a", Hold(trajectory=5, seconds=0.1, resolution="verdict"))  # an older guard's
    assert [hold["trajectory"] for hold in store.holds("a")] == [0, 3, 4, 5]
    assert [(hold["paused_s"], hold["answered"]) for hold in store.holds("b")] == [
        (2.0, "page")
    ] * 2
    store.close()


@pytest.mark.parametrize("spoil", ["page", "cut", "junk"])
def test_a_damaged_store_is_refused_and_left_as_it_is(spoil: str, tmp_path: Path) -> None:
    store = Store(tmp_path, alone=True)
    for number in range(40):
        fill(store, f"run-{number}", None, frames=4)
    store._db.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    store.close()
    path = tmp_path / DATABASE
    data = bytearray(path.read_bytes())
    if spoil == "page":
        data[4096 * 2 : 4096 * 6] = b"\xff" * (4096 * 4)
    spoiled = {"page": bytes(data), "cut": bytes(data[: len(data) // 2]), "junk": b"junk" * 5000}
    path.write_bytes(spoiled[spoil])
    with pytest.raises(StoreError, match=r"is damaged.*Restore it from a backup"):
        Store(tmp_path, alone=True)
    assert path.read_bytes() == spoiled[spoil]


def test_a_run_that_ended_without_a_word_is_closed_and_opened_when_it_speaks(
    tmp_path: Path,
) -> None:
    store = Store(tmp_path)
    fill(store, "silent", None)
    fill(store, "ended", 0.1)
    settings = RetentionSettings(silent_h=2)
    assert tidy(store, settings, time.time() + 3600).closed == ()
    assert tidy(store, settings, time.time() + 3 * 3600).closed == ("silent",)
    row = store.run("silent")
    assert row is not None
    assert row["finished"]["outcome"] == SILENT
    assert "nothing for 2 h" in row["finished"]["detail"]
    store.reopen("silent")
    store.reopen("ended")
    assert [bool(row["finished"]) for row in map(store.run, ("silent", "ended")) if row] == [
        False, True,
    ]  # fmt: skip


def test_a_closed_run_goes_on_when_its_robot_does(config: SidecarConfig) -> None:
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
        robot.register()
        robot.send(0)
        store = Store(config.data)
        store.close_silent("run-1", "nothing for long")
        assert robot.overview()["finished"]["outcome"] == SILENT
        assert robot.send(1).status_code == 200
        assert robot.overview()["finished"] is None
        store.close()


def test_old_runs_go_and_unfinished_ones_stay(tmp_path: Path) -> None:
    store = Store(tmp_path)
    fill(store, "old", 40)
    fill(store, "new", 2)
    fill(store, "running", None)
    settings = RetentionSettings(days=30)
    assert tidy(store, settings, time.time(), pretend=True).removed == ("old",)
    assert names(store) == ["new", "old", "running"]
    done = tidy(store, settings, time.time())
    assert done.removed == ("old",)
    assert done.freed == len(make_jpeg())
    assert names(store) == ["new", "running"]
    assert store.size("old") == 0
    assert store.keyframes("old") == []


def test_the_oldest_go_until_the_size_is_kept(tmp_path: Path) -> None:
    store = Store(tmp_path)
    each = 5 * len(make_jpeg())
    for number, name in enumerate(("a", "b", "c")):
        fill(store, name, 3 - number, frames=5)
    done = tidy(store, RetentionSettings(gigabytes=1.5 * each / 1e9), time.time())
    assert done.removed == ("a", "b")
    assert names(store) == ["c"]


def test_runs_are_searched_and_counted(tmp_path: Path) -> None:
    store = Store(tmp_path)
    fill(store, "pcr-1", 1)
    fill(store, "dilution", None)
    assert [row["run"] for row in store.runs("pcr succeeded")] == ["pcr-1"]
    assert [row["run"] for row in store.runs("running")] == ["dilution"]
    assert store.runs("' OR 1 --") == []
    assert [row["run"] for row in store.runs(most=1, skip=1)] == ["pcr-1"]


def test_a_failed_attempt_counts_with_the_well_that_was_put_right_in_the_end(
    tmp_path: Path,
) -> None:
    store = Store(tmp_path)
    fill(store, "a", None)
    for number, outcome in enumerate((Outcome.FAIL, Outcome.FAIL, Outcome.PASS, Outcome.FAIL)):
        store.add_verdict(Verdict("a", number, outcome, Route.GREY_ZONE), {})
    for attempt, state, by in ((1, "failed", 1), (2, "recovered", 2)):
        told = Recovery(trajectory=0, attempt=attempt, action="retry", state=state, by=by)
        store.add_recovery("a", told)
    assert store.put_right("a") == {0, 1}
    assert store.outcomes("a") == {"recovered": 2, "pass": 1, "fail": 1}


def test_an_incident_is_kept_once_until_it_is_over(tmp_path: Path) -> None:
    store = Store(tmp_path)
    fill(store, "run", None)
    assert store.begin_incident("run", "camera", "no frame")
    assert not store.begin_incident("run", "camera", "still none")
    assert store.end_incidents("run", "camera")
    assert not store.end_incidents("run", "camera")
    assert store.begin_incident("run", "camera", "again")
    told: list[Any] = [one["text"] for one in store.incidents("run")]
    assert told == ["no frame", "again"]
