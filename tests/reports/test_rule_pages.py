from __future__ import annotations

import re
from dataclasses import fields
from pathlib import Path

import pytest
from syrupy.assertion import SnapshotAssertion

from aegis_ot.preflight import load_rules
from aegis_ot.preflight.checks import CHECKS
from aegis_ot.preflight.rules import (
    Example,
    Examples,
    Family,
    RoleSignal,
    RoleSpec,
    RuleSpec,
    SeriesSpec,
    ShapeSignal,
    Signal,
)
from aegis_ot.reports.rule_pages import rule_pages
from aegis_ot.reports.rule_text import rule_list, rule_text

from .sample import DATABASE, FAMILY

ROOT = Path(__file__).parents[2]


def test_one_rule(snapshot: SnapshotAssertion) -> None:
    assert rule_text(FAMILY, FAMILY.rules[0]) == snapshot


def test_the_list(snapshot: SnapshotAssertion) -> None:
    assert rule_list(DATABASE) == snapshot


def test_a_family_page(snapshot: SnapshotAssertion) -> None:
    assert rule_pages(DATABASE)["pcr.md"] == snapshot


def test_the_shipped_pages_are_up_to_date() -> None:
    for name, text in rule_pages(load_rules()).items():
        page = ROOT / "docs" / "rules" / name
        assert page.read_text(encoding="utf-8") == text, f"{name}: run `aegis-ot rules docs`"


def test_every_parameter_of_every_check_is_told() -> None:
    page = rule_pages(load_rules())["checks.md"]
    for name, check in CHECKS.items():
        part = page.split(f"\n## {name}\n")[1].split("\n## ")[0]
        told = dict(re.findall(r"^- `(\w+)`(?: \([^:]*\))?: (.+)$", part, re.MULTILINE))
        assert list(told) == [field.name for field in fields(check)], name
    assert "- `not_into` (optional): Roles whose wells are let be" in page


@pytest.mark.parametrize(
    ("title", "cls"),
    [
        ("Family", Family),
        ("Role", RoleSpec),
        ("Rule", RuleSpec),
        ("Examples", Examples),
        ("Example", Example),
        ("Signal", Signal),
        ("Shape", ShapeSignal),
        ("Known by", RoleSignal),
        ("Series", SeriesSpec),
    ],
)
def test_every_field_of_a_rule_file_is_told(title: str, cls: type) -> None:
    page = rule_pages(load_rules())["fields.md"]
    part = page.split(f"\n## {title}\n")[1].split("\n## ")[0]
    told = dict(re.findall(r"^\| `(\w+)` \| .+ \| .+ \| (.+) \|$", part, re.MULTILINE))
    assert list(told) == [f.name for f in fields(cls) if not f.metadata.get("internal")]


def test_the_fields_page_tells_kinds_and_defaults() -> None:
    page = rule_pages(load_rules())["fields.md"]
    for row in (
        "| `roles` | by name: [role](#role) | required | ",
        '| `side` | `source`, `destination` or `any` | `"any"` | ',
        "| `receives` | list of roles | none | ",
        "| `level` | number | none | ",
    ):
        assert row in page


@pytest.mark.parametrize("page", ["README.md", "pcr.md", "fields.md"])
def test_every_link_leads_somewhere(page: str) -> None:
    pages = rule_pages(load_rules())
    anchors = {
        name: {
            re.sub(r"[^\w\- ]", "", line.lstrip("# ")).lower().replace(" ", "-")
            for line in text.splitlines()
            if line.startswith("#")
        }
        for name, text in pages.items()
    }
    links = re.findall(r"\]\(([^)#]*)(?:#([^)]+))?\)", pages[page])
    assert links
    for target, anchor in links:
        assert (target or page) in pages
        assert not anchor or anchor in anchors[target or page]
