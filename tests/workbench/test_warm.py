"""A rehearsing process that outlives its command: quick, and never with an old verdict."""

from __future__ import annotations

import os
import sys
import tempfile
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from aegis_ot.preflight import Options
from aegis_ot.workbench.files_read import signatures
from aegis_ot.workbench.rehearser import Rehearser, TaskFailed
from aegis_ot.workbench.surroundings import Placed
from aegis_ot.workbench.tasks import CheckTask
from aegis_ot.workbench.verdicts_kept import Kept, KeptVerdicts, key_of
from aegis_ot.workbench.warm_process import WARM
from tests.cli.test_check_command import protocol

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="a fork is not safe elsewhere")


@pytest.fixture
def sockets(monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Where the processes of a test listen. They leave when their socket is gone."""
    monkeypatch.setenv(WARM, "30")
    with tempfile.TemporaryDirectory() as short:  # tmp_path is too long for a socket at times
        monkeypatch.setenv("XDG_RUNTIME_DIR", short)
        folder = Path(short) / f"aegis-ot-{os.getuid()}"
        yield folder
        for place in folder.glob("*"):
            place.unlink()


def task(path: Path, timeout_s: float = 60.0) -> CheckTask:
    script = Placed(path.read_text(encoding="utf-8"), path.name, folder=str(path.parent))
    return CheckTask(script, Options(), (), timeout_s)


def verdict(path: Path) -> str:
    with Rehearser(lasting=True) as rehearser:
        return str(rehearser.perform(task(path)).report.verdict.value)


def test_the_next_command_is_served_by_the_same_process_until_what_it_loaded_changes(
    tmp_path: Path, sockets: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    loaded = tmp_path / "path" / "sitecustomize.py"
    loaded.parent.mkdir()
    loaded.write_text("", encoding="utf-8")
    os.utime(loaded, (1, 1))
    monkeypatch.setenv("PYTHONPATH", str(loaded.parent))
    monkeypatch.syspath_prepend(str(loaded.parent))
    monkeypatch.setenv("PYTHONDONTWRITEBYTECODE", "1")
    path = protocol(tmp_path / "p.py", tips="once")
    assert verdict(path) == "fail"
    (place,) = sockets.glob("*")
    first = place.stat().st_mtime_ns
    assert verdict(path) == "fail"
    protocol(path)
    assert verdict(path) == "pass", "the text is another"
    assert place.stat().st_mtime_ns == first
    loaded.write_text("CHANGED = True\n", encoding="utf-8")
    assert verdict(path) == "pass"
    assert place.stat().st_mtime_ns != first, "another process, with what stands on the disk now"
    with pytest.MonkeyPatch.context() as other:
        other.setenv("OT_API_SOMETHING", "1")
        assert verdict(path) == "pass"
    assert len(list(sockets.glob("*"))) == 2, "another environment has its own"


def test_what_comes_to_lie_beside_a_protocol_makes_no_process_old(
    tmp_path: Path, sockets: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = protocol(tmp_path / "p.py")
    monkeypatch.syspath_prepend(str(tmp_path))  # as `python -m aegis_ot` does from there
    assert verdict(path) == "pass"
    (place,) = sockets.glob("*")
    first = place.stat().st_mtime_ns
    (tmp_path / "notes.txt").write_text("busy", encoding="utf-8")
    assert verdict(path) == "pass"
    assert place.stat().st_mtime_ns == first


def test_a_folder_whose_path_is_too_long_for_a_socket_keeps_nothing_from_being_judged(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(WARM, "30")
    deep = tmp_path / ("deep" * 20)
    deep.mkdir()
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(deep))
    assert verdict(protocol(tmp_path / "p.py")) == "pass"


def test_one_caller_that_is_ended_leaves_the_others_alone(tmp_path: Path, sockets: Path) -> None:
    endless = tmp_path / "endless.py"
    flag = tmp_path / "begun"
    endless.write_text(
        "metadata = {'apiLevel': '2.15'}\n"
        f"def run(protocol):\n    open({str(flag)!r}, 'w').close()\n"
        "    while True:\n        pass\n",
        encoding="utf-8",
    )
    good = protocol(tmp_path / "good.py")
    with Rehearser(lasting=True) as one, Rehearser(lasting=True) as two:
        one.get_ready()
        ended: list[str] = []

        def call() -> None:
            with pytest.raises(TaskFailed) as caught:
                one.perform(task(endless))
            ended.append(caught.value.problem.message)

        caller = threading.Thread(target=call)
        caller.start()
        while not flag.exists():
            assert caller.is_alive()
        one.cancel()
        caller.join(60)
        assert ended
        assert two.perform(task(good)).report.verdict == "pass"
    assert verdict(good) == "pass"


def test_a_file_that_a_kept_verdict_rests_on_undoes_it(tmp_path: Path) -> None:
    file = tmp_path / "labware.json"
    file.write_text("{}", encoding="utf-8")
    missing = tmp_path / "settings.json"
    kept = KeptVerdicts()
    kept.add("key", Kept(b"answer", signatures([str(file), str(missing)])))
    assert kept.find("key") == b"answer"
    assert kept.find("other") is None
    missing.write_text("{}", encoding="utf-8")
    assert kept.find("key") is None, "a file that was looked for is there now"


@pytest.mark.parametrize(
    ("line", "is_kept"),
    [
        ("import math", True),
        ("from opentrons import protocol_api, types", True),
        ("import random", False),
        ("from time import time", False),
        ("import os", False),
        ("import numpy as np", False),
        ("from opentrons import config", False),
        ("volumes = open('volumes.csv').read()", False),
        ("from . import helper", False),
        ("import dataclasses; now = dataclasses.sys.modules['time'].time()", False),
    ],
)
def test_only_what_depends_on_its_text_alone_is_not_rehearsed_again(
    tmp_path: Path, line: str, is_kept: bool
) -> None:
    path = protocol(tmp_path / "p.py", top=line)
    assert bool(key_of(task(path))) == is_kept
    if is_kept:
        assert key_of(task(path)) == key_of(task(path))
        assert key_of(task(path)) != key_of(task(path, timeout_s=61.0))


def test_a_protocol_that_looks_elsewhere_is_rehearsed_each_time(
    tmp_path: Path, sockets: Path
) -> None:
    """Its labware is given by a CSV file, a runtime parameter: the text stays the same."""
    path = tmp_path / "p.py"
    path.write_text(
        "metadata = {'apiLevel': '2.15'}\n"
        "from pathlib import Path\n"
        "def run(protocol):\n    assert Path('go').read_text() == 'yes'\n",
        encoding="utf-8",
    )
    (tmp_path / "go").write_text("yes", encoding="utf-8")
    assert verdict(path) == "pass"
    (tmp_path / "go").write_text("no", encoding="utf-8")
    with pytest.raises(TaskFailed, match="AssertionError"):
        verdict(path)
