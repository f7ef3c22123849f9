"""The rule database: complete, valid, and true to its own examples."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest

from aegis_ot.checking.rule_examples import run_examples
from aegis_ot.errors import RuleError
from aegis_ot.preflight import load_database
from aegis_ot.preflight.database import load_family, shipped_rules
from aegis_ot.preflight.rules import Family
from aegis_ot.reports.rule_schema import family_schema, schema_text

SIXTH = Path(__file__).parents[2] / "examples" / "rules" / "elisa.json"
IDS = (
    [f"PCR-{n}" for n in range(1, 7)]
    + [f"SD-{n}" for n in range(1, 6)]
    + [f"BRD-{n}" for n in range(1, 5)]
    + [f"CELL-{n}" for n in range(1, 5)]
    + [f"GEN-{n}" for n in range(1, 4)]
)
HANDLING = [f"HND-{n}" for n in range(1, 7)]


def test_all_22_rules_are_there_and_those_of_handling() -> None:
    rules = load_database().rules
    assert sorted(rule.id for rule in rules) == sorted([*IDS, *HANDLING])
    assert {r.id for r in rules if r.severity == "warning"} == {"PCR-6", "HND-3", "HND-5"}
    for rule in rules:
        assert rule.prompt
        assert rule.reference


def test_the_published_schema_is_the_generated_one() -> None:
    assert (shipped_rules() / "family.schema.json").read_text(encoding="utf-8") == schema_text()


@pytest.mark.parametrize("path", [*sorted(shipped_rules().glob("*.json")), SIXTH], ids=str)
def test_files_agree_with_the_schema(path: Path) -> None:
    if path.name in ("common.json", "family.schema.json"):
        return
    data = json.loads(path.read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator(family_schema()).validate(data)


def test_no_role_lists_a_word_twice() -> None:
    for family in load_database().families:
        for name, role in family.roles.items():
            for words in (role.words, role.never):
                assert sorted(set(words)) == sorted(words), f"{family.family}: {name}"


@pytest.mark.parametrize("family", load_database().families, ids=lambda family: family.family)
def test_examples_do_what_they_say(family: Family) -> None:
    own = [rule.id for rule in family.rules]
    results = run_examples(load_database(), own)
    assert {result.rule for result in results} == set(own)
    assert [f"{r.rule}: {r.title}: {r.problem or r.found}" for r in results if not r.ok] == []


def test_a_sixth_family_needs_no_code() -> None:
    database = load_database([SIXTH])
    results = run_examples(database, ["ELISA-1", "ELISA-2", "ELISA-3"])
    assert len(results) == 6
    assert all(result.ok for result in results)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d["rules"][0].pop("fix"), "rule ELISA-1: field 'fix' is missing"),
        (lambda d: d["rules"][0].update(severity="bad"), "rule ELISA-1: severity"),
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
        load_database([path])
