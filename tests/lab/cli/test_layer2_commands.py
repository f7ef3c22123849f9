"""The commands of Layer 2's workshop: evaluate, fit, train, dataset, inspect."""

from __future__ import annotations

import json
import shutil
import sys
from pathlib import Path

import pytest

from aegis_ot.llm.vlm import LENSES
from tests.cli.commands import Command
from tests.llm.wire_server import Answer, WireServer, openai_completion


@pytest.fixture(scope="module")
def drawn(tmp_path_factory) -> Path:
    from aegis_ot_lab.drawing import write_dataset

    return write_dataset(tmp_path_factory.mktemp("drawn") / "set", 3, 1, "p300", size=(320, 240))


def test_evaluate_writes_the_five_figures_at_the_top(aegis: Command, drawn: Path) -> None:
    result = aegis("evaluate", "layer2", drawn, "--scorer", "pca", "--json", "o.json")
    assert result.code == 0
    assert "synthetic frames" in result.out
    assert "Registering cameras" in result.err, "the set has positions; progress goes to stderr"
    told = json.loads(Path("o.json").read_text(encoding="utf-8"))
    for name in ("average_precision", "auroc", "f1", "precision", "recall"):
        assert set(told[name]) == {"value", "low", "high"}
    assert told["data"] == "synthetic"
    assert told["seeds"] == {"bootstrap": 0}
    assert {"flagged_normals", "per_failure_type", "per_reagent", "per_severity",
            "routed_fraction", "dataset", "seconds"} <= set(told)  # fmt: skip


def test_several_scorers_and_the_cascade(aegis: Command, drawn: Path) -> None:
    result = aegis(
        "evaluate", "layer2", drawn, "--scorer", "pca,isolation-forest", "--scorer", "mahalanobis",
        "--protocol", "cascade", "--boxes", "true", "--json", "o.json",
    )  # fmt: skip
    assert result.code == 0
    told = json.loads(Path("o.json").read_text(encoding="utf-8"))
    assert list(told["scorers"]) == ["pca", "isolation_forest", "mahalanobis"]
    assert told["scorer"] == "pca"
    assert sum(told["settled"].values()) == told["wells"]["scored"] + told["no_tip"]["total"]


def test_a_model_looks_at_what_the_volumes_leave_open_and_can_be_replayed(
    aegis: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from aegis_ot_lab.drawing import write_dataset

    # A set of which every well that passes is near the band or drawn for a spot check.
    drawn = write_dataset(tmp_path / "set", 3, 2, "p300", size=(320, 240))
    monkeypatch.setenv("AEGIS_OT_LLM_API_KEY", "sk-test")
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    said = {"verdict": "fail", "confidence": "high", "failure": "air_bubble", "reason": "A gap."}
    command = (
        "evaluate",
        "layer2",
        drawn,
        "--scorer",
        "pca",
        "--boxes",
        "true",
        "--json",
        "o.json",
    )

    def settled(*options: str) -> dict[str, int]:
        result = aegis(*command, "--protocol", "cascade", *options)
        assert result.code == 0, result.err
        return json.loads(Path("o.json").read_text(encoding="utf-8"))["settled"]

    alone = settled()
    with WireServer() as server:
        server.answers = [Answer(body=openai_completion(json.dumps(dict.fromkeys(LENSES, said))))]
        asked = settled("--model", f"openai:m@{server.url}/v1", "--record", "kept")
        # First wells and a share of those that passed are looked at too.
        assert len(server.seen) > alone["operator_undecided"] > 0
    assert "silent_pass" not in asked, "wells that the model doubts calibrate nothing"
    assert settled("--model", "replay:kept") == asked
    wrong = aegis(*command, "--model", "replay:kept")
    assert wrong.code == 2
    assert "--protocol cascade" in wrong.err


def test_a_model_without_an_answer_is_told_and_exported_questions_are_counted(
    aegis: Command, drawn: Path
) -> None:
    command = (
        "evaluate", "layer2", drawn, "--scorer", "pca", "--boxes", "true", "--json", "o.json",
        "--protocol", "cascade",
    )  # fmt: skip
    Path("empty").mkdir()
    silent = aegis(*command, "--model", "replay:empty")
    assert silent.code == 2
    told = json.loads(Path("o.json").read_text(encoding="utf-8"))["model"]
    assert told["asked"] > told["answered"] == 0
    assert f"{told['asked']} of {told['asked']} questions to the model got no answer" in silent.out
    assert "not_recorded" in silent.out
    exported = aegis(*command, "--model", "export:q.jsonl")
    assert exported.code == 0
    lines = Path("q.jsonl").read_text(encoding="utf-8").count("\n")
    assert f"{lines} questions in q.jsonl; the figures above are without a model" in exported.out
    unwritable = aegis(*command, "--model", f"export:{drawn / 'meta.json' / 'q.jsonl'}")
    assert unwritable.code == 2
    assert "cannot be read" in unwritable.err


def _edited(drawn: Path, to: Path, keep) -> Path:
    shutil.copytree(drawn, to)
    lines = (to / "manifest.csv").read_text(encoding="utf-8").splitlines()
    head, rows = lines[0], [row for row in lines[1:] if keep(row.split(","))]
    (to / "manifest.csv").write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")
    return to


def test_without_failures_auroc_is_null_and_said(
    aegis: Command, drawn: Path, tmp_path: Path
) -> None:
    folder = _edited(drawn, tmp_path / "normals", lambda row: row[5] == "normal")
    result = aegis("evaluate", "layer2", folder, "--scorer", "pca", "--json", "o.json")
    assert result.code == 0
    assert "no failures" in result.out
    told = json.loads(Path("o.json").read_text(encoding="utf-8"))
    assert told["auroc"] == {"value": None, "low": None, "high": None}


def test_bad_sets_are_told_plainly(aegis: Command, drawn: Path, tmp_path: Path) -> None:
    one = _edited(drawn, tmp_path / "sets" / "one", lambda row: row[1] == "plate00")
    lacking = _edited(
        drawn, tmp_path / "sets" / "lacking", lambda row: row[1] != "plate01" or row[5] != "normal"
    )
    for folder, words in (
        (tmp_path / "none", "no such folder"),
        (tmp_path / "sets", "but holds some: lacking, one"),
        (one, "at least two plates"),
        (lacking, "no calibration well"),
    ):
        result = aegis("evaluate", "layer2", folder, "--scorer", "pca")
        assert result.code == 2
        assert words in result.err
        assert "Traceback" not in result.err


def test_fit_writes_a_model_that_can_be_verified(aegis: Command, drawn: Path) -> None:
    assert aegis("fit", drawn, "--out", "lab.model", "--scorer", "pca").code == 0
    shown = aegis("world-model", "lab.model")
    assert shown.code == 0
    assert "set (synthetic): 5 normal wells" in shown.out
    assert "Few: 5 normal wells" in shown.out
    assert "What it would catch is not known" in shown.out
    Path("lab.model").write_bytes(Path("lab.model").read_bytes()[:-40])
    broken = aegis("world-model", "lab.model")
    assert broken.code == 2
    assert "damaged" in broken.err
    refused = aegis("sidecar", "--camera", "pattern", "--port", "0", "--world-model", "lab.model")
    assert refused.code == 2
    assert "damaged" in refused.err


def test_training_names_the_extra_where_pytorch_is_missing(
    aegis: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "torch", None)
    monkeypatch.delitem(sys.modules, "aegis_ot_lab.training.detector", raising=False)
    monkeypatch.delitem(sys.modules, "aegis_ot_lab.training.network", raising=False)
    result = aegis("train", "detector", "--out", "d")
    assert result.code == 2
    assert "aegis-ot[train]" in result.err


def test_a_drawn_set_says_that_it_is_synthetic(aegis: Command) -> None:
    arguments = ("dataset", "simulate", "s", "--pipette", "p20", "--plates", 1, "--size", "320x240")
    result = aegis(*arguments)
    assert result.code == 0
    assert json.loads(Path("s/meta.json").read_text(encoding="utf-8"))["source"] == "synthetic"
    assert aegis(*arguments).code == 2, "nothing is overwritten"
    assert aegis("dataset", "simulate", "t", "--pipette", "foo").code == 2


def test_inspect_writes_a_page(aegis: Command, drawn: Path) -> None:
    result = aegis("inspect", drawn, "--scorer", "pca", "--most", 2, "--out", "page.html")
    assert result.code == 0
    assert "synthetic frames" in result.out
    assert Path("page.html").read_text(encoding="utf-8").count("<article") == 13


def test_inspect_of_nothing_is_refused(aegis: Command, monkeypatch) -> None:
    monkeypatch.setenv("AEGIS_OT_SIDECAR_DATA", "nowhere")
    result = aegis("inspect", "run-7")
    assert result.code == 2
    assert "run-7" in result.err
    assert not Path("nowhere").exists()
