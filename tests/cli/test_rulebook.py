from __future__ import annotations

import json
from pathlib import Path

from aegis_ot.preflight.rule_set import shipped_rules

from .commands import Command


def test_explain_tells_why_and_how_to_mend(aegis: Command) -> None:
    result = aegis("explain", "pcr-2")
    assert result.code == 0
    for words in ("PCR-2 fresh-tip-template-to-ntc", "Why:", "Fix:", "Passes:", "Fails:"):
        assert words in result.out


def test_the_list_has_the_39_rules(aegis: Command) -> None:
    rules = json.loads(aegis("rules", "list", "--format", "json").out)["rules"]
    assert len(rules) == 39
    assert "39 rules in 8 families" in aegis("rules", "list").out


def test_docs_are_written_and_checked(aegis: Command, tmp_path: Path) -> None:
    assert aegis("rules", "docs", "--out", "pages").code == 0
    assert aegis("rules", "docs", "--out", "pages", "--check").code == 0
    (tmp_path / "pages" / "pcr.md").write_text("stale\n", encoding="utf-8")
    result = aegis("rules", "docs", "--out", "pages", "--check")
    assert result.code == 1
    assert "pcr.md is out of date" in result.out


def test_a_users_own_family_is_tested_and_a_broken_promise_reported(
    aegis: Command, tmp_path: Path
) -> None:
    family = json.loads((shipped_rules() / "generic.json").read_text(encoding="utf-8"))
    family["family"] = "ours"
    family["default"] = False
    (rule,) = [rule for rule in family["rules"] if rule["id"] == "GEN-3"]
    rule.update(id="OUR-1", scope="family", unless_reported=[])
    good = {"title": "exactly full", "code": ['p300.transfer(200, tubes["A1"], plate["A1"])']}
    bad = {"title": "too much", "code": [*good["code"], *good["code"]]}
    rule["examples"] = {"passing": [good], "failing": [bad]}
    family["rules"] = [rule]
    path = tmp_path / "ours.json"
    path.write_text(json.dumps(family), encoding="utf-8")
    kept = aegis("rules", "test", path)
    assert (kept.code, kept.out) == (0, "1 rule, 2 examples: 2 as promised, 0 not.\n")
    rule["examples"] = {"passing": [good], "failing": [{**bad, "code": good["code"]}]}
    path.write_text(json.dumps(family), encoding="utf-8")
    broken = aegis("rules", "test", path)
    assert broken.code == 1
    assert f"OUR-1: {bad['title']}: the rule finds nothing" in broken.out


def test_a_family_takes_no_page_of_the_docs(aegis: Command, tmp_path: Path) -> None:
    family = json.loads((shipped_rules() / "generic.json").read_text(encoding="utf-8"))
    family.update(family="Checks", default=False)
    family["rules"][0]["id"] = "OUR-1"
    del family["rules"][1:]
    (tmp_path / "ours.json").write_text(json.dumps(family), encoding="utf-8")
    result = aegis("rules", "docs", "--out", "pages", "--rules", "ours.json")
    assert result.code == 2
    assert "ours.json: family: the page Checks.md is not about a family" in result.err
    assert not (tmp_path / "pages").exists()


def test_rules_that_cannot_be_used_end_in_a_message(aegis: Command, tmp_path: Path) -> None:
    (tmp_path / "none").mkdir()
    (tmp_path / "deep.json").write_text("[" * 100_000, encoding="utf-8")
    for path in ("none", "deep.json"):
        for command in (("list", "--rules"), ("docs", "--rules"), ("test",)):
            result = aegis("rules", *command, path)
            assert result.code == 2
            assert result.err.startswith(f"aegis-ot: {path}: ")
            assert result.err.count("\n") == 1
