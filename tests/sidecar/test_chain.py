"""The hash chain of a run: what was changed afterwards is found, and nothing else."""

from __future__ import annotations

import json
import os
import random
import shutil
import sqlite3
import stat
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
from aegis_ot.sidecar.store import DATABASE, Captured, Store
from aegis_ot.sidecar.store.schema import MIGRATIONS
from aegis_ot.sidecar.store.signing import KEY_FILE, public_key
from aegis_ot.sidecar.store.verifying import VerifiedRun, verify_runs
from aegis_ot.sidecar.wire import (
    Action,
    Decision,
    Finish,
    HoldReport,
    RecoveryReport,
    RunStart,
)
from aegis_ot.vocabulary import Outcome, Route, Verdict
from tests.cli.commands import Command
from tests.cli.conftest import aegis  # noqa: F401

from .helpers import Robot, StubAnalyser, StubCamera, make_jpeg, make_keyframe, until

MEANINGLESS = {("runs", "heard")}


def fill(store: Store, run: str, rng: random.Random) -> None:
    """A run with something in every table."""
    store.register(RunStart(run=run, protocol=f"{run}.py", robot_name="ot"), {"version": "1"})
    wells = rng.randint(3, 6)
    for sequence in range(4 * wells):
        keyframe = make_keyframe(run, sequence)
        jpeg = make_jpeg(rng.randrange(256))
        store.add_keyframe(Captured(keyframe, rng.random(), time.time()), jpeg)
    store.mark_late(run, 1)
    for trajectory in range(wells):
        verdict = Verdict(run, trajectory, Outcome.UNDECIDED, Route.GREY_ZONE, rng.random())
        store.add_verdict(verdict, {"drawn_ul": rng.random()})
        store.add_hold(run, HoldReport(trajectory=trajectory, seconds=1.0, resolution="verdict"))
    store.withdraw_verdict(Verdict(run, 0, Outcome.PASS, Route.SILENT_PASS))
    store.add_hold(run, HoldReport(trajectory=0, seconds=rng.random(), resolution="verdict"))
    store.abandon(run, wells, "given up")
    for number in range(2):
        decision = Decision(outcome=Outcome.PASS, by=f"Ada {number}", note="seen")
        store.add_decision(run, number, decision)
        store.add_action(run, number, Action(action="resume", by=f"Ada {number}", note="go"))
        store.add_recovery(
            run,
            RecoveryReport(trajectory=number, attempt=0, action="retry", state="begun", text="x"),
            5.0,
        )
        store.add_incident(run, "link", f"cable {number}", 1.0, 2.0)
    store.begin_incident(run, "camera", "dark")
    store.end_incidents(run, "camera")
    store.add_audit(run, {"suspects": [rng.random()]})
    folder = store.frame_path(run, 0).parent
    store.keep_clip(run, 0, rng.randbytes(40))
    assert folder.is_dir()
    store.finish(run, Finish(outcome="succeeded"))


@pytest.fixture
def kept(tmp_path: Path) -> Path:
    folder = tmp_path / "data"
    store = Store(folder)
    for number in range(2):
        fill(store, f"run-{number}", random.Random(number))
    store._db.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    store.close()
    return folder


def verified(folder: Path, *runs: str, keys: tuple[str, ...] = ()) -> list[VerifiedRun]:
    store = Store(folder)
    try:
        own = public_key(folder)
        return verify_runs(store, {own or "", *keys}, runs)
    finally:
        store.close()


def tampered(folder: Path) -> list[tuple[str, str, str]]:
    return [(one.run, t.what, t.where) for one in verified(folder) for t in one.found]


def tables(db: sqlite3.Connection) -> list[str]:
    rows = db.execute("SELECT name FROM sqlite_master WHERE type = 'table'").fetchall()
    return [name for (name,) in rows if name != "at_work"]


def other(value: Any, rng: random.Random) -> Any:
    if value is None:
        return "x"
    if isinstance(value, str):
        place = rng.randrange(len(value)) if value else 0
        return (
            value[:place] + ("#" if value[place : place + 1] != "#" else "$") + value[place + 1 :]
        )
    return value + rng.choice((1, 1000))


def change_cell(folder: Path, rng: random.Random) -> str:
    with sqlite3.connect(folder / DATABASE) as db:
        table = rng.choice(tables(db))
        columns = [row[1] for row in db.execute(f"PRAGMA table_info({table})")]
        column = rng.choice([c for c in columns if (table, c) not in MEANINGLESS])
        rows = db.execute(f"SELECT rowid, {column} FROM {table}").fetchall()
        rowid, value = rng.choice(rows)
        new = other(value, rng)
        db.execute(f"UPDATE OR REPLACE {table} SET {column} = ? WHERE rowid = ?", (new, rowid))
    db.close()
    return f"{table}.{column} {value!r} -> {new!r}"


def remove_row(folder: Path, rng: random.Random) -> str:
    with sqlite3.connect(folder / DATABASE) as db:
        table = rng.choice(tables(db))
        (rowid,) = rng.choice(db.execute(f"SELECT rowid FROM {table}").fetchall())
        db.execute(f"DELETE FROM {table} WHERE rowid = ?", (rowid,))
    db.close()
    return f"a row of {table}"


def add_row(folder: Path, rng: random.Random) -> str:
    key = {"keyframes": "sequence", "decisions": "id", "actions": "id", "incidents": "id",
           "chain": "number", "verdicts": "trajectory", "holds": "number"}  # fmt: skip
    table = rng.choice(list(key))
    with sqlite3.connect(folder / DATABASE) as db:
        columns = [row[1] for row in db.execute(f"PRAGMA table_info({table})")]
        values = ", ".join(f"{c} + 5000" if c == key[table] else c for c in columns)
        db.execute(f"INSERT INTO {table} SELECT {values} FROM {table} ORDER BY random() LIMIT 1")
    db.close()
    return f"a row into {table}"


def change_frame(folder: Path, rng: random.Random) -> str:
    path = rng.choice(sorted((folder / "frames").rglob("*.*")))
    content = bytearray(path.read_bytes())
    place = rng.randrange(len(content))
    content[place] ^= 1 << rng.randrange(8)
    path.write_bytes(bytes(content))
    return f"byte {place} of {path.name}"


def remove_frame(folder: Path, rng: random.Random) -> str:
    path = rng.choice(sorted((folder / "frames").rglob("*.*")))
    path.unlink()
    return path.name


def swap_rows(folder: Path, rng: random.Random) -> str:
    table, column = rng.choice((("decisions", "by"), ("actions", "by"), ("incidents", "text")))
    with sqlite3.connect(folder / DATABASE) as db:
        run = rng.choice(("run-0", "run-1"))
        rows = db.execute(f'SELECT id, "{column}" FROM {table} WHERE run = ?', (run,)).fetchall()
        (one, mine), (two, its) = rows[:2]
        db.execute(f'UPDATE {table} SET "{column}" = ? WHERE id = ?', (its, one))
        db.execute(f'UPDATE {table} SET "{column}" = ? WHERE id = ?', (mine, two))
    db.close()
    return f"rows of {table}"


CHANGES = (change_cell, change_cell, change_frame, remove_row, add_row, remove_frame, swap_rows)


def test_each_of_200_random_changes_is_found(kept: Path, tmp_path: Path) -> None:
    rng = random.Random(44)
    missed = []
    for number in range(200):
        copy = tmp_path / "copy"
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(kept, copy)
        what = CHANGES[number % len(CHANGES)](copy, rng)
        if not tampered(copy):
            missed.append(what)
    assert missed == []


def test_50_sound_records_are_sound(tmp_path: Path) -> None:
    store = Store(tmp_path)
    for number in range(50):
        fill(store, f"run-{number}", random.Random(number))
    store.close()
    found = verified(tmp_path)
    assert [one.state for one in found] == ["sound"] * 51
    assert all(one.closed and not one.notes for one in found[1:])


def test_it_is_said_where(kept: Path) -> None:
    with sqlite3.connect(kept / DATABASE) as db:
        db.execute("UPDATE decisions SET \"by\" = 'Eve' WHERE id = 1")
        db.execute("DELETE FROM verdicts WHERE run = 'run-0' AND trajectory = 2")
    db.close()
    frames = sorted((kept / "frames").glob("run-1*/0000*.jpg"))
    first, second = frames[0].read_bytes(), frames[1].read_bytes()
    assert first != second
    frames[0].write_bytes(second)
    frames[1].write_bytes(first)
    frames[0].with_name("000077.jpg").write_bytes(first)
    assert sorted(tampered(kept)) == [
        ("run-0", "changed", "decision 1"),
        ("run-0", "removed", "verdict of delivery 2"),
        ("run-1", "added", "frame 77"),
        ("run-1", "reordered", "frame 0"),
        ("run-1", "reordered", "frame 1"),
    ]


def test_a_chain_that_was_made_anew_lacks_the_signature(kept: Path) -> None:
    """Somebody without the key changes a record and computes all hashes again, or cuts the end."""
    from aegis_ot.sidecar.store.chain import digest_of, link

    with sqlite3.connect(kept / DATABASE) as db:
        db.row_factory = sqlite3.Row
        db.execute("UPDATE decisions SET \"by\" = 'Eve' WHERE id = 1")
        new = digest_of(
            "decisions", dict(db.execute("SELECT * FROM decisions WHERE id=1").fetchone())
        )
        head = ""
        for row in db.execute("SELECT * FROM chain WHERE run = 'run-0' ORDER BY number").fetchall():
            entry = dict(row)
            if (entry["kind"], entry["key"]) == ("decisions", "1"):
                entry["digest"] = new
            head = link(head, entry)
            db.execute("UPDATE chain SET digest = ?, hash = ? WHERE run = 'run-0' AND number = ?",
                       (entry["digest"], head, entry["number"]))  # fmt: skip
        db.execute("DELETE FROM chain WHERE run = 'run-1' AND number = "
                   "(SELECT max(number) FROM chain WHERE run = 'run-1')")  # fmt: skip
    db.close()
    assert tampered(kept)[0][:2] == ("run-0", "signature")
    assert ("run-1", "signature") in [(run, what) for run, what, _ in tampered(kept)]


def test_runs_that_were_added_or_lost_are_told_of(kept: Path) -> None:
    with sqlite3.connect(kept / DATABASE) as db:
        for table in tables(db):
            db.execute(f"DELETE FROM {table} WHERE run = 'run-0'")
        db.execute("INSERT INTO runs (run, folder, start, registered) VALUES ('x', 'x', '{}', 1.0)")
    db.close()
    assert tampered(kept) == [
        ("", "removed", "the run 'run-0'"),
        ("", "added", "the run 'x'"),
        ("x", "removed", "the whole chain"),
        ("run-0", "removed", "the whole chain"),
    ]


def test_a_run_removed_by_retention_is_no_tampering(kept: Path) -> None:
    store = Store(kept)
    tidy(store, RetentionSettings(days=1), {"run-0": 2 * 86_400.0, "run-1": 5.0})
    store.close()
    found = verified(kept)
    assert {one.run: one.state for one in found} == {
        "": "sound",
        "run-0": "removed",
        "run-1": "sound",
    }
    assert verified(kept, "run-0")[-1].notes == ("removed by retention",)


def test_retention_that_was_killed_half_way_is_no_tampering(kept: Path) -> None:
    store = Store(kept)
    with store._transaction("write to"):
        store._chain.remove("run-0", "retention")
    store._frames.remove("run-0")
    store.close()
    run = verified(kept, "run-0")[-1]
    assert run.state == "sound"
    assert "is being removed by retention" in run.notes[0]
    store = Store(kept)
    tidy(store, RetentionSettings(days=1), {"run-0": 2 * 86_400.0})
    store.close()
    assert verified(kept, "run-0")[-1].state == "removed"


def test_an_older_run_has_no_chain_and_is_never_sound(tmp_path: Path) -> None:
    with sqlite3.connect(tmp_path / DATABASE) as db:
        for number, script in enumerate(MIGRATIONS[:7]):
            db.executescript(f"{script} PRAGMA user_version = {number + 1};")
        db.execute("INSERT INTO runs (run, folder, start, registered) VALUES ('old','old','{}',5)")
    db.close()
    assert [one.state for one in verified(tmp_path)] == ["unchained"]
    store = Store(tmp_path)
    store.add_decision("old", 0, Decision(outcome=Outcome.PASS, by="Ada"))
    fill(store, "new", random.Random(1))
    store.close()
    states = {one.run: one.state for one in verified(tmp_path)}
    assert states == {"": "sound", "old": "unchained", "new": "sound"}


def test_a_damaged_or_foreign_key_is_told_of(kept: Path) -> None:
    old = public_key(kept)
    assert stat.S_IMODE((kept / KEY_FILE).stat().st_mode) == 0o600
    (kept / KEY_FILE).write_text("rotten")
    with pytest.raises(StoreError, match=r"signing key .* is damaged"):
        Store(kept, alone=True)
    (kept / KEY_FILE).unlink()
    store = Store(kept)
    store.add_decision("run-1", 0, Decision(outcome=Outcome.PASS, by="Ada"))
    store.close()
    assert public_key(kept) != old
    assert {(run, what) for run, what, _ in tampered(kept)} == {
        ("", "signature"),
        ("run-0", "signature"),
    }
    assert old is not None
    assert all(one.state == "sound" for one in verified(kept, keys=(old,)))


def test_a_sidecar_that_is_killed_leaves_a_sound_record(tmp_path: Path) -> None:
    script = (
        "import os, random, sys; from pathlib import Path\n"
        "from aegis_ot.sidecar.store import Store; from tests.sidecar.test_chain import fill\n"
        "store = Store(Path(sys.argv[1]), alone=True); store.finish = lambda *a: None\n"
        "fill(store, 'run-1', random.Random(3)); os.kill(os.getpid(), 9)"
    )
    subprocess.run([sys.executable, "-c", script, str(tmp_path)], check=False)
    (run,) = verified(tmp_path, "run-1")[1:]
    assert (run.state, run.closed) == ("sound", False)
    store = Store(tmp_path, alone=True)
    frame = store.frame_path("run-1", 0).with_name(f"{store.next_sequence('run-1'):06d}.jpg")
    frame.write_bytes(make_jpeg())  # killed between a frame and its row
    store.close()
    (run,) = verified(tmp_path, "run-1")[1:]
    assert run.state == "sound"
    assert "no part of the record" in run.notes[0]


def test_a_full_disk_takes_neither_a_record_nor_its_entry(kept: Path) -> None:
    store = Store(kept)
    store._db.execute(
        f"PRAGMA max_page_count = {store._db.execute('PRAGMA page_count').fetchone()[0]}"
    )
    decision = Decision(outcome=Outcome.PASS, by="Ada", note="x" * 3000)
    refused = 0
    for _ in range(60):
        try:
            store.add_decision("run-1", 0, decision)
        except StoreError as error:
            refused += "full" in str(error)
    assert refused > 10
    assert len(store.decisions("run-1")[0]) == 1 + 60 - refused
    store._db.execute("PRAGMA max_page_count = 100000")
    store.add_decision("run-1", 0, decision)
    store.close()
    assert tampered(kept) == []


def test_frames_that_a_power_cut_tore_and_that_came_again(tmp_path: Path) -> None:
    store = Store(tmp_path)
    store.register(RunStart(run="r"))
    for sequence in range(4):
        store.add_keyframe(Captured(make_keyframe("r", sequence), 0.1, 1.0), make_jpeg())
    store.frame_path("r", 2).write_bytes(b"")
    store.forget_torn("r")
    assert store.next_sequence("r") == 2
    store.close()
    assert tampered(tmp_path) == []
    store = Store(tmp_path)
    store.add_keyframe(Captured(make_keyframe("r", 2), 0.1, 1.0), make_jpeg(9))
    store.close()
    assert tampered(tmp_path) == []


def test_a_power_cut_that_took_the_last_rows_is_no_tampering(tmp_path: Path) -> None:
    store = Store(tmp_path)
    store.register(RunStart(run="r"))
    store.add_keyframe(Captured(make_keyframe("r", 0), 0.1, 1.0), make_jpeg())
    for sequence in (1, 2, 3, 7):
        store.frame_path("r", sequence).write_bytes(make_jpeg())
    store.close()
    (run,) = verified(tmp_path, "r")[1:]
    assert [t.where for t in run.found] == ["frame 7"]
    assert [note[:7] for note in run.notes] == ["frame 1", "frame 2", "frame 3"]


@pytest.mark.parametrize("silent", [True, False])
def test_torn_frames_of_a_run_that_never_went_on_are_forgotten(
    config: SidecarConfig, camera: StubCamera, analyser: StubAnalyser, silent: bool
) -> None:
    store = Store(config.data)
    store.register(RunStart(run="r"))
    for sequence in range(3):
        store.add_keyframe(Captured(make_keyframe("r", sequence), 0.1, 1.0), make_jpeg())
    store.frame_path("r", 1).write_bytes(b"")
    if silent:
        assert tidy(store, RetentionSettings(), {"r": 1e9}).closed == ("r",)
    store.close()
    if not silent:
        assert tampered(config.data) == [("r", "changed", "frame 1")]
        with running_sidecar(config, camera, analyser):
            pass
    assert tampered(config.data) == []


def test_another_picture_in_the_place_of_a_frame_is_found(kept: Path) -> None:
    frame = next((kept / "frames").glob("run-0*/000002.jpg"))
    frame.rename(frame.with_name("2.jpg"))
    assert tampered(kept) == [("run-0", "removed", "frame 2"), ("run-0", "added", "frame 2.jpg")]
    frame.write_bytes(make_jpeg(77))
    found = {(what, where) for _, what, where in tampered(kept)}
    assert found == {("changed", "frame 2"), ("added", "frame 2.jpg")}


def test_what_is_written_while_a_record_is_read_is_not_missed(tmp_path: Path) -> None:
    store = Store(tmp_path)
    store.register(RunStart(run="r"))
    listed = store.files_of

    def files_of(run: str) -> dict[tuple[str, str], Path]:
        files = listed(run)
        for sequence in range(2):
            store.add_keyframe(Captured(make_keyframe(run, sequence), 0.1, 1.0), make_jpeg())
        store.keep_clip(run, 0, b"clip")
        return files

    store.files_of = files_of  # type: ignore[method-assign]
    found = verify_runs(store, {public_key(tmp_path) or ""}, ["r"])[-1]
    assert (found.state, found.found) == ("sound", ())
    store.close()


def test_a_folder_without_hard_links_has_a_key_as_soon_as_a_sidecar_has_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def link(*_: object) -> None:
        raise PermissionError(1, "Operation not permitted")

    monkeypatch.setattr(os, "link", link)
    Store(tmp_path, alone=True).close()
    assert [path.name for path in tmp_path.glob("signing*")] == [KEY_FILE]
    assert stat.S_IMODE((tmp_path / KEY_FILE).stat().st_mode) == 0o600
    assert public_key(tmp_path)


def test_who_may_not_read_the_key_verifies_with_the_public_one(aegis: Command, kept: Path) -> None:  # noqa: F811
    public = public_key(kept)
    (kept / KEY_FILE).unlink()
    (kept / KEY_FILE).mkdir()  # root could read any file
    assert aegis("runs", "verify", "--data", kept).code == 2
    garbled = aegis("runs", "verify", "--data", kept, "--key", public[1:])
    assert (garbled.code, "64 hexadecimal digits" in garbled.err) == (2, True)
    said = aegis("runs", "verify", "--data", kept, "--key", public)
    assert (said.code, "cannot be read" in said.err) == (0, True)


def test_a_live_run_is_sound_at_every_moment_and_after_a_late_decision(
    aegis: Command,  # noqa: F811
    config: SidecarConfig,
    camera: StubCamera,
    analyser: StubAnalyser,
) -> None:
    with running_sidecar(config, camera, analyser) as url, Robot(url) as robot:
        robot.register()
        for trajectory in range(3):
            robot.cycle(trajectory)
            assert all(one.state == "sound" for one in verified(config.data))
        robot.verdict(2)
        robot.post("finish", {"outcome": "succeeded"})
        until(lambda: verified(config.data)[-1].closed)
        before = verified(config.data)[-1]
        robot.post("trajectories/2/decision", {"outcome": "pass", "by": "Ada", "note": "seen"})
        until(lambda: verified(config.data)[-1].entries > before.entries)
        after = verified(config.data)[-1]
        assert (after.state, after.closed) == ("sound", True)
        assert after.head != before.head
        said = aegis("runs", "verify", "--data", config.data)
        assert said.code == 0, said.out + said.err
        assert after.head in said.out
    frame = min((config.data / "frames").rglob("*.jpg"))
    frame.write_bytes(frame.read_bytes()[:-1])
    said = aegis("runs", "verify", "run-1", "--data", config.data)
    assert said.code == 1
    assert "NOT as it was written" in said.out
    assert "changed: frame 0" in said.out


def test_the_command_says_what_it_cannot_do(aegis: Command, kept: Path, tmp_path: Path) -> None:  # noqa: F811
    wrong = aegis("runs", "verify", "zebra", "--data", kept)
    assert (wrong.code, "holds no run 'zebra'" in wrong.err) == (2, True)
    assert aegis("runs", "verify", "--data", tmp_path / "nowhere").code == 2
    Store(tmp_path / "empty").close()
    empty = aegis("runs", "verify", "--data", tmp_path / "empty")
    assert (empty.code, "no run was kept yet" in empty.out) == (1, True)
    told = json.loads(aegis("runs", "verify", "--json", "--data", kept).out)
    assert [one["state"] for one in told] == ["sound"] * 3
    (kept / DATABASE).write_bytes(b"SQLite format 3\x00" + b"\x07" * 8000)
    assert aegis("runs", "verify", "--data", kept).code == 2
