"""``aegis-ot reproduce`` as its user calls it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aegis_ot_lab.drawing import write_dataset
from tests.cli.commands import Command


def test_one_experiment_is_run_and_taken_up_the_next_time(aegis: Command) -> None:
    result = aegis("reproduce", "--only", "rules", "--out", "out")
    assert result.code == 0, result.err
    assert "rules        done, 0 s" in result.out
    told = json.loads(Path("out/reproduction.json").read_text(encoding="utf-8"))
    states = {one["name"]: one["state"] for one in told["experiments"]}
    assert states.pop("rules") == "done"
    assert set(states.values()) == {"not run"}
    assert "kept from before" in aegis("reproduce", "--only", "rules", "--out", "out").out
    again = aegis("reproduce", "--only", "rules", "--again", "--out", "out")
    assert "kept from before" not in again.out


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--only", "nonsense"), "--only: 'nonsense' is not one of rules, layer1,"),
        (("--data", "nowhere"), "nowhere"),
        (("--model", "replay:nowhere"), "nowhere"),
        (("--record", "kept"), "no model is asked"),
    ],
)
def test_a_bad_option_is_told_before_anything_is_run(
    aegis: Command, options: tuple[str, ...], said: str
) -> None:
    result = aegis("reproduce", *options, "--out", "out")
    assert result.code == 2
    assert said in result.err
    assert "Traceback" not in result.err
    assert not Path("out").exists()


def test_a_set_of_another_pipette_is_told(aegis: Command) -> None:
    write_dataset("p300", 4, 1, "p300", size=(320, 240), normals_per_plate=1)
    result = aegis("reproduce", "--data", "p300", "--out", "out")
    assert result.code == 2
    assert "holds trajectories of p300" in result.err


def test_an_output_folder_that_cannot_be_made_is_told(aegis: Command) -> None:
    Path("file").write_text("")
    result = aegis("reproduce", "--only", "rules", "--out", "file/out")
    assert result.code == 2
    assert "cannot be made" in result.err
