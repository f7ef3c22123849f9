from __future__ import annotations

from pathlib import Path

import pytest
from syrupy.assertion import SnapshotAssertion

from aegis_ot.preflight import load_database
from aegis_ot.reports import rule_list, rule_pages, rule_text

from .sample import DATABASE, FAMILY

ROOT = Path(__file__).parents[2]


def test_one_rule(snapshot: SnapshotAssertion) -> None:
    assert rule_text(FAMILY, FAMILY.rules[0]) == snapshot


def test_the_list(snapshot: SnapshotAssertion) -> None:
    assert rule_list(DATABASE) == snapshot


def test_a_family_page(snapshot: SnapshotAssertion) -> None:
    assert rule_pages(DATABASE)["pcr.md"] == snapshot


def test_the_shipped_pages_are_up_to_date() -> None:
    for name, text in rule_pages(load_database()).items():
        page = ROOT / "docs" / "rules" / name
        assert page.read_text(encoding="utf-8") == text, f"{name}: run `aegis-ot rules docs`"


@pytest.mark.parametrize("page", ["README.md", "pcr.md"])
def test_every_link_leads_somewhere(page: str) -> None:
    import re

    pages = rule_pages(load_database())
    anchors = {
        name: {
            re.sub(r"[^\w\- ]", "", line.lstrip("# ")).lower().replace(" ", "-")
            for line in text.splitlines()
            if line.startswith("#")
        }
        for name, text in pages.items()
    }
    links = re.findall(r"\]\(([^)#]+)(?:#([^)]+))?\)", pages[page])
    assert links
    for target, anchor in links:
        assert target in pages
        assert not anchor or anchor in anchors[target]
