"""The operator as a gate."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import httpx
import pytest

from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.config import OperatorSettings

from .helpers import Robot, StubAnalyser, StubCamera, until


def decide(robot: Robot, trajectory: int, outcome: str, by: str = "Ada") -> int:
    body = {"outcome": outcome, "by": by}
    return robot.post(f"trajectories/{trajectory}/decision", body).status_code


@pytest.fixture
def judged(robot: Robot) -> Robot:
    for trajectory in range(3):
        robot.cycle(trajectory)
        assert robot.verdict(trajectory)["verdict"] is not None
    return robot


def test_a_fail_can_be_overruled(judged: Robot) -> None:
    assert decide(judged, 1, "pass") == 200
    verdict = judged.verdict(1)["verdict"]
    assert (verdict["outcome"], verdict["gate"], verdict["failure"]) == ("pass", "operator", None)
    assert "Ada decided pass" in verdict["reason"]
    assert "52 µL stayed" in verdict["reason"]
    trajectory = judged.overview()["trajectories"][1]
    assert trajectory["judged"]["outcome"] == "fail"
    assert trajectory["judged"]["measured_ul"] == 52.0


def test_the_last_decision_counts_and_all_are_kept(judged: Robot) -> None:
    assert decide(judged, 2, "pass") == 200
    assert decide(judged, 2, "fail", by="Grace") == 200
    assert judged.verdict(2)["verdict"]["outcome"] == "fail"
    decisions = judged.overview()["trajectories"][2]["decisions"]
    assert [d["by"] for d in decisions] == ["Ada", "Grace"]


def test_a_well_that_passed_is_corrected_and_what_was_never_judged_is_not(judged: Robot) -> None:
    assert decide(judged, 0, "fail") == 200
    assert judged.verdict(0)["verdict"]["outcome"] == "fail"
    assert decide(judged, 9, "pass") == 404
    assert decide(judged, 1, "undecided") == 422
    assert decide(judged, 1, "pass", by="") == 422


def test_a_person_tells_a_paused_robot_what_to_do(judged: Robot) -> None:
    assert judged.http.get("/v1/runs/run-1/trajectories/1/action").json() == {"action": None}
    told = {"action": "stop", "by": "Ada", "note": "leak"}
    assert judged.post("trajectories/1/action", told).status_code == 200
    assert judged.http.get("/v1/runs/run-1/trajectories/1/action").json()["action"] == told
    (kept,) = judged.overview()["actions"]
    assert (kept["trajectory"], kept["by"], kept["note"]) == (1, "Ada", "leak")
    assert judged.post("trajectories/1/action", {"action": "dance", "by": "Ada"}).status_code == 422


def test_a_decision_outlives_a_restart(config: SidecarConfig) -> None:
    with (
        running_sidecar(config, StubCamera(), StubAnalyser(unsure=[0])) as url,
        Robot(url) as robot,
    ):
        robot.register()
        robot.cycle(0)
        robot.verdict(0)
        assert decide(robot, 0, "fail") == 200
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
        assert robot.verdict(0)["verdict"]["outcome"] == "fail"


@pytest.fixture(params=[600.0])
def patient(config: SidecarConfig, request: pytest.FixtureRequest) -> Iterator[Robot]:
    """A sidecar that holds undecided verdicts back for the operator, for so many s."""
    patient = config.model_copy(update={"operator": OperatorSettings(timeout_s=request.param)})
    analyser = StubAnalyser(fails=[1], unsure=[0])
    with running_sidecar(patient, StubCamera(), analyser) as url, Robot(url) as robot:
        robot.register()
        yield robot


def test_an_undecided_verdict_waits_for_the_operator(patient: Robot) -> None:
    patient.cycle(0)
    awaiting = {"verdict": None, "awaiting": "operator"}
    until(lambda: patient.verdict(0, wait=0.2) == awaiting)
    assert patient.overview()["trajectories"][0]["awaiting"] == "operator"
    timer = threading.Timer(0.1, decide, (patient, 0, "pass"))
    timer.start()
    verdict = patient.verdict(0)["verdict"]
    timer.join()
    assert (verdict["outcome"], verdict["gate"]) == ("pass", "operator")


@pytest.mark.parametrize("patient", [0.3], indirect=True)
def test_an_operator_who_does_not_come_leaves_it_undecided(patient: Robot) -> None:
    patient.cycle(0)
    verdict = patient.verdict(0)["verdict"]
    assert verdict["outcome"] == "undecided"


def test_a_fail_is_never_held_back(patient: Robot) -> None:
    patient.cycle(0)
    patient.cycle(1)
    assert patient.verdict(1)["verdict"]["outcome"] == "fail"


def test_the_analyser_hears_of_a_well_that_the_operator_found_right(
    judged: Robot, analyser: StubAnalyser
) -> None:
    assert decide(judged, 1, "pass") == 200  # a fail that is overruled teaches nothing
    assert decide(judged, 2, "pass") == 200
    judged.cycle(3)
    assert judged.verdict(3)["verdict"] is not None
    assert analyser.confirmed == [2]


@pytest.mark.parametrize(("policy", "confirmed"), [("pause", [2]), ("continue", [])])
def test_a_run_that_was_paused_for_a_look_and_goes_on_was_looked_at(
    judged: Robot, analyser: StubAnalyser, policy: str, confirmed: list[int]
) -> None:
    for trajectory in (1, 2):
        hold = {"number": trajectory, "trajectory": trajectory, "seconds": 0.1,
                "resolution": "verdict", "policy": policy}  # fmt: skip
        assert judged.post("hold", hold).status_code == 200
    assert analyser.confirmed == []
    judged.cycle(3)
    assert judged.verdict(3)["verdict"] is not None
    assert analyser.confirmed == confirmed


def page(robot: Robot, path: str, answer: str) -> httpx.Response:
    return robot.http.post(f"/runs/run-1/{path}", data={"by": "Ada", "answer": answer})


def test_stop_on_a_wells_form_is_heard_by_a_robot_that_moves(judged: Robot) -> None:
    assert page(judged, "wells/1", "stop").status_code == 303
    order = judged.send(12).json()["order"]
    assert (order["action"], order["by"]) == ("stop", "Ada")
    assert judged.verdict(2)["order"] == order
    assert "Ada told the robot to end the run" in judged.http.get("/runs/run-1").text


def test_stop_is_heard_at_whichever_pause_the_robot_stands(judged: Robot) -> None:
    assert page(judged, "order", "stop").status_code == 303
    for number in (0, 2):
        told = judged.http.get(f"/v1/runs/run-1/trajectories/{number}/action?within=0").json()
        assert told["action"] == {"action": "stop", "by": "Ada", "note": ""}


def test_nothing_that_is_told_later_takes_a_stop_back(judged: Robot) -> None:
    page(judged, "wells/1", "stop")
    for path, answer in (("wells/1", "resume"), ("order", "pause"), ("wells/2", "pass resume")):
        refused = page(judged, path, answer)
        assert refused.status_code == 409
        assert "Ada told the robot to end this run, and that stands." in refused.text
    assert page(judged, "order", "stop").status_code == 303
    hold = {"number": 1, "trajectory": 1, "seconds": 0, "resolution": "operator", "policy": "pause"}
    assert judged.post("hold", hold).status_code == 200
    assert judged.send(12).json()["order"]["action"] == "stop"


def test_a_stop_outlives_a_restart(config: SidecarConfig) -> None:
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
        robot.register()
        robot.cycle(0)
        page(robot, "wells/0", "stop")
        hold = {"trajectory": 0, "seconds": 0, "resolution": "verdict", "policy": "pause"}
        robot.post("hold", hold)
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url, Robot(url) as robot:
        assert robot.send(4).json()["order"]["action"] == "stop"


@pytest.mark.parametrize("number", [3, 10**7, 10**24, -1])
@pytest.mark.parametrize("answer", ["stop", "resume", "pass"])
def test_a_well_that_does_not_exist_is_refused_in_words(
    judged: Robot, number: int, answer: str
) -> None:
    refused = page(judged, f"wells/{number}", answer)
    assert refused.status_code in (404, 422)
    assert "no delivery" in refused.text or "less than or equal" in refused.text or number < 0
    body = {"action": answer, "by": "Ada"} if answer != "pass" else {"outcome": "pass", "by": "Ada"}
    path = "decision" if answer == "pass" else "action"
    assert judged.post(f"trajectories/{number}/{path}", body).status_code in (404, 422)
    assert judged.overview()["actions"] == []


def test_a_run_that_has_ended_is_told_nothing(judged: Robot) -> None:
    judged.post("finish", {"outcome": "failed"})
    for path, answer in (("wells/1", "stop"), ("order", "pause")):
        refused = page(judged, path, answer)
        assert refused.status_code == 409
        assert "This run has ended (failed)" in refused.text
    assert judged.overview()["actions"] == []
