"""``aegis-ot qualify``: what it writes, and what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aegis_ot.qualification.certificate import check_certificate
from aegis_ot.qualification.opening import open_plan
from aegis_ot.qualification.plan import plan_in
from aegis_ot.qualification.protocol import protocol_text
from aegis_ot.qualification.running import run_simulated
from aegis_ot.sidecar.store.opening import open_store

from ..qualification.test_opening import plan_of, run_of
from ..sidecar.helpers import StubAnalyser, StubRun
from .commands import Command


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ((), "Say how: one of --robot"),
        (
            ("--simulated", "--sidecar", "http://x:1", "--pipette", "p300_single_gen2:left"),
            "has a sidecar of its own",
        ),
        (("--simulated", "--write", "x.py"), "Say how: one of --robot"),
        (("--simulated", "--pipette", "right"), "p300_single_gen2:right"),
        (("--of", "missing.py"), "Cannot read the protocol missing.py"),
        (("--export", "x.zip", "--out", "nowhere", "--licence", "CC0"), "there is no such folder"),
    ],
)
def test_what_cannot_be_done_is_said(aegis: Command, given: tuple[str, ...], said: str) -> None:
    answer = aegis("qualify", *given)
    assert answer.code == 2
    assert said in answer.err


def test_a_protocol_for_the_app_is_written(aegis: Command, tmp_path: Path) -> None:
    file = tmp_path / "qualification.py"
    asked = ("--pipette", "p20_single_gen2:left", "--liquid", "dye", "--seed", "4")
    answer = aegis("qualify", "--write", file, *asked)
    assert answer.code == 0
    assert "48 deliveries of 12 µL, 24 of them faults" in answer.out
    text = file.read_text(encoding="utf-8")
    assert "token" not in text
    assert plan_in(text).seed == 4


def test_a_simulated_run_is_opened_only_if_it_is_named(aegis: Command, tmp_path: Path) -> None:
    plan = plan_of()
    file = tmp_path / "q.py"
    file.write_text(protocol_text(plan), encoding="utf-8")
    data = tmp_path / "data"
    run_of(plan, data).close()
    done = aegis("qualify", "--of", file, "--data", data, "--out", tmp_path / "out")
    assert done.code == 2
    assert "but a simulated one (--run q opens it)" in done.err
    file.write_text(protocol_text(plan_of(seed=2)), encoding="utf-8")
    done = aegis("qualify", "--of", file, "--data", data, "--run", "q", "--out", tmp_path / "out")
    assert done.code == 2
    assert "Run q is no run of this plan" in done.err


def test_the_rest_is_told_by_the_file_that_was_run(
    aegis: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(StubRun, "observe", lambda *_: None)  # frames of any size
    plan, file, data = plan_of(), tmp_path / "q.py", tmp_path / "data"
    file.write_text(protocol_text(plan), encoding="utf-8")
    run = run_simulated(plan, data, analyser=StubAnalyser([2]))
    assert [each.outcome for each in open_plan(open_store(data), run, plan)[0]][2] == "fail"
    told = aegis("rest", run, file, "--data", data)
    assert "2 done, 0 open, 1 to look at" in told.out
    assert "Note:" not in told.out
    refused = aegis("rest", run, file, "--data", data, "--write", tmp_path / "rest.py")
    assert (refused.code, "run() does what @planted makes of it" in refused.err) == (1, True)
    again = aegis("rest", run, data / "signing.key", "--data", data)
    assert (again.code, "signing.key" in again.err) == (2, True)


def test_a_file_that_a_run_may_need_is_not_written_over(aegis: Command, tmp_path: Path) -> None:
    asked = ("qualify", "--write", tmp_path / "q.py", "--pipette", "p300_single_gen2:left")
    wrong = aegis(*asked, "--tips", "nonsense")
    assert (wrong.code, 'Labware "nonsense" not found' in wrong.err) == (2, True)
    assert aegis(*asked).code == 0
    again = aegis(*asked)
    assert (again.code, "is there already" in again.err) == (2, True)


def test_what_is_no_certificate_is_refused_before_the_run(aegis: Command, tmp_path: Path) -> None:
    camera = {"sharpness": 0.2, "light": 90.0, "places": {}, "size": [960, 540]}
    told = {"format": "aegis-ot qualification", "version": 2, "camera": camera}
    told |= dict.fromkeys(("run", "began", "robot", "pipette", "mount", "tips"), "x")
    check_certificate(told)  # of an earlier version, whose intervals were of one run
    check_certificate(told | {"version": 3})
    file = tmp_path / "certificate.json"
    for wrong in ([], {}, told | {"version": 1}, told | {"version": 4},
                  told | {"camera": camera | {"light": "x"}},
                  told | {"camera": camera | {"places": 3}}, told | {"camera": None}):  # fmt: skip
        file.write_text(json.dumps(wrong), encoding="utf-8")
        answer = aegis("qualify", "--simulated", "--pipette", "p300_single_gen2:left", "--previous",
                       file, "--out", tmp_path / "out")  # fmt: skip
        assert (answer.code, "is no certificate of this version" in answer.err) == (2, True)
    assert not (tmp_path / "out").exists()
