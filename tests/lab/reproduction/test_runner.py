"""What is finished is taken up, what fails is told, and the page holds the paper's whole table."""

from __future__ import annotations

import html
import json
from pathlib import Path

import pytest

from aegis_ot.errors import DatasetError
from aegis_ot_lab.reproduction import (
    EXPERIMENTS,
    Context,
    Experiment,
    ExperimentOutcome,
    ReproductionOptions,
    reproduce,
    reproduction_html,
    reproduction_json,
    runner,
)
from aegis_ot_lab.reproduction.context import source_files
from aegis_ot_lab.reproduction.experiment import NOT_RUN, ExperimentPicture, table
from aegis_ot_lab.reproduction.paper import ROWS

PNG = bytes.fromhex("89504e470d0a1a0a")


class Counting:
    """An experiment that counts how often it is run, and may fail."""

    def __init__(self, name: str, uses: tuple[str, ...] = (), error: Exception | None = None):
        self.runs, self.error = 0, error
        self.experiment = Experiment(name, f"Title of {name}", "SI", ("fleet",), uses, self.run)

    def run(self, context: Context) -> ExperimentOutcome:
        self.runs += 1
        if self.error is not None:
            raise self.error
        picture = context.pictures(self.experiment.name) / "drawn.png"
        picture.write_bytes(PNG)
        return ExperimentOutcome(
            ("simulated: three frames",),
            {"fleet": (f"answer of {self.experiment.name}",)},
            (table("A table", ("a", "b"), [(1, f"{NOT_RUN}: no model")]),),
            (ExperimentPicture(context.picture(picture), "A picture"),),
            ("A note.",),
            {"seed": context.options.seed},
        )


def play(out: Path, *experiments: Counting, only: str = "", **options: object):  # type: ignore[no-untyped-def]
    context = Context(ReproductionOptions(out, **options))  # type: ignore[arg-type]
    told: list[str] = []
    pages: list[str] = []
    entries = reproduce(
        [one.experiment for one in experiments],
        [one.experiment.name for one in experiments if not only or one.experiment.name == only],
        context,
        lambda entry: told.append(f"{entry.experiment.name} {entry.state} {entry.taken_up}"),
        lambda all_: pages.append(reproduction_html(all_, out)),
    )
    return entries, told, pages


def test_a_finished_experiment_is_taken_up_with_all_that_it_showed(tmp_path: Path) -> None:
    one = Counting("one")
    first, _, _ = play(tmp_path, one)
    again, told, pages = play(tmp_path, one)
    assert one.runs == 1
    assert told == ["one done True"]
    assert again[0].outcome == first[0].outcome
    assert again[0].date == first[0].date
    assert "answer of one" in pages[-1]


def test_another_seed_version_or_option_runs_it_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    one, two = Counting("one"), Counting("two", ("replicates",))
    play(tmp_path, one, two)
    play(tmp_path, one, two, replicates=3)
    assert (one.runs, two.runs) == (1, 2), "only what depends on the option"
    entries, _, _ = play(tmp_path, one, two, replicates=3, seed=7)
    assert (one.runs, two.runs) == (2, 3)
    assert entries[0].outcome.figures == {"seed": 7}
    assert entries[1].command == "aegis-ot reproduce --only two --seed 7 --replicates 3 --out OUT"
    monkeypatch.setattr(runner, "version", lambda: "other")
    play(tmp_path, one, seed=7)
    assert one.runs == 3


@pytest.mark.parametrize("damage", ["{", "[]", '{"key": 1}'])
def test_what_was_kept_and_is_damaged_is_run_again(tmp_path: Path, damage: str) -> None:
    one = Counting("one")
    play(tmp_path, one)
    (tmp_path / "experiments" / "one.json").write_text(damage)
    play(tmp_path, one)
    (tmp_path / "pictures" / "one" / "drawn.png").unlink()
    play(tmp_path, one)
    assert one.runs == 3


def test_one_that_fails_is_told_stops_no_other_and_is_tried_again(tmp_path: Path) -> None:
    bad = Counting("bad", error=DatasetError("row 3 is wrong"))
    broken, good = Counting("broken", error=ZeroDivisionError("by zero")), Counting("good")
    entries, told, pages = play(tmp_path, bad, broken, good)
    assert told == ["bad failed False", "broken failed False", "good done False"]
    assert "failed: row 3 is wrong" in html.unescape(pages[-1])
    assert "ZeroDivisionError: by zero (test_runner.py, line" in html.unescape(pages[-1])
    assert entries[0].to_json()["problem"] == "row 3 is wrong"
    bad.error = None
    play(tmp_path, bad, broken, good)
    assert (bad.runs, broken.runs, good.runs) == (2, 2, 1)


def test_the_page_is_written_after_each_experiment(tmp_path: Path) -> None:
    _, _, pages = play(tmp_path, Counting("one"), Counting("two"))
    assert "answer of one" in pages[0]
    assert "answer of two" not in pages[0]


def test_only_what_is_chosen_is_run_and_the_rest_is_shown_as_it_was(tmp_path: Path) -> None:
    one, two, three = Counting("one"), Counting("two"), Counting("three")
    play(tmp_path, one, two, three, only="one")
    entries, _, pages = play(tmp_path, one, two, three, only="two")
    assert [entry.state for entry in entries] == ["done", "done", "not run"]
    assert (one.runs, two.runs, three.runs) == (1, 1, 0)
    assert "not run yet, or left out with --only" in pages[-1]


def test_every_row_of_the_papers_table_has_an_experiment_and_is_on_the_page(
    tmp_path: Path,
) -> None:
    entries = [runner.Entry(experiment) for experiment in EXPERIMENTS]
    page = html.unescape(reproduction_html(entries, tmp_path))
    told = json.loads(json.dumps(reproduction_json(entries)))
    assert len(ROWS) == len({row.key for row in ROWS}) == 22
    for row, value in zip(ROWS, told["rows"], strict=True):
        assert f'id="row-{row.key}"' in page
        assert row.result in page
        assert value["ours"], f"nobody answers {row.key}"
    keys = {row.key for row in ROWS}
    assert all(set(experiment.rows) <= keys for experiment in EXPERIMENTS)


def test_the_page_says_what_each_figure_stands_on(tmp_path: Path) -> None:
    _, _, pages = play(tmp_path, Counting("one"))
    page = html.unescape(pages[-1])
    for shown in (
        "simulated</span>", "three frames", "aegis-ot reproduce --only one --seed 0",
        "A note.", "data:image/png;base64,",
    ):  # fmt: skip
        assert shown in page


def test_a_result_is_kept_for_the_code_of_both_packages() -> None:
    made_by = {path.parent.name + "/" + path.name for path in source_files()}
    assert {"vision/run_analyser_factory.py", "reproduction/live.py", "drawing/plans.py"} <= made_by
