"""Answers of a model, kept beside the protocols that they are about, are replayed and judged.

``answers.jsonl`` names each protocol by its file, so that the answers outlive a changed prompt.
"""

from __future__ import annotations

import functools
import json
from pathlib import Path

import pytest

from aegis_ot.adapters.opentrons.rehearsal import Script
from aegis_ot.llm import ReplayBackend, ScriptedBackend, hybrid
from aegis_ot.llm.layer1_prompt import hybrid_request
from aegis_ot.preflight import Report
from aegis_ot.vocabulary import Severity, VerdictWord
from aegis_ot_lab.batch import export_requests, import_answers
from tests.llm.samples import check_with_dossier, rule_set

EXAMPLES = Path(__file__).parents[2] / "examples"
FOLDERS = ["benchmark", "prose-benchmark"]


def answered(folder: str) -> list[str]:
    lines = (EXAMPLES / folder / "answers.jsonl").read_text(encoding="utf-8").splitlines()
    return [json.loads(line)["about"] for line in lines]


@functools.cache
def examined(folder: str, name: str):  # type: ignore[no-untyped-def]
    text = (EXAMPLES / folder / name).read_text(encoding="utf-8")
    return check_with_dossier(Script(text, name), rule_set())


@pytest.fixture(scope="module", params=FOLDERS)
def judged(request, tmp_path_factory) -> tuple[dict[str, dict], dict[str, Report]]:  # type: ignore[no-untyped-def, type-arg]
    """The labels, and the reports with the model's answers, by file."""
    folder, place = request.param, tmp_path_factory.mktemp("replay")
    names = answered(folder)
    asked = [(n, hybrid_request(examined(folder, n)[1], rule_set())) for n in names]
    export_requests([(n, one) for n, one in asked if one is not None], place / "requests.jsonl")
    done = import_answers(
        EXAMPLES / folder / "answers.jsonl", place / "kept", place / "requests.jsonl"
    )
    assert done.problems == ()
    assert done.kept == len(names) >= 20
    replay = ReplayBackend(place / "kept")
    reports = {n: hybrid(*examined(folder, n), replay).report for n in names}
    labels = json.loads((EXAMPLES / folder / "labels.json").read_text(encoding="utf-8"))
    return {label["file"]: label for label in labels}, reports


def test_every_labelled_mistake_is_found_and_no_sound_protocol_flagged(judged) -> None:  # type: ignore[no-untyped-def]
    labels, reports = judged
    for name, report in reports.items():
        wanted = labels[name].get("adjusted_verdict", labels[name]["verdict"])
        flagged = report.verdict in (VerdictWord.FAIL, VerdictWord.WARN)
        assert flagged == (wanted == "fail"), (name, report.findings)
        found = {finding.rule for finding in report.findings}
        assert wanted != "fail" or set(labels[name]["rules"]) <= found, (name, found)


def test_the_models_quotes_and_wells_are_accepted(judged) -> None:  # type: ignore[no-untyped-def]
    _, reports = judged
    for name, report in reports.items():
        assert not [note for note in report.notes if "not accepted" in note], name


def test_the_checks_find_as_much_with_the_models_roles_alone() -> None:
    """Nothing of what is found in prose rests on the model's own judgement."""
    lines = (
        (EXAMPLES / "prose-benchmark" / "answers.jsonl").read_text(encoding="utf-8").splitlines()
    )
    said = {one["about"]: one["answer"] for one in map(json.loads, lines)}
    for label in json.loads((EXAMPLES / "prose-benchmark" / "labels.json").read_text("utf-8")):
        if label["file"] in said and label["verdict"] == "fail":
            roles = said[label["file"]] | {"answers": [], "findings": []}
            known = examined("prose-benchmark", label["file"])
            after = hybrid(*known, ScriptedBackend([roles])).report
            assert set(label["rules"]) <= {finding.rule for finding in after.findings}


def test_what_the_model_adds_warns(judged) -> None:  # type: ignore[no-untyped-def]
    _, reports = judged
    added = [f for report in reports.values() for f in report.findings if f.source == "model"]
    assert {finding.severity for finding in added} <= {Severity.WARNING}


def test_an_answer_may_name_the_protocol_only_if_it_is_one(tmp_path: Path) -> None:
    name = "b10.py"
    request = hybrid_request(examined("benchmark", name)[1], rule_set())
    assert request is not None
    requests = tmp_path / "requests.jsonl"
    export_requests([(f"some/folder/{name}", request)], requests)
    answers = tmp_path / "answers.jsonl"
    answers.write_text('{"about": "other.py", "answer": "?"}\n{"about": "b10.py", "answer": "?"}\n')
    done = import_answers(answers, tmp_path / "kept", requests)
    assert "0 of the exported requests are about 'other.py'" in done.problems[0]
    assert "line 2: " in done.problems[1], "found, and held to the schema"
    done = import_answers(answers, tmp_path / "kept")
    assert "--requests is needed" in done.problems[0]
