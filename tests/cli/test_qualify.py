"""``aegis-ot qualify``: what it writes, and what it refuses."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.qualification.plan import plan_in
from aegis_ot.qualification.protocol import protocol_text

from ..qualification.test_opening import plan_of, run_of
from .commands import Command


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ((), "Say how: one of --robot"),
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
