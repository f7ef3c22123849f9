"""``aegis-ot runs`` and ``aegis-ot doctor``."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aegis_ot.sidecar.store import Store
from tests.sidecar.test_store import fill

from .commands import Command


@pytest.fixture
def data(tmp_path: Path) -> Path:
    folder = tmp_path / "data"
    store = Store(folder)
    fill(store, "pcr", 40, frames=4)
    fill(store, "dilution", None)
    store.begin_incident("dilution", "camera", "the cable is out")
    store.close()
    return folder


def test_runs_are_listed_and_searched(aegis: Command, data: Path) -> None:
    listed = aegis("runs", "list", "--data", data)
    assert listed.code == 0
    assert "pcr.py" in listed.out
    assert "succeeded" in listed.out
    assert "running" in listed.out
    rows = json.loads(aegis("runs", "list", "pcr", "--json", "--data", data).out)
    assert [row["run"] for row in rows] == ["pcr"]
    assert "no run is like that" in aegis("runs", "list", "zebra", "--data", data).out


def test_a_run_is_shown_and_its_report_written(aegis: Command, data: Path, tmp_path: Path) -> None:
    page, account = tmp_path / "r.html", tmp_path / "r.json"
    shown = aegis("runs", "show", "dilution", "--data", data, "--html", page, "--json", account)
    assert shown.code == 0
    assert "the cable is out" in shown.out
    assert "dilution.py" in page.read_text(encoding="utf-8")
    assert json.loads(account.read_text(encoding="utf-8"))["run"] == "dilution"
    wrong = aegis("runs", "show", "zebra", "--data", data)
    assert wrong.code == 2
    assert "holds no run 'zebra'" in wrong.err
    assert aegis("runs", "list", "--data", tmp_path / "nowhere").code == 2


def test_names_neither_begin_a_line_of_their_own_nor_steer_the_terminal(
    aegis: Command, data: Path
) -> None:
    """An older sidecar kept what robots told as it came."""
    evil = "[/b]a\n::error::owned\r\x1b[2J.py"
    store = Store(data)
    told = (json.dumps({"protocol": evil, "robot_name": evil}),)
    store._write("UPDATE runs SET start = json_patch(start, ?)", told)
    store.add_incident("dilution", "link", evil, 1.0, 2.0)
    store.close()
    for arguments in (("list",), ("show", "dilution")):
        said = aegis("runs", *arguments, "--data", data)
        assert said.code == 0, said.err
        assert "owned" in said.out
        assert "\x1b[2J" not in said.out
        assert not any(line.lstrip().startswith("::error") for line in said.out.splitlines())


def test_prune_says_what_it_would_do_and_then_does_it(aegis: Command, data: Path) -> None:
    said = aegis("runs", "prune", "--days", 30, "--data", data)
    assert "1 run" in said.out
    assert "add --yes" in said.out
    assert len(Store(data).runs()) == 2
    assert aegis("runs", "prune", "--days", 30, "--yes", "--data", data).code == 0
    assert [row["run"] for row in Store(data).runs()] == ["dilution"]
    assert "Say what to remove" in aegis("runs", "prune", "--data", data).err


def test_prune_leaves_a_sidecar_at_work_alone(aegis: Command, data: Path) -> None:
    at_work = Store(data, alone=True)
    refused = aegis("runs", "prune", "--days", 30, "--yes", "--data", data)
    assert refused.code == 2
    assert "Another sidecar" in refused.err
    at_work.close()


def test_the_doctor_changes_nothing(aegis: Command, tmp_path: Path) -> None:
    said = aegis("doctor", "--camera", "folder:/nowhere", "--data", tmp_path / "d", "--port", 1,
                 "--host", "0.0.0.0")  # fmt: skip
    assert "token: set, or made at first start" in said.out
    assert not (tmp_path / "d").exists()


def test_the_doctor_says_what_is_wrong_and_what_to_do(aegis: Command, tmp_path: Path) -> None:
    said = aegis("doctor", "--camera", "folder:/nowhere", "--data", tmp_path / "d", "--port", 1,
                 "--robot", "http://127.0.0.1:9")  # fmt: skip
    assert said.code == 2
    assert "camera: " in said.out
    assert "Name another camera" in said.out
    assert "does not answer" in said.out
