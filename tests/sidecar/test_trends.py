"""Trends over the runs: drift is told of, and what only looks like it is not."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from aegis_ot.adapters.opentrons.instrumentation import LabwareInfo
from aegis_ot.runtime.planner import Planner
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.cameras.codec import encode_jpeg
from aegis_ot.sidecar.store import Captured, Store
from aegis_ot.sidecar.trends import Trend, TrendPoint, _drifts, trends_of
from aegis_ot.sidecar.wire import Decision, Finish, HoldReport, RunStart
from aegis_ot.vocabulary import Outcome, Route, Verdict
from tests.cli.commands import Command
from tests.cli.conftest import aegis  # noqa: F401

from .browser import chromium
from .helpers import StubAnalyser, StubCamera, make_keyframe
from .test_page import in_browser

_CHECKED = np.kron(np.indices((12, 16)).sum(0) % 2, np.ones((4, 4)))[..., None].repeat(3, 2)
SHARP = (_CHECKED * 255).astype(np.uint8)


def add_run(
    store: Store,
    run: str,
    failed: int = 0,
    left: float = 0.5,
    blur: bool = False,
    held: float = 0.2,
    **about: Any,
) -> None:
    store.register(RunStart.model_validate({"run": run, "robot_name": "Ada", **about}))
    jpeg = encode_jpeg(cv2.GaussianBlur(SHARP, (9, 9), 0) if blur else SHARP)
    for trajectory in range(8):
        keyframe = make_keyframe(run, 4 * trajectory + 3, reagent="dye")
        store.add_keyframe(Captured(keyframe, 0.01, time.time()), jpeg)
        outcome = Outcome.FAIL if trajectory < failed else Outcome.PASS
        route = Route.SILENT_PASS
        store.add_verdict(Verdict(run, trajectory, outcome, route, left_ul=left), {"boxes": {}})
        hold = HoldReport(trajectory=trajectory, seconds=held, resolution="verdict")
        store.add_hold(run, hold)
    store.finish(run, Finish(outcome="succeeded"))


def trend(store: Store) -> Trend:
    (found,) = trends_of(store)
    return found


def history(store: Store) -> None:
    for number in range(6):
        add_run(store, f"r{number}", failed=number % 2, left=0.5 + 0.1 * (number % 3))


def test_a_robot_that_goes_on_as_before_is_not_told_of(tmp_path: Path) -> None:
    store = Store(tmp_path)
    history(store)
    found = trend(store)
    assert (found.group.robot, found.group.pipette, found.group.liquid) == (
        "Ada",
        "p1000_single_gen2",
        "dye",
    )
    assert [point.failed for point in found.points] == [0, 1, 0, 1, 0, 1]
    assert found.points[0].left_percent == 0.5
    assert found.drifts == ()


@pytest.mark.parametrize(("failed", "told"), [(12, False), (60, True)])
def test_a_run_over_many_plates_is_judged_too(failed: int, told: bool) -> None:
    usual = [TrendPoint(f"r{n}", n, 1152, 12, 0, 0.2, None, None) for n in range(4)]
    last = TrendPoint("last", 5.0, 1152, failed, 0, 0.2, None, None)
    assert bool(_drifts([*usual, last])) == told


def test_each_drift_is_told_of(tmp_path: Path) -> None:
    for name, change, said in (
        ("failed", {"failed": 5}, "5 of 8 wells failed, before 3 of 48"),
        ("left", {"left": 4.0}, "4.0 % stays in the tip"),
        ("soft", {"blur": True}, "The camera is softer"),
        ("slow", {"held": 6.0}, "waits 6.0 s per well, before 0.2 s"),
    ):
        store = Store(tmp_path / name)
        history(store)
        add_run(store, "last", **change)  # type: ignore[arg-type]
        (drift,) = trend(store).drifts
        assert said in drift
        store.close()


def test_few_runs_tell_nothing_and_a_person_has_the_last_word(tmp_path: Path) -> None:
    store = Store(tmp_path)
    add_run(store, "a")
    add_run(store, "b", failed=8)
    assert trend(store).drifts == ()
    for trajectory in range(8):
        store.add_decision("b", trajectory, Decision(outcome=Outcome.PASS, by="Ada"))
    assert trend(store).points[-1].failed == 0


def test_lots_robots_and_simulated_runs_stand_by_themselves(tmp_path: Path) -> None:
    store = Store(tmp_path)
    add_run(store, "a", racks=[{"slot": "1", "label": "tips lot 7"}])
    add_run(store, "b", racks=[{"slot": "2", "label": "tips lot 8"}])
    add_run(store, "c", simulated=True)
    add_run(store, "d", robot_name="Bea")
    groups = [(one.group.robot, one.group.lot) for one in trends_of(store)]
    assert groups == [("Ada", ""), ("Ada", "tips lot 7"), ("Ada (simulated)", ""), ("Bea", "")]
    rack = LabwareInfo("k", "tips", "Tips", "tips lot 7", "1", True, False)
    assert Planner().about({"k": rack})["racks"] == [{"slot": "1", "label": "tips lot 7"}]


def test_damaged_rows_and_missing_frames_are_left_out(tmp_path: Path) -> None:
    store = Store(tmp_path)
    add_run(store, "a")
    store._write("UPDATE verdicts SET verdict = '{' WHERE trajectory = 1", ())
    store._write("UPDATE keyframes SET keyframe = x'ff00' WHERE trajectory = 2", ())
    for path in store.files_of("a").values():
        path.unlink()
    (point,) = trend(store).points
    assert (point.wells, point.sharpness) == (6, None)


def test_the_command(aegis: Command, tmp_path: Path) -> None:  # noqa: F811
    Store(tmp_path / "empty").close()
    assert "holds no run yet" in aegis("runs", "trends", "--data", tmp_path / "empty").err
    store = Store(tmp_path / "data")
    history(store)
    add_run(store, "last", failed=5)
    store.close()
    said = aegis("runs", "trends", "--data", tmp_path / "data")
    assert said.code == 0, said.err
    assert "CHANGED: 5 of 8 wells failed" in said.out
    told = json.loads(aegis("runs", "trends", "--json", "--data", tmp_path / "data").out)
    assert told[0]["group"]["liquid"] == "dye"


@in_browser
def test_the_page(
    config: SidecarConfig, camera: StubCamera, analyser: StubAnalyser, tmp_path: Path
) -> None:
    with running_sidecar(config, camera, analyser) as url, chromium() as tab:
        tab.open(f"{url}/trends")
        tab.until("document.querySelector('main p + p').textContent === 'No well was judged yet.'")
        store = Store(config.data)
        history(store)
        add_run(store, "last", failed=5, robot_name="<img src=x>")
        add_run(store, "soft", blur=True)
        store.close()
        tab.open(f"{url}/")
        tab.until("document.querySelector('nav a[href=\"/trends\"]')")
        tab.open(f"{url}/trends")
        tab.until("document.querySelectorAll('svg.trend polyline').length >= 8")
        assert "softer" in tab.run("document.querySelector('main').textContent")
        assert tab.run("document.querySelectorAll('main img').length") == 0
        assert tab.run("document.documentElement.scrollWidth <= innerWidth")
        assert tab.errors == []
        tab.screenshot(tmp_path / "trends.png")
