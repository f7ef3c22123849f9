"""The lineage of wells: what was meant and what happened, as files that others read."""

from __future__ import annotations

import csv
import hashlib
import json
import time
from pathlib import Path
from typing import Any

import pytest

from aegis_ot.sidecar.lineage import lineage_document, write_lineage
from aegis_ot.sidecar.store import Captured, Store
from aegis_ot.sidecar.wire import Decision, Finish, RunStart
from aegis_ot.vocabulary import (
    ChannelOutcome,
    ChannelVerdict,
    FailureType,
    Gate,
    Outcome,
    Route,
    Verdict,
    WellRef,
    csv_cell,
)
from tests.cli.commands import Command
from tests.cli.conftest import aegis  # noqa: F401

from .helpers import make_jpeg, make_keyframe

PLATE = {"labware": "p", "label": "plate", "slot": "4", "rows": 8, "columns": 12}
EVIL = '=HYPERLINK("http://evil")'


def deliver(
    store: Store, number: int, verdict: Verdict, evidence: Any = None, **changes: Any
) -> None:
    for moment in range(4):
        keyframe = make_keyframe("r", 4 * number + moment, **changes)
        store.add_keyframe(Captured(keyframe, 0.01, time.time()), make_jpeg(number))
    store.add_verdict(verdict, evidence or {})


@pytest.fixture
def store(tmp_path: Path) -> Store:
    store = Store(tmp_path / "data")
    planned = [{"labware": "p", "wells": [well]} for well in ("B1", "A2", "A1", "C12")]
    start = {"run": "r", "protocol": "p.py", "robot_name": EVIL, "plates": [PLATE],
             "planned": planned, "planned_wells": 4}  # fmt: skip
    store.register(RunStart.model_validate(start))
    passed = Verdict("r", 0, Outcome.PASS, Route.SILENT_PASS, left_ul=1.5, left_sigma_ul=0.4)
    deliver(
        store, 0, passed, {"drawn_ul": [101.0, 0.3]}, destinations=(WellRef("p", "B1", EVIL, "4"),)
    )
    failed = Verdict("r", 1, Outcome.FAIL, Route.GREY_ZONE, gate=Gate.VOLUMETRIC,
                     failure=FailureType.PARTIAL_DISPENSE)  # fmt: skip
    deliver(store, 1, failed, destinations=(WellRef("p", "A2", "plate", "4"),))
    unsure = Verdict("r", 2, Outcome.UNDECIDED, Route.GREY_ZONE)
    deliver(store, 2, unsure, destinations=(WellRef("p", "A1", "plate", "4"),))
    store.add_decision("r", 2, Decision(outcome=Outcome.PASS, by="Ada", note="+seen"))
    store.finish("r", Finish(outcome="stopped"))
    return store


def test_each_well_tells_what_was_meant_and_what_happened(store: Store) -> None:
    wells = {well["well"]: well for well in lineage_document(store, "r")["wells"]}
    assert list(wells) == ["A1", "A2", "B1", "C12"]  # as a plate reader goes
    assert [well["read_order"] for well in wells.values()] == [1, 2, 13, 36]
    assert [well["state"] for well in wells.values()] == ["pass", "fail", "pass", "not delivered"]
    assert [well["still_planned"] for well in wells.values()] == [0, 0, 0, 1]
    (first,) = wells["B1"]["deliveries"]
    assert (first["commanded_ul"], first["delivered_ul"], first["delivered_sigma_ul"]) == (
        100,
        99.5,
        0.5,
    )
    assert [one["well"] for one in first["sources"]] == ["A1"]
    (failed,) = wells["A2"]["deliveries"]
    assert (failed["failure"], failed["decided_by"]) == ("partial_dispense", "volumetric")
    assert failed["delivered_ul"] is None
    assert failed["earlier_with_tip"] == [0]
    (decided,) = wells["A1"]["deliveries"]
    assert (decided["decided_by"], decided["decisions"][0]["note"]) == ("Ada", "+seen")
    assert decided["frames"][0]["sha256"] == hashlib.sha256(make_jpeg(2)).hexdigest()


def test_a_row_of_tips_is_one_delivery_for_each_well(tmp_path: Path) -> None:
    store = Store(tmp_path)
    store.register(RunStart(run="r"))
    nozzles = tuple(f"{letter}1" for letter in "ABCDEFGH")
    targets = tuple(WellRef("p", f"{letter}3", "plate", "4") for letter in "ABCDEFGH")
    channels = tuple(
        ChannelVerdict(n, w, ChannelOutcome.FAIL if n == "C1" else ChannelOutcome.PASS)
        for n, w in zip(nozzles, targets, strict=True)
    )
    verdict = Verdict("r", 0, Outcome.FAIL, Route.GREY_ZONE, left_ul=3.0, channels=channels)
    deliver(store, 0, verdict, {"drawn_ul": [5.0, 1.0]}, channels=8, tip="1:A5", nozzles=nozzles,
            targets=targets, destinations=targets)  # fmt: skip
    wells = lineage_document(store, "r")["wells"]
    assert [w["well"] for w in wells if w["state"] == "fail"] == ["C3"]
    assert [w["deliveries"][0]["tip"] for w in wells] == [f"1:{letter}5" for letter in "ABCDEFGH"]
    assert {w["deliveries"][0]["drawn_ul"] for w in wells} == {None}


def test_cells_that_a_spreadsheet_would_run_are_escaped(store: Store, tmp_path: Path) -> None:
    assert write_lineage(store, "r", tmp_path / "out") == 4
    with (tmp_path / "out" / "lineage.csv").open(encoding="utf-8-sig", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 4
    assert rows[2]["label"] == f"'{EVIL}"
    for row in rows:
        assert all(csv_cell(cell) == cell or cell.startswith("'") for cell in row.values())


def test_the_crate_names_every_file_with_its_hash(store: Store, tmp_path: Path) -> None:
    write_lineage(store, "r", tmp_path / "out")
    crate = json.loads((tmp_path / "out" / "ro-crate-metadata.json").read_text(encoding="utf-8"))
    entities = {one["@id"]: one for one in crate["@graph"]}
    assert len(entities) == len(crate["@graph"])
    assert entities["ro-crate-metadata.json"]["about"] == {"@id": "./"}
    files = {path.relative_to(tmp_path / "out").as_posix(): path
             for path in (tmp_path / "out").rglob("*.*") if path.is_file()}  # fmt: skip
    parts = [one["@id"] for one in entities["./"]["hasPart"]]
    assert set(parts) | {"ro-crate-metadata.json"} == set(files)
    for name in parts:
        assert entities[name]["sha256"] == hashlib.sha256(files[name].read_bytes()).hexdigest()
    for entity in crate["@graph"]:  # whatever is pointed at is there
        for value in entity.values():
            for one in value if isinstance(value, list) else [value]:
                if isinstance(one, dict) and not one["@id"].startswith("http"):
                    assert one["@id"] in entities


def test_a_run_in_progress_and_a_damaged_row_are_no_obstacle(store: Store, tmp_path: Path) -> None:
    store._write("UPDATE verdicts SET verdict = '{' WHERE trajectory = 1", ())
    store._write("UPDATE runs SET finished = NULL", ())
    store.frame_path("r", 0).unlink()
    assert write_lineage(store, "r", tmp_path / "out") == 4
    told = json.loads((tmp_path / "out" / "lineage.json").read_text(encoding="utf-8"))
    assert [well["state"] for well in told["wells"]][1] == "undecided"


def test_the_command(aegis: Command, store: Store, tmp_path: Path) -> None:  # noqa: F811
    store.close()
    data = tmp_path / "data"
    done = aegis("runs", "export", tmp_path / "out", "--lineage", "--run", "r", "--data", data)
    assert done.code == 0, done.err
    assert "4 wells of run r" in done.out
    assert aegis("runs", "export", tmp_path / "out", "--lineage", "--data", data).code == 2
    wrong = aegis("runs", "export", tmp_path / "new", "--lineage", "--run", "zebra", "--data", data)
    assert (wrong.code, "holds no run 'zebra'" in wrong.err) == (2, True)
    assert not (tmp_path / "new").exists()
    Store(tmp_path / "empty").close()
    empty = aegis("runs", "export", tmp_path / "new", "--lineage", "--data", tmp_path / "empty")
    assert (empty.code, "holds no run yet" in empty.err) == (2, True)
