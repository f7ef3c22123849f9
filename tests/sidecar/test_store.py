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
from aegis_ot.run_view import run_account
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.app import create_app
from aegis_ot.sidecar.config import RetentionSettings
from aegis_ot.sidecar.housekeeping import tidy
from aegis_ot.sidecar.overview import run_overview, runs_overview
from aegis_ot.sidecar.store import DATABASE, SILENT, Captured, Store
from aegis_ot.sidecar.store.schema import MIGRATIONS
from aegis_ot.sidecar.wire import Finish, HoldReport, RecoveryReport, RunStart
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
        at, later = time.time() - ended_days_ago * DAY, ended_days_ago * DAY
        store._write(
            "UPDATE runs SET finished = ?, heard = heard - ? WHERE run = ?", (at, later, run)
        )


@pytest.mark.parametrize("beneath", ["", "data"])
def test_a_file_where_the_folder_should_be_is_named(tmp_path: Path, beneath: str) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(StoreError, match=r"a file is in the way\.$"):
        Store(tmp_path / "file" / beneath)


def pass_time(store: Store, seconds: float) -> None:
    """So much more that a sidecar was at work."""
    store._write("UPDATE at_work SET seconds = seconds + ?", (seconds,))


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
    store.add_hold("a", HoldReport(number=0, trajectory=4, seconds=0.1, resolution="verdict"))
    store.add_hold(
        "a", HoldReport(trajectory=5, seconds=0.1, resolution="verdict")
    )  # an older guard's
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
    assert tidy(store, settings).closed == ()
    pass_time(store, 3 * 3600)
    assert tidy(store, settings).closed == ("silent",)
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
    assert tidy(store, settings, pretend=True).removed == ("old",)
    assert names(store) == ["new", "old", "running"]
    done = tidy(store, settings)
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
    done = tidy(store, RetentionSettings(gigabytes=1.5 * each / 1e9))
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
        told = RecoveryReport(trajectory=0, attempt=attempt, action="retry", state=state, by=by)
        store.add_recovery("a", told, float(attempt))
    assert store.put_right("a") == {0, 1}
    (row,) = runs_overview(store)
    assert row["wells"] == {"recovered": 2, "pass": 1, "fail": 1}


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


@pytest.mark.parametrize("ahead", [366 * DAY, -30 * 366 * DAY])
def test_a_clock_that_is_set_removes_and_closes_nothing(
    tmp_path: Path, ahead: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = Store(tmp_path, alone=True)
    fill(store, "ended", 2)
    fill(store, "running", None)
    real = time.time
    monkeypatch.setattr(time, "time", lambda: real() + ahead)
    for _ in range(2):  # and when the sidecar is started anew
        store.count_time(())
        done = tidy(store, RetentionSettings(days=30, silent_h=24))
        assert (done.closed, done.removed) == ((), ())
        store.close()
        store = Store(tmp_path, alone=True)
    monkeypatch.undo()
    pass_time(store, 31 * DAY)
    assert tidy(store, RetentionSettings(days=30, silent_h=24)).removed == ("ended",)
    store.close()


def test_a_run_whose_robot_asks_is_alive(config: SidecarConfig) -> None:
    """It is paused for days, and asks the page twice a second."""
    retention = RetentionSettings(gigabytes=1e-9)
    config = config.model_copy(update={"retention": retention})
    app = create_app(config, StubCamera(), StubAnalyser())
    sidecar = app.state.sidecar
    for run in ("asks", "left"):
        sidecar.register(RunStart(run=run))
    pass_time(sidecar.store, 25 * 3600)
    sidecar._sessions["left"].asked -= 25 * 3600
    sidecar.session("asks", "").action(0)
    sidecar._housekeeper.look()
    assert {row["run"]: bool(row["finished"]) for row in sidecar.store.runs()} == {
        "asks": False, "left": True,
    }  # fmt: skip
    sidecar.close()


def test_a_silent_run_is_not_removed_at_once_for_its_size(tmp_path: Path) -> None:
    store = Store(tmp_path)
    fill(store, "incubates", None)
    pass_time(store, 25 * 3600)
    settings = RetentionSettings(gigabytes=1e-9)
    assert tidy(store, settings).closed == ("incubates",)
    assert tidy(store, settings).removed == ()
    pass_time(store, 8 * DAY)
    assert tidy(store, settings).removed == ("incubates",)


class TestRot:
    """One row that cannot be read spoils itself alone."""

    @pytest.mark.parametrize("rotten", ["{not json", "[1, 2]", "", b"\xff\xfe\x00"])
    def test_the_history_shows_the_others(self, tmp_path: Path, rotten: Any) -> None:
        store = Store(tmp_path, alone=True)
        for run in ("good", "bad"):
            fill(store, run, 1, frames=4)
            store.add_verdict(Verdict(run, 0, Outcome.PASS, Route.SILENT_PASS), {"drawn_ul": 3.0})
        store.add_audit("bad", {})
        for table, column in (
            ("runs", "start"), ("runs", "sidecar"), ("verdicts", "verdict"),
            ("verdicts", "evidence"), ("audits", "audit"),
        ):  # fmt: skip
            store._write(f"UPDATE {table} SET {column} = ? WHERE run = 'bad'", (rotten,))
        store._write(
            "UPDATE keyframes SET keyframe = ? WHERE run = 'bad' AND sequence = 2", (rotten,)
        )
        rows = {row["run"]: row for row in runs_overview(store)}
        assert rows["good"]["wells"] == {"pass": 1}
        assert rows["bad"]["wells"].get("pass") is None
        assert "damaged" in rows["bad"]["protocol"]
        assert [row["run"] for row in store.runs("good")] == ["good"]
        overview = run_overview(store, "bad")
        assert overview["trajectories"][0]["verdict"]["outcome"] == "undecided"
        assert len(overview["trajectories"][0]["keyframes"]) == 3
        assert run_account(overview)["counts"] == {"undecided": 1, "wells": 1, "deliveries": 1}
        store.close()

    def test_a_well_with_a_moment_that_is_lost_does_not_pass(self, config: SidecarConfig) -> None:
        stuck = StubAnalyser()
        stuck.gate.clear()
        with running_sidecar(config, StubCamera(), stuck) as url, Robot(url) as robot:
            robot.register()
            for sequence in range(3):
                robot.send(sequence)
            stuck.gate.set()
        store = Store(config.data)
        store._write("UPDATE keyframes SET keyframe = '{' WHERE sequence = 1", ())
        store.close()
        with running_sidecar(config, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
            robot.send(3)
            assert robot.verdict(0)["verdict"]["outcome"] == "undecided"


def test_a_store_that_is_closed_is_not_called_damaged(tmp_path: Path) -> None:
    store = Store(tmp_path, alone=True)
    store.close()
    with pytest.raises(StoreError, match="being stopped") as caught:
        store.runs()
    assert "backup" not in str(caught.value)


@pytest.mark.parametrize("log", [True, False])
def test_a_database_of_no_bytes_is_no_new_store(tmp_path: Path, log: bool) -> None:
    store = Store(tmp_path, alone=True)
    fill(store, "run", 1)
    store.close()
    path = tmp_path / DATABASE
    path.write_bytes(b"")
    if log:
        (tmp_path / "frames").rename(tmp_path / "elsewhere")
        path.with_name(f"{DATABASE}-wal").write_bytes(b"a log")
    for alone in (True, False):
        with pytest.raises(StoreError, match=r"is empty \(0 bytes\), but there was one"):
            Store(tmp_path, alone=alone)
    assert path.read_bytes() == b""
    path.unlink()
    Store(tmp_path, alone=True).close()  # moved away: begun anew


def test_a_first_start_that_was_cut_short_is_a_new_store(tmp_path: Path) -> None:
    (tmp_path / DATABASE).write_bytes(b"")
    Store(tmp_path, alone=True).close()
