"""``aegis-ot llm``: out and in again, through the command line."""

from __future__ import annotations

import json
from pathlib import Path

from typer.testing import CliRunner

from aegis_ot.cli.app import app
from aegis_ot.llm import ReplayBackend, hybrid
from tests.llm.samples import CONTAMINATED, SILENT, answer, examined

runner = CliRunner()


def test_requests_out_and_answers_in(tmp_path: Path) -> None:
    for name, text in (("a", CONTAMINATED), ("b", SILENT)):
        (tmp_path / f"{name}.py").write_text(text)
    out, replay = tmp_path / "requests.jsonl", tmp_path / "replay"
    files = [str(tmp_path / "a.py"), str(tmp_path / "b.py"), str(tmp_path / "missing.py")]
    done = runner.invoke(app, ["llm", "export", *files, "--out", str(out)])
    assert done.exit_code == 2, "one file is missing"
    assert "missing.py" in done.output
    lines = [json.loads(line) for line in out.read_text().split("\n") if line]
    assert [Path(line["about"]).name for line in lines] == ["a.py", "b.py"]
    responses = tmp_path / "responses.jsonl"
    said = answer(summary="Read by hand.")
    responses.write_text(
        "\n".join(json.dumps({"id": line["id"], "answer": said}) for line in lines)
    )
    done = runner.invoke(
        app, ["llm", "import", str(responses), "--out", str(replay), "--requests", str(out)]
    )
    assert done.exit_code == 0, done.output
    # The child process saw the protocol as this one does, but for the file's name.
    request_of = {Path(line["about"]).name: line for line in lines}
    assert '"hash"' in next(replay.glob("*.json")).read_text()
    assert request_of["b.py"]["purpose"] == "layer1"
    result = hybrid(*examined(SILENT), ReplayBackend(replay))
    assert not result.unanswered, result.report.undecided


def test_answers_that_cannot_be_used_are_told(tmp_path: Path) -> None:
    responses = tmp_path / "responses.jsonl"
    responses.write_text('{"id": "x"}\n')
    done = runner.invoke(app, ["llm", "import", str(responses), "--out", str(tmp_path / "r")])
    assert done.exit_code == 2
    assert "line 1" in done.output


def test_an_answer_that_quotes_what_the_source_does_not_say_is_not_kept(tmp_path: Path) -> None:
    (tmp_path / "b.py").write_text(SILENT)
    out, responses = tmp_path / "requests.jsonl", tmp_path / "responses.jsonl"
    runner.invoke(app, ["llm", "export", str(tmp_path / "b.py"), "--out", str(out)])
    number, line = next((n, t) for n, t in enumerate(SILENT.splitlines(), 1) if "load_labware" in t)
    cited = {"role": "template", "wells": ["2:A1"], "levels": []}
    cited["citations"] = [{"line": number + 1, "quote": line.strip()[:40]}]
    given = {"about": "b.py", "answer": answer(roles=[cited])}
    responses.write_text(json.dumps(given))
    done = runner.invoke(
        app,
        ["llm", "import", str(responses), "--out", str(tmp_path / "r"), "--requests", str(out)],
    )
    assert done.exit_code == 2
    assert f"does not stand at line {number + 1}" in " ".join(done.output.split())
    assert not list((tmp_path / "r").glob("*.json"))
