"""What is wrong in a rule file is refused: with file, rule or role, and field, in plain words."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from aegis_ot.errors import RuleError
from aegis_ot.preflight import load_rules
from aegis_ot.reports.rule_schema import family_schema

OWN = (Path(__file__).parents[2] / "examples" / "rules" / "luciferase.json").read_text("utf-8")
CARRY = {"check": "carry", "carried": ["sample"], "into": ["sample"]}
SAME = {"check": "uniform_volume", "wells": ["assay_well"], "liquid": ["stop"]}

Data = dict[str, Any]
Change = Callable[[Data], object]


def rule(**fields: object) -> Change:
    return lambda d: d["rules"][0].update(fields)


def role(**fields: object) -> Change:
    return lambda d: d["roles"]["stop"].update(fields)


def changed(change: Change) -> Data:
    data = json.loads(OWN)
    change(data)
    return data


def refusal(folder: Path, text: str | bytes) -> str:
    path = folder / "mine.json"
    path.write_bytes(text.encode("utf-8") if isinstance(text, str) else text)
    with pytest.raises(RuleError) as caught:
        load_rules([path])
    return str(caught.value)


REFUSED_BY_BOTH = [
    (
        rule(checks=[CARRY | {"via_destination": "sometimes"}]),
        "rule LUC-1: checks[0]: via_destination: "
        "expected only, not or an empty text, found 'sometimes'",
    ),
    (
        rule(checks=[SAME | {"tolerance": 0.05}]),
        "rule LUC-1: checks[0]: unknown field 'tolerance'; known are wells, liquid",
    ),
    (
        rule(checks=[CARRY, CARRY | {"via_destination": None}]),
        "rule LUC-1: checks[1]: via_destination: expected only, not or an empty text, found null",
    ),
    (rule(checks=[]), "rule LUC-1: checks: expected at least one, found an empty list"),
    (rule(severity="fatal"), "rule LUC-1: severity: expected error or warning, found 'fatal'"),
    (rule(scope="galaxy"), "rule LUC-1: scope: expected family or all, found 'galaxy'"),
    (rule(id=""), "rules[0]: id: expected a name of letters, digits,"),
    (rule(id="OWN 1"), "rule OWN 1: id: expected a name of letters, digits, '_', '-' and '.',"),
    (rule(id="LUC-1\n"), "found 'LUC-1\\n'"),
    (rule(id="A,B"), "found 'A,B'"),
    (lambda d: d.update(family="../luciferase"), "family: expected a name of letters, digits,"),
    (lambda d: d["roles"].update({"a|b": {"title": "a"}}), "roles: expected a name of letters,"),
    (role(words=[""]), "roles.stop: words[0]: expected a word or phrase, found ''"),
    (role(never=["stop", " "]), "roles.stop: never[1]: expected a word or phrase, found ' '"),
    (role(differing=[""]), "roles.stop: differing[0]: expected a word or phrase, found ''"),
    (role(side="left"), "roles.stop: side: expected source, destination or any, found 'left'"),
    (role(loaded="twice"), "roles.stop: loaded: expected shared, single, kept or an empty text,"),
    (lambda d: d["signals"][0].update(words=[""]), "signals[0]: words[0]: expected a word"),
    (
        lambda d: d.update(shapes=[{"shape": "chain", "weight": 1, "unless": ["star"]}]),
        "shapes[0]: unless[0]: expected chain, pooling or reactions, found 'star'",
    ),
    (lambda d: d.update(rules=[]), "rules: expected at least one, found an empty list"),
    (lambda d: d.update(schema=3), "schema: expected 2, found 3"),
    (
        lambda d: d.update(series={"wells": ["stop"], "stock": ["stop"], "diluent": ["stop"]}),
        "mine.json: series: 'wells' is no field any more: leave it out",
    ),
]


@pytest.mark.parametrize(("change", "message"), REFUSED_BY_BOTH)
def test_it_is_refused_by_the_published_schema_as_well(
    change: Change, message: str, tmp_path: Path
) -> None:
    data = changed(change)
    told = refusal(tmp_path, json.dumps(data))
    assert told.startswith("mine.json: ")
    assert message in told
    assert not jsonschema.Draft202012Validator(family_schema()).is_valid(data)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda d: d["roles"]["assay_well"].update(parents=["blank_well"]),
            "roles.assay_well: parents: they go in a circle: assay_well -> blank_well -> assay_wel",
        ),
        (role(parents=["stop"]), "roles.stop: parents: they go in a circle: stop -> stop"),
        (role(words=["stop", "--"]), "roles.stop: words: '--' holds no letter or number to look"),
        (role(receives=["nobody"]), "roles.stop: receives: there is no role 'nobody'"),
        (role(may_be=["nobody"]), "roles.stop: may_be: there is no role 'nobody'"),
        (
            lambda d: d.update(series={"stock": ["nobody"], "diluent": []}),
            "series: stock: there is no role 'nobody'",
        ),
        (
            rule(unless_reported=["PCR-1", "NOPE-9"]),
            "rule LUC-1: unless_reported: there is no rule 'NOPE-9'; known are BRD-1, ",
        ),
        (
            rule(unless_reported=["LUC-1"]),
            "rule LUC-1: unless_reported: they go in a circle: LUC-1 -> LUC-1",
        ),
        (
            lambda d: [
                d["rules"][0].update(unless_reported=["LUC-2"]),
                d["rules"][1].update(unless_reported=["PCR-2", "LUC-1"]),
            ],
            "rule LUC-2: unless_reported: they go in a circle: LUC-2 -> LUC-1 -> LUC-2",
        ),
        (rule(checks=[{"check": [[]]}]), "rule LUC-1: checks[0]: check: there is no check with"),
    ],
)
def test_names_must_lead_somewhere(change: Change, message: str, tmp_path: Path) -> None:
    told = refusal(tmp_path, json.dumps(changed(change)))
    assert told.startswith("mine.json: ")
    assert message in told


def test_parents_may_meet_again_above(tmp_path: Path) -> None:
    data = changed(role(parents=["lysis", "substrate"]))
    for name in ("lysis", "substrate"):
        data["roles"][name]["parents"] = ["sample"]
    path = tmp_path / "mine.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    assert load_rules([path]).family("luciferase").roles["stop"].parents == ("lysis", "substrate")


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e999", "1" + 400 * "0"])
@pytest.mark.parametrize(
    ("change", "place"),
    [
        (lambda d: d["signals"][0].update(weight=12345), "signals[0]: weight"),
        (role(level=12345), "roles.stop: level"),
    ],
)
def test_a_number_is_finite(change: Change, place: str, number: str, tmp_path: Path) -> None:
    told = refusal(tmp_path, json.dumps(changed(change)).replace("12345", number))
    assert told.startswith(f"mine.json: {place}: expected a finite number, found ")


def test_a_field_that_is_written_twice_is_refused(tmp_path: Path) -> None:
    twice = '"severity": "error", "severity": "warning"'
    told = refusal(tmp_path, OWN.replace('"severity": "error"', twice, 1))
    assert told == "mine.json: rule LUC-1: field 'severity' is written twice"
    twice = '"check": "receives", "check": "receives"'
    told = refusal(tmp_path, OWN.replace('"check": "receives"', twice, 1))
    assert told == "mine.json: rule LUC-1: checks[0]: field 'check' is written twice"
    told = refusal(tmp_path, OWN.replace('"stop": {', '"stop": {"title": "x"}, "stop": {', 1))
    assert told == "mine.json: roles: field 'stop' is written twice"


@pytest.mark.parametrize("text", ["[" * 100_000, '{"a":' * 100_000])
def test_deep_nesting_is_refused(text: str, tmp_path: Path) -> None:
    assert refusal(tmp_path, text) == (
        "mine.json: is not JSON: its lists or objects are nested too deeply"
    )


def test_a_file_that_is_not_utf_8_is_refused(tmp_path: Path) -> None:
    assert refusal(tmp_path, OWN.encode("utf-16")).startswith(
        "mine.json: is not JSON: it is not UTF-8 text ("
    )


def test_half_a_character_is_refused(tmp_path: Path) -> None:
    told = refusal(tmp_path, json.dumps(changed(rule(fix="\ud83d"))))
    assert told == (
        "mine.json: rule LUC-1: fix: expected a text, found half of a character in '\\ud83d'"
    )


def test_the_mark_that_windows_puts_first_is_no_fault(tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    path.write_text(OWN, encoding="utf-8-sig")
    assert load_rules([path]).family("luciferase").rules


def test_there_is_one_default_family(tmp_path: Path) -> None:
    told = refusal(tmp_path, json.dumps(changed(lambda d: d.update(default=True))))
    assert f"{tmp_path / 'mine.json'}: default: the family generic in " in told
    assert told.endswith("is the default already, and luciferase cannot be a second one")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (rule(id="pcr-1"), "rule pcr-1 is already defined in "),
        (lambda d: d.update(family="PCR"), "family PCR is already defined in "),
    ],
)
def test_capitals_alone_tell_nothing_apart(change: Change, message: str, tmp_path: Path) -> None:
    assert message in refusal(tmp_path, json.dumps(changed(change)))


def test_a_rule_of_another_file_may_be_named(tmp_path: Path) -> None:
    data = changed(rule(unless_reported=["OTHER-1"]))
    (tmp_path / "mine.json").write_text(json.dumps(data), encoding="utf-8")
    other = changed(rule(id="OTHER-1")) | {"family": "other"}
    other["rules"] = other["rules"][:1]
    (tmp_path / "other.json").write_text(json.dumps(other), encoding="utf-8")
    assert load_rules([tmp_path]).rule("LUC-1")[1].unless_reported == ("OTHER-1",)


@pytest.mark.parametrize("other", ["", "notes.txt", "family.schema.json"])
def test_a_folder_without_rules_is_refused(other: str, tmp_path: Path) -> None:
    if other:
        (tmp_path / other).write_text("{}", encoding="utf-8")
    with pytest.raises(RuleError) as caught:
        load_rules([tmp_path])
    assert str(caught.value) == f"{tmp_path}: there is no rule file (*.json) in this folder"
