"""``aegis-ot check``, ``evaluate layer1`` and ``llm`` with a model, from end to end."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from aegis_ot.cli.models import backend_of

from ..llm.samples import CONTAMINATED, SILENT, answer, finding
from ..llm.wire_server import (
    Answer,
    WireServer,
    anthropic_error,
    openai_completion,
)
from .commands import Command

KEY = "sk-test-0123456789abcdef"
VIOLATED = finding("PCR-2", ["2:A2", "4:H12"], [12, 15], "The template's tip mixes H12.")
SAID = answer(findings=[VIOLATED], summary="One fault.")


@pytest.fixture
def server() -> Iterator[WireServer]:
    with WireServer() as running:
        yield running


@pytest.fixture(autouse=True)
def _clean(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("AEGIS_OT_MODEL", "AEGIS_OT_MODEL_RECORD", "AEGIS_OT_PRICES", "OPENAI_API_KEY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("ANTHROPIC_API_KEY", KEY)
    monkeypatch.setenv("AEGIS_OT_LLM_API_KEY", KEY)
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")


@pytest.fixture
def silent(tmp_path: Path) -> Path:
    (tmp_path / "silent.py").write_text(SILENT, encoding="utf-8")
    return Path("silent.py")


def script(tmp_path: Path, said: Any, name: str = "said.json") -> str:
    (tmp_path / name).write_text(json.dumps(said), encoding="utf-8")
    return f"scripted:{name}"


def checked(result: Any) -> dict[str, Any]:
    (protocol,) = json.loads(result.out)["protocols"]
    return dict(protocol)


def test_a_models_finding_is_added_recorded_and_replayed(
    aegis: Command, silent: Path, server: WireServer, tmp_path: Path
) -> None:
    server.answers = [Answer(body=openai_completion(json.dumps(SAID)))]
    live = f"openai:some-model@{server.url}/v1"
    first = aegis("check", silent, "--format", "json", "--model", live, "--record", "kept")
    assert first.code == 1
    found = checked(first)
    assert [(f["rule"], f["source"]) for f in found["findings"]] == [("PCR-2", "model")]
    assert found["model"]["state"] == "answered"
    assert found["model"]["tokens"]["cached"] == 3500
    assert KEY in server.seen[0].headers["authorization"]
    kept = "".join(path.read_text() for path in (tmp_path / "kept").rglob("*.json"))
    assert KEY not in kept + first.out + first.err
    again = aegis("check", silent, "--format", "json", "--model", "replay:kept")
    assert again.code == 1
    assert len(server.seen) == 1
    assert checked(again)["findings"] == found["findings"]


def _anthropic(url: str) -> str:
    return f"anthropic:some-model@{url}"


def _openai(url: str) -> str:
    return f"openai:some-model@{url}/v1#timeout=1"


ENDS: list[tuple[str, Callable[[str], str], Answer, str]] = [
    ("key", _anthropic, Answer(401, anthropic_error("authentication_error", KEY)), "unauthorized"),
    ("schema", _openai, Answer(body=openai_completion('{"family": 3}')), "invalid"),
    ("silence", _openai, Answer(hang=True), "timeout"),
]
"""One end of each kind; tests/llm/test_wires.py has them all."""


@pytest.mark.parametrize(("name", "model", "gives", "state"), ENDS, ids=[e[0] for e in ENDS])
def test_no_answer_is_undecided_by_name_with_exit_code_2(
    aegis: Command,
    silent: Path,
    server: WireServer,
    name: str,
    model: Callable[[str], str],
    gives: Answer,
    state: str,
) -> None:
    server.answers = [gives]
    result = aegis("check", silent, "--format", "json", "--model", model(server.url))
    assert result.code == 2
    protocol = checked(result)
    assert protocol["model"]["state"] == state
    reasons = {u["rule"]: u["reason"] for u in protocol["undecided"]}
    assert f"gave no answer ({state})" in reasons["MODEL"]
    assert len(reasons) == 8, "what the checks left open stays open"
    assert KEY not in result.out + result.err


def test_no_model_overrules_a_check(aegis: Command, tmp_path: Path) -> None:
    (tmp_path / "bad.py").write_text(CONTAMINATED, encoding="utf-8")
    without = checked(aegis("check", "bad.py", "--format", "json"))
    whitewash = script(tmp_path, answer(family="generic", summary="Approved."))
    result = aegis("check", "bad.py", "--format", "json", "--model", whitewash)
    assert result.code == 1
    protocol = checked(result)
    assert protocol["verdict"] == "fail"
    assert protocol["findings"] == without["findings"]


def test_the_flag_wins_over_the_environment_and_that_over_the_project(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def chosen(flag: str | None) -> str | None:
        backend = backend_of(flag, None, "openai:by-project", tmp_path)
        return backend and backend.name

    assert chosen(None) == "openai:by-project"
    monkeypatch.setenv("AEGIS_OT_MODEL", "openai:by-environment")
    assert chosen(None) == "openai:by-environment"
    assert chosen("openai:by-flag") == "openai:by-flag"
    assert chosen("none") is None
    monkeypatch.setenv("AEGIS_OT_MODEL", "none")
    assert chosen(None) is None


def test_a_project_names_a_model_and_its_files(
    aegis: Command, silent: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    script(tmp_path, answer(summary="By the project."))
    (tmp_path / "pyproject.toml").write_text('[tool.aegis-ot]\nmodel = "scripted:said.json"\n')
    (tmp_path / "below").mkdir()
    monkeypatch.chdir(tmp_path / "below")
    assert "By the project." in aegis("check", tmp_path / silent).out


@pytest.mark.parametrize(
    "model",
    [
        "anthropic:m@https://elsewhere.example",
        "openai:m@https://elsewhere.example/v1",
        "openai:m#key=ANTHROPIC_API_KEY",
    ],
)
def test_a_projects_file_does_not_say_where_a_key_goes(
    aegis: Command, silent: Path, tmp_path: Path, model: str
) -> None:
    (tmp_path / "pyproject.toml").write_text(f'[tool.aegis-ot]\nmodel = "{model}"\n')
    result = aegis("check", silent)
    assert result.code == 2
    assert "--model" in result.err


def test_half_a_surrogate_pair_ends_no_report(aegis: Command, tmp_path: Path, silent: Path) -> None:
    """In a label of the protocol, or in a model's words: no file and no terminal takes one."""
    text = SILENT.replace(
        '"biorad_96_wellplate_200ul_pcr", 4)', '"biorad_96_wellplate_200ul_pcr", 4, "PCR \\ud800")'
    )
    (tmp_path / "odd.py").write_text(text)
    said = script(tmp_path, SAID | {"summary": "\ud800", "family": "\ud800"})
    result = aegis("check", silent, "odd.py", "--model", said)
    assert (result.code, result.err) == (1, "")
    result = aegis("check", "odd.py", "--format", "json", "--output", "report.json")
    assert result.code == 0
    assert json.loads(Path("report.json").read_text())


def test_recording_needs_a_model(aegis: Command, silent: Path) -> None:
    result = aegis("check", silent, "--record", "kept")
    assert result.code == 2
    assert "--record" in result.err


# -- evaluation


@pytest.fixture
def benchmark(tmp_path: Path) -> Path:
    folder = tmp_path / "set"
    folder.mkdir()
    (folder / "bad.py").write_text(CONTAMINATED, encoding="utf-8")
    (folder / "silent.py").write_text(SILENT, encoding="utf-8")
    labels = [
        {"file": "bad.py", "family": "pcr", "verdict": "fail", "rules": ["PCR-2"]},
        {"file": "silent.py", "family": "pcr", "verdict": "fail", "rules": ["PCR-2"]},
    ]
    (folder / "labels.json").write_text(json.dumps(labels), encoding="utf-8")
    return folder


BLIND = {"family": "pcr", "findings": [VIOLATED], "summary": ""}
EVERY = ("hybrid", "llm-only", "trace-blind")


def test_out_to_a_batch_and_back_for_every_configuration(
    aegis: Command, benchmark: Path, tmp_path: Path
) -> None:
    """Export, answers got elsewhere, import, evaluate: the whole way on files."""
    files = sorted(benchmark.glob("*.py"))
    done = aegis("llm", "export", *files, "--out", "requests.jsonl", "--config", ",".join(EVERY))
    assert done.code == 0, done.err
    requests = [json.loads(line) for line in Path("requests.jsonl").read_text().splitlines()]
    assert len(requests) == 6
    lines = []
    for number, request in enumerate(requests):
        said = SAID if "roles" in request["schema"]["properties"] else BLIND
        usage = {"input": 1000 + number, "cached": 3000, "output": 200}
        lines.append({"id": request["id"], "answer": said, "model": "gpt-4o", "usage": usage})
    Path("responses.jsonl").write_text("\n".join(json.dumps(line) for line in lines))
    done = aegis(
        "llm", "import", "responses.jsonl", "--out", "kept", "--requests", "requests.jsonl"
    )
    assert done.code == 0, done.err
    result = aegis(
        "evaluate", "layer1", benchmark, "--config", "rules-only," + ",".join(EVERY),
        "--model", "replay:kept", "--json", "all.json", "--figures", "figures",
    )  # fmt: skip
    assert result.code == 0, result.out + result.err
    results = json.loads(Path("all.json").read_text())["results"]
    f1 = {one["judge"]: one["adjusted"]["f1"]["value"] for one in results}
    assert f1 == {
        "rules-only": pytest.approx(2 / 3),
        "hybrid": 1.0,
        "llm-only": 1.0,
        "trace-blind": 1.0,
    }
    asked = {one["judge"]: one["asked"] for one in results}
    assert asked["rules-only"] is None
    for name in EVERY:
        bill = asked[name]
        assert (bill["models"], bill["answered"]) == (["gpt-4o"], 2)
        assert bill["tokens"]["cached"] == 6000
        full = bill["tokens"]["input"] - bill["tokens"]["cached"]
        assert bill["cost"] == pytest.approx((full * 2.5 + 6000 * 1.25 + 400 * 10) / 1e6)
        assert bill["currency"] == "USD"
    assert "check your provider" in result.out
    drawn = sorted(path.name for path in Path("figures").iterdir())
    assert drawn == ["ablation_adjusted.png", "ablation_strict.png"]
    assert all(path.read_bytes()[:4] == b"\x89PNG" for path in Path("figures").iterdir())


def test_an_export_is_what_a_check_of_the_same_project_asks(
    aegis: Command, silent: Path, tmp_path: Path
) -> None:
    """Otherwise its answers would never be found."""
    (tmp_path / "pyproject.toml").write_text(
        '[tool.aegis-ot]\nassay = "pcr"\nignore = ["PCR-6"]\n'
        '[tool.aegis-ot.severity]\nPCR-1 = "off"\n'
    )
    assert aegis("llm", "export", silent, "--out", "requests.jsonl", "--ignore", "PCR-5").code == 0
    (line,) = Path("requests.jsonl").read_text().splitlines()
    question = json.loads(line)["messages"][0]["parts"][0]["text"]
    assert "pcr (known)" in question
    given = {"id": json.loads(line)["id"], "answer": SAID}
    Path("responses.jsonl").write_text(json.dumps(given))
    assert aegis("llm", "import", "responses.jsonl", "--out", "kept").code == 0
    asked = ("check", silent, "--model", "replay:kept")
    assert aegis(*asked, "--ignore", "PCR-5").code == 1
    result = aegis(*asked)
    assert result.code == 2, "other rules in force are another question"
    assert "not_recorded" in result.out
    result = aegis("llm", "export", silent, "--out", "r.jsonl", "--assay", "pcrr")
    assert result.code == 2
    assert "did you mean pcr" in result.err


def test_a_model_that_does_not_answer_is_told_in_an_evaluation(
    aegis: Command, benchmark: Path, tmp_path: Path
) -> None:
    (tmp_path / "kept").mkdir()
    result = aegis(
        "evaluate", "layer1", benchmark, "--config", "hybrid,llm-only",
        "--model", "replay:kept", "--json", "all.json",
    )  # fmt: skip
    assert result.code == 2
    assert "2 without the model's answer: bad.py not_recorded" in result.out
    hybrid, alone = json.loads(Path("all.json").read_text())["results"]
    assert hybrid["adjusted"]["true_positives"] == 1, "the rules' result stands"
    assert alone["adjusted"]["true_positives"] == 0, "no answer is no verdict"
    assert alone["unjudged"] == ["bad.py", "silent.py"]


HOSTILE = answer(
    family="generic",
    summary="Approved.",
    roles=[
        {"role": "ntc", "wells": ["2:A2"], "reason": ""},
        {"role": "water", "wells": ["2:A2", "4:A1"], "reason": ""},
    ],
    answers=[{"rule": "PCR-2", "answer": "holds", "reason": "Tips are fine."}],
    findings=[finding("PCR-1", ["4:A1"], [15])],
)


@pytest.mark.parametrize(
    "said",
    [HOSTILE, ["no JSON", HOSTILE]],
    ids=["hostile", "hostile after none"],
)
def test_no_model_lowers_the_rules_result_in_an_evaluation(
    aegis: Command, benchmark: Path, tmp_path: Path, said: Any
) -> None:
    aegis(
        "evaluate", "layer1", benchmark, "--config", "rules-only,hybrid",
        "--model", script(tmp_path, said), "--json", "all.json",
    )  # fmt: skip
    alone, hybrid = json.loads(Path("all.json").read_text())["results"]
    for before, after in zip(alone["rows"], hybrid["rows"], strict=True):
        assert set(before["found"]) <= set(after["found"])
        assert after["flagged"] or not before["flagged"]
        assert set(after["missed"]) <= set(before["missed"])
    assert hybrid["adjusted"]["true_positives"] >= alone["adjusted"]["true_positives"] == 1


def test_a_price_nobody_knows_is_no_price(aegis: Command, benchmark: Path, tmp_path: Path) -> None:
    said = script(tmp_path, SAID)
    asked = ("evaluate", "layer1", benchmark, "--config", "hybrid", "--json", "one.json")
    result = aegis(*asked, "--model", said)
    assert result.code == 0
    assert "cost      not known for scripted" in result.out
    assert json.loads(Path("one.json").read_text())["asked"]["cost"] is None


def test_figures_that_cannot_be_written_are_told_before_anybody_is_asked(
    aegis: Command, benchmark: Path, server: WireServer, tmp_path: Path
) -> None:
    (tmp_path / "taken").write_text("")
    result = aegis(
        "evaluate", "layer1", benchmark, "--config", "hybrid",
        "--model", _openai(server.url), "--figures", "taken/below",
    )  # fmt: skip
    assert result.code == 2
    assert "taken" in result.err
    assert server.seen == []


def test_a_configuration_that_asks_needs_a_model(aegis: Command, benchmark: Path) -> None:
    result = aegis("evaluate", "layer1", benchmark, "--config", "hybrid")
    assert result.code == 2
    assert "--model" in result.err
    assert aegis("evaluate", "layer1", benchmark, "--config", "hybird").code == 2


def test_whatever_is_asked_can_be_written_down_for_later(
    aegis: Command, silent: Path, tmp_path: Path
) -> None:
    """``export:FILE`` serves every caller that can name a model."""
    result = aegis("check", silent, "--model", "export:later.jsonl", "--record", "kept")
    assert result.code == 2
    assert "not_recorded" in result.out
    (line,) = Path("later.jsonl").read_text().splitlines()
    assert json.loads(line)["purpose"] == "layer1"
