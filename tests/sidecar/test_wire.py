"""The wire protocol over a real socket."""

from __future__ import annotations

import threading
from urllib.parse import quote

import pytest

from aegis_ot.errors import CameraError
from aegis_ot.sidecar import SidecarConfig, app
from aegis_ot.vocabulary import Keyframe, KeyframeKind, Verdict, from_json, to_json

from .helpers import Robot, StubAnalyser, StubCamera, make_keyframe

HOLD = {"number": 0, "trajectory": 0, "seconds": 0.25, "resolution": "verdict", "policy": None}


def test_a_cycle_is_captured_and_judged(robot: Robot) -> None:
    for sequence in range(4):
        answer = robot.send(sequence).json()
        assert answer["sequence"] == sequence
        assert answer["captured"] is True
        assert 0 <= answer["exposed_after_s"] < 60
    verdict = from_json(Verdict, robot.verdict(0)["verdict"])
    assert (verdict.run, verdict.trajectory, verdict.outcome.value) == ("run-1", 0, "pass")


def test_health_says_what_it_may_and_no_more(url: str) -> None:
    with Robot(url) as robot:
        body = robot.http.get("/v1/health").json()
    assert set(body) == {"name", "version", "wire", "camera"}
    assert (body["name"], body["wire"]) == ("aegis-ot", 1)
    assert body["camera"] == {"kind": "stub", "ok": True, "detail": ""}


def test_a_resent_keyframe_is_answered_from_the_store(robot: Robot, camera: StubCamera) -> None:
    first = robot.send(0).json()
    assert robot.send(0).json() == first
    assert camera.grabbed == [0]
    assert len(robot.overview()["trajectories"][0]["keyframes"]) == 1


def test_the_same_keyframe_twice_at_once_is_captured_once(robot: Robot, camera: StubCamera) -> None:
    camera.gate.clear()
    answers: list[dict[str, object]] = []
    threads = [
        threading.Thread(target=lambda: answers.append(robot.send(0).json())) for _ in range(3)
    ]
    for thread in threads:
        thread.start()
    camera.gate.set()
    for thread in threads:
        thread.join(60)
    assert camera.grabbed == [0]
    assert len(answers) == 3
    assert answers[0] == answers[1] == answers[2]


def test_a_gap_names_the_number_expected(robot: Robot, camera: StubCamera) -> None:
    robot.send(0)
    answer = robot.send(2)
    assert answer.status_code == 409
    assert answer.json()["expected"] == 1
    assert answer.json()["error"]["code"] == "gap"
    assert camera.grabbed == [0]
    assert robot.send(1).status_code == 200


def test_a_number_cannot_be_used_for_another_keyframe(robot: Robot) -> None:
    robot.send(0)
    answer = robot.send(0, kind=KeyframeKind.TRANSIT)
    assert answer.status_code == 409
    assert answer.json()["error"]["code"] == "taken"


def test_an_unknown_run_is_404(url: str) -> None:
    with Robot(url, "never") as robot:
        for answer in (
            robot.send(0),
            robot.http.get("/v1/runs/never/trajectories/0/verdict"),
            robot.http.get("/v1/runs/never"),
            robot.post("hold", HOLD),
            robot.post("finish", {"outcome": "succeeded"}),
        ):
            assert answer.status_code == 404
            assert answer.json()["error"]["code"] == "run_unknown"


def test_registering_twice_is_one_run(robot: Robot) -> None:
    robot.send(0)
    assert robot.register().json() == {"run": "run-1", "wire": 1}
    assert robot.send(1).status_code == 200
    assert [run["keyframes"] for run in robot.http.get("/v1/runs").json()["runs"]] == [2]


@pytest.mark.parametrize(
    "failure", [CameraError("nothing came"), RuntimeError("driver"), OSError("unplugged")]
)
def test_a_dead_camera_uses_no_number_up(
    robot: Robot, camera: StubCamera, failure: Exception
) -> None:
    camera.failure = failure
    answer = robot.send(0)
    assert answer.status_code == 503
    assert answer.json()["error"]["code"] == "camera"
    assert str(failure) in answer.json()["error"]["message"]
    health = robot.http.get("/v1/health").json()["camera"]
    assert not health["ok"]
    assert str(failure) in health["detail"]
    camera.failure = None
    assert robot.send(0).status_code == 200
    assert robot.http.get("/v1/health").json()["camera"]["ok"]


def test_a_frame_exposed_before_the_trigger_is_refused(robot: Robot, camera: StubCamera) -> None:
    camera.age = 0.5
    answer = robot.send(0)
    assert answer.status_code == 503
    assert "old frame" in answer.json()["error"]["message"]


def test_a_verdict_wakes_the_long_poll(
    robot: Robot, analyser: StubAnalyser, monkeypatch: pytest.MonkeyPatch
) -> None:
    analyser.gate.clear()
    robot.cycle(0)
    assert robot.verdict(0, wait=0.05) == {"verdict": None}
    monkeypatch.setattr(app, "MAX_WAIT", 600.0)
    threading.Timer(0.2, analyser.gate.set).start()
    assert robot.verdict(0, wait=600.0)["verdict"]["outcome"] == "pass"


def test_a_wait_is_cut_to_one_second(robot: Robot) -> None:
    assert robot.verdict(7, wait=600)["verdict"] is None


def test_two_runs_at_once_do_not_mix(url: str, analyser: StubAnalyser) -> None:
    outcomes: dict[str, list[str]] = {}

    def work(name: str) -> None:
        with Robot(url, name) as robot:
            robot.register()
            found = []
            for trajectory in range(3):
                robot.cycle(trajectory)
                found.append(robot.verdict(trajectory)["verdict"]["outcome"])
            outcomes[name] = found

    threads = [threading.Thread(target=work, args=(name,)) for name in ("a", "b")]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert outcomes == {name: ["pass", "fail", "undecided"] for name in ("a", "b")}
    for name in ("a", "b"):
        assert [n for run, n in analyser.observed if run == name] == list(range(12))


def test_abandoned_trajectories_are_not_judged(robot: Robot, analyser: StubAnalyser) -> None:
    robot.send(0)
    assert robot.post("trajectories/0/abandon", {"reason": "tip changed"}).json() == {}
    robot.send(1, trajectory=1, kind=KeyframeKind.ASPIRATE)
    assert robot.verdict(0, wait=0.0) == {"verdict": None}
    trajectory = robot.overview()["trajectories"][0]
    assert trajectory["abandoned"] == "tip changed"
    assert trajectory["verdict"] is None


def test_holds_and_the_end_are_kept(robot: Robot) -> None:
    robot.cycle(0)
    assert robot.post("hold", HOLD).json() == {}
    assert robot.post("hold", HOLD).json() == {}
    assert robot.post("finish", {"outcome": "succeeded", "detail": "ok"}).json() == {}
    run = robot.overview()
    (kept,) = run["trajectories"][0]["holds"]
    assert {name: kept[name] for name in HOLD} == HOLD
    assert run["finished"]["outcome"] == "succeeded"
    assert robot.verdict(0)["verdict"]["outcome"] == "pass"


def test_a_pause_of_a_person_and_the_hold_that_follows_it_are_both_kept(robot: Robot) -> None:
    robot.cycle(0)
    pause = {"number": 0, "trajectory": 0, "seconds": 0, "resolution": "operator",
             "policy": "pause"}  # fmt: skip
    hold = {"number": 1, "trajectory": 0, "seconds": 0.3, "resolution": "verdict",
            "policy": "pause"}  # fmt: skip
    over = {"paused_s": 9.0, "answered": "page"}
    for told in (pause, pause | over, hold, hold | over | {"answered": "robot"}):
        assert robot.post("hold", told).json() == {}
    kept = robot.overview()["trajectories"][0]["holds"]
    assert [(one["resolution"], one["answered"]) for one in kept] == [
        ("operator", "page"),
        ("verdict", "robot"),
    ]


def test_frames_are_served_as_they_were_stored(robot: Robot) -> None:
    robot.cycle(0)
    keyframe = robot.overview()["trajectories"][0]["keyframes"][2]
    answer = robot.http.get(keyframe["frame"])
    assert answer.headers["content-type"] == "image/jpeg"
    assert answer.content.startswith(b"\xff\xd8")
    assert robot.http.get("/v1/runs/run-1/frames/99.jpg").status_code == 404


@pytest.mark.parametrize("name", ["a b", "a_b", "ä☃", "..", "x" * 128, "<script>", "a%2Fb"])
def test_odd_run_names_work_and_stay_in_the_folder(
    url: str, config: SidecarConfig, name: str
) -> None:
    with Robot(url) as robot:
        path = "/v1/runs/" + quote(name, safe="").replace(".", "%2E")
        assert robot.http.put(path, json={"run": name}).status_code == 200
        keyframe = to_json(make_keyframe(name, 0))
        assert robot.http.post(f"{path}/keyframes", json=keyframe).status_code == 200
        frame = robot.http.get(path).json()["trajectories"][0]["keyframes"][0]["frame"]
        assert robot.http.get(frame.replace("/../", "/%2E%2E/")).status_code == 200
    assert len(list((config.data / "frames").glob("*/000000.jpg"))) == 1


@pytest.mark.parametrize("name", ["x" * 129, "line\nbreak", " outer", "a/b"])
def test_unusable_run_names_are_refused(url: str, name: str) -> None:
    with Robot(url) as robot:
        answer = robot.http.put("/v1/runs/" + quote(name, safe=""), json={"run": name})
        assert answer.status_code in (404, 422)
        assert answer.json()["error"]["message"]


def test_a_recovery_is_kept_and_its_well_counts_as_put_right(robot: Robot) -> None:
    for trajectory in range(3):  # the second one fails
        robot.cycle(trajectory)
        robot.verdict(trajectory)
    told = {
        "trajectory": 1,
        "attempt": 1,
        "action": "retry",
        "state": "begun",
        "text": "Once more.",
    }
    robot.http.post("/v1/runs/run-1/recovery", json=told).raise_for_status()
    failed = robot.overview()["trajectories"][1]
    assert (failed["verdict"]["outcome"], failed["recovered"]) == ("fail", False)
    robot.http.post(
        "/v1/runs/run-1/recovery", json=told | {"state": "recovered", "by": 2}
    ).raise_for_status()
    overview = robot.overview()
    assert overview["trajectories"][1]["recovered"]
    assert [(one["state"], one["by"]) for one in overview["recoveries"]] == [("recovered", 2)]
    account = robot.http.get("/runs/run-1/report.json").json()
    assert account["counts"]["recovered"] == 1
    for page in ("/runs/run-1", "/runs/run-1/report.html"):
        assert "put right by delivery 2. Once more." in robot.http.get(page).text
    wrong = robot.http.post("/v1/runs/run-1/recovery", json=told | {"action": "hope"})
    assert wrong.status_code == 422


def test_what_the_sensor_found_is_kept_and_robots_and_sidecars_of_other_age_understand(
    robot: Robot,
) -> None:
    for sequence in range(4):
        assert robot.send(sequence, liquid_found=sequence < 2).status_code == 200
    older = to_json(make_keyframe("run-1", 4))
    del older["liquid_found"]
    newer = to_json(make_keyframe("run-1", 5)) | {"a_later_version_tells": True}
    for body in (older, newer):
        assert robot.post("keyframes", body).status_code == 200
    first, second = (one["keyframes"] for one in robot.overview()["trajectories"])
    assert [one["liquid_found"] for one in first] == [True, True, False, False]
    assert [one["liquid_found"] for one in second] == [None, None]
    assert from_json(Keyframe, first[0] | {"more": 1}).liquid_found is True
    assert robot.send(6, liquid_found="yes").status_code == 422


def test_what_the_sensors_of_a_row_found_is_kept_one_word_a_channel(robot: Robot) -> None:
    row = {"channels": 3, "nozzles": ["A1", "B1", "C1"]}
    assert robot.send(0, **row, channels_found=[False, None]).status_code == 422
    assert robot.send(0, **row, channels_found=[False, None, "no"]).status_code == 422
    assert robot.send(0, **row, channels_found=[False, None, False]).status_code == 200
    (kept,) = robot.overview()["trajectories"][0]["keyframes"]
    assert from_json(Keyframe, kept).channels_found == (False, None, False)
