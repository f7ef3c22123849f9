"""The rule database: complete, valid, and true to its own examples."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest

from aegis_ot.errors import RuleError
from aegis_ot.preflight import load_rules
from aegis_ot.preflight.rule_set import load_family, read_shipped, shipped_rules
from aegis_ot.preflight.rules import Family
from aegis_ot.reports.rule_schema import family_schema, schema_text
from aegis_ot.workbench.rule_examples import run_examples
from scripts.compile_rules import MODULE, module_text

SIXTH = Path(__file__).parents[2] / "examples" / "rules" / "luciferase.json"
IDS = (
    [f"PCR-{n}" for n in range(1, 7)]
    + [f"SD-{n}" for n in range(1, 6)]
    + [f"BRD-{n}" for n in range(1, 5)]
    + [f"CELL-{n}" for n in range(1, 5)]
    + [f"GEN-{n}" for n in range(1, 4)]
)
BEYOND = [f"HND-{n}" for n in range(1, 7)] + [f"CLN-{n}" for n in range(1, 6)]
BEYOND += [f"ELISA-{n}" for n in range(1, 7)]


def test_the_papers_22_rules_are_there_and_those_beyond_it() -> None:
    rules = load_rules().rules
    assert sorted(rule.id for rule in rules) == sorted([*IDS, *BEYOND])
    assert {r.id for r in rules if r.severity == "warning"} == {"PCR-6", "HND-3", "HND-5"}
    for rule in rules:
        assert rule.prompt
        assert rule.reference


def test_the_published_schema_is_the_generated_one() -> None:
    assert (shipped_rules() / "family.schema.json").read_text(encoding="utf-8") == schema_text()


def test_the_compiled_rules_are_the_files() -> None:
    """Else: ``python -m scripts.compile_rules``."""
    read = read_shipped()
    assert MODULE.read_text(encoding="utf-8") == module_text(read)
    assert load_rules() == read
    assert [f.path for f in load_rules().families] == [f.path for f in read.families]


@pytest.mark.parametrize("path", [*sorted(shipped_rules().glob("*.json")), SIXTH], ids=str)
def test_files_agree_with_the_schema(path: Path) -> None:
    if path.name in ("common.json", "family.schema.json"):
        return
    data = json.loads(path.read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator(family_schema()).validate(data)


def test_no_role_lists_a_word_twice() -> None:
    for family in load_rules().families:
        for name, role in family.roles.items():
            for words in (role.words, role.never):
                assert sorted(set(words)) == sorted(words), f"{family.family}: {name}"


@pytest.mark.parametrize("family", load_rules().families, ids=lambda family: family.family)
def test_examples_do_what_they_say(family: Family) -> None:
    own = [rule.id for rule in family.rules]
    results = run_examples(load_rules(), own)
    assert {result.rule for result in results} == set(own)
    if family.family == "handling":  # what refuses in any assay is shown from several sides
        assert all(sum(one.rule == rule for one in results) >= 4 for rule in own)
    assert [f"{r.rule}: {r.title}: {r.problem or r.found}" for r in results if not r.ok] == []


def test_a_sixth_family_needs_no_code() -> None:
    rule_set = load_rules([SIXTH])
    results = run_examples(rule_set, ["LUC-1", "LUC-2", "LUC-3"])
    assert len(results) == 6
    assert all(result.ok for result in results)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d["rules"][0].pop("fix"), "rule LUC-1: field 'fix' is missing"),
        (lambda d: d["rules"][0].update(severity="bad"), "rule LUC-1: severity"),
        (lambda d: d["rules"][0]["checks"][0].update(check="nope"), "no check 'nope'"),
        (lambda d: d["rules"][0]["checks"][0].update(wells=["nobody"]), "no role 'nobody'"),
        (lambda d: d["rules"][0]["checks"][0].update(wlls=["x"]), "unknown field 'wlls'"),
        (lambda d: d["roles"]["stop"].update(words="stop"), "roles.stop: words: expected a list"),
        (
            lambda d: d.update(shapes=[{"shape": "star", "weight": 1}]),
            "shapes[0]: shape: expected chain",
        ),
        (lambda d: d.update(known_by=[{"roles": ["stop|nobody"]}]), "no role 'nobody'"),
        (
            lambda d: d.update(known_by=[{"roles": ["stop"], "weight": 4}]),
            "known_by[0]: 'weight' is no field any more: leave it out",
        ),
        (lambda d: d["roles"]["stop"].update(filled_by=["nobody"]), "roles.stop: filled_by: there"),
        (
            lambda d: d["roles"]["stop"].update(receives=["nobody"]),
            "stop: receives: there is no role",
        ),
        (
            lambda d: d["roles"]["stop"].update(in_place_of=["water"]),
            "roles.stop: 'in_place_of' is no field any more: name such wells",
        ),
        (
            lambda d: d["roles"]["stop"].update(feeds=["sample"]),
            "roles.stop: 'feeds' is no field any more: name such wells",
        ),
        (
            lambda d: d["signals"][1].update(once=False),
            "signals[1]: 'once' is no field any more: leave it out",
        ),
        (lambda d: d["signals"][1].update(roles=["nobody"]), "signals[1]: roles: there is no role"),
        (lambda d: d.update(schema=9), "schema: expected 2, found 9"),
    ],
)
def test_errors_name_file_rule_and_field(change, message: str, tmp_path: Path) -> None:
    data = json.loads(SIXTH.read_text(encoding="utf-8"))
    change(data)
    path = tmp_path / "mine.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    with pytest.raises(RuleError) as caught:
        load_family(path)
    assert str(caught.value).startswith("mine.json: ")
    assert message in str(caught.value)


def test_a_rule_cannot_be_defined_twice(tmp_path: Path) -> None:
    data = json.loads(SIXTH.read_text(encoding="utf-8"))
    data["rules"][0]["id"] = "PCR-1"
    path = tmp_path / "mine.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    with pytest.raises(RuleError, match="rule PCR-1 is already defined"):
        load_rules([path])
