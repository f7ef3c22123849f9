"""Several files at a time: their order, and an interruption that leaves nothing behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from aegis_ot.preflight import load_rules
from aegis_ot.workbench import CheckSettings, check_files
from aegis_ot.workbench.side_by_side import LazyRehearser, check_each

EMPTY = 'metadata = {"apiLevel": "2.15"}\n\n\ndef run(protocol):\n    pass\n'
ENDLESS = """import pathlib
metadata = {"apiLevel": "2.15"}


def run(protocol):
    pathlib.Path(FILE).touch()
    while True:
        pass
"""


def test_results_and_reports_keep_the_order_of_the_files() -> None:
    second_is_done = threading.Event()

    def check(file: Path, rehearser: LazyRehearser) -> str:
        if file.name == "first":
            assert second_is_done.wait(60), "they do not run side by side"
        else:
            second_is_done.set()
        return file.name

    told: list[str] = []
    files = [Path("first"), Path("second"), Path("third")]
    assert check_each(files, 2, (), check, told.append) == ["first", "second", "third"]
    assert told == ["first", "second", "third"]


def test_what_one_file_raises_is_raised_and_the_rest_is_cancelled() -> None:
    asked: list[str] = []

    def check(file: Path, rehearser: LazyRehearser) -> None:
        if not rehearser.cancelled.is_set():
            asked.append(file.name)
        if file.name == "0":
            raise LookupError(file.name)
        assert rehearser.cancelled.wait(60), "it goes on"

    with pytest.raises(LookupError, match="0"):
        check_each([Path(str(n)) for n in range(200)], 2, (), check, lambda _: None)
    assert set(asked) <= {"0", "1", "2"}


def test_two_jobs_give_what_one_gives(tmp_path: Path) -> None:
    """One job at a time is what every other test of this room has."""
    files = []
    for name, text in [("a.py", EMPTY), ("b.py", "def run(:\n"), ("c.py", EMPTY)]:
        (tmp_path / name).write_text(text, encoding="utf-8")
        files.append(tmp_path / name)
    files.append(tmp_path / "missing.py")
    run = check_files(files, CheckSettings(jobs=2), load_rules())
    told = [
        (Path(c.file).name, c.verdict.value, c.problem and c.problem.line) for c in run.protocols
    ]
    assert told == [
        ("a.py", "pass", None),
        ("b.py", "error", 1),
        ("c.py", "pass", None),
        ("missing.py", "error", None),
    ]


@pytest.mark.skipif(not hasattr(signal, "pthread_kill"), reason="signals of threads")
def test_an_interruption_is_heard_whichever_thread_the_system_gives_it_to() -> None:
    heard: list[bool] = []
    all_are_asked_for = threading.Event()

    def check(file: Path, rehearser: LazyRehearser) -> None:
        if file.name == "second":
            assert all_are_asked_for.wait(60)
            signal.pthread_kill(threading.get_ident(), signal.SIGINT)
            heard.append(rehearser.cancelled.wait(60))

    files = [Path("first"), Path("second")]
    # A shell that starts the tests in the background has SIGINT ignored, for Python too.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            check_each(files, 2, (), check, lambda _: all_are_asked_for.set())
    finally:
        signal.signal(signal.SIGINT, before)
    assert heard == [True]


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="looks for processes in /proc")
def test_an_interruption_ends_every_rehearsal_and_is_told_in_one_line(tmp_path: Path) -> None:
    marks = [tmp_path / f"started{n}" for n in range(2)]
    for number, mark in enumerate(marks):
        text = ENDLESS.replace("FILE", repr(str(mark)))
        (tmp_path / f"p{number}.py").write_text(text, encoding="utf-8")
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    command = (
        "import signal; signal.signal(signal.SIGINT, signal.default_int_handler); "
        "from aegis_ot.cli import main; main()"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", command, "check", "p0.py", "p1.py", "--jobs", "2"],
        cwd=tmp_path,
        env={**os.environ, "TMPDIR": str(scratch), "AEGIS_OT_WARM": "0"},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        _until(lambda: all(mark.exists() for mark in marks))
        process.send_signal(signal.SIGINT)
        out, told = process.communicate(timeout=60)
    finally:
        process.kill()
    assert (process.returncode, out) == (130, "")
    assert told == "aegis-ot: interrupted; nothing more is done.\n"
    assert list(scratch.glob("aegis-ot-*")) == []
    _until(lambda: _processes(str(scratch)) == [])


def _until(holds: Callable[[], bool], limit_s: float = 90.0) -> None:
    deadline = time.monotonic() + limit_s
    while not holds():
        assert time.monotonic() < deadline, "it never came to this"
        time.sleep(0.05)


def _processes(word: str) -> list[str]:
    """Command lines of running processes that hold a word."""
    found = []
    for entry in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            line = entry.read_text(encoding="utf-8", errors="replace")
        except OSError:
            continue
        if word in line:
            found.append(line)
    return found
