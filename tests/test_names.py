"""One name, one thing: no class name stands in two files."""

from __future__ import annotations

import re
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def test_every_class_has_a_name_of_its_own() -> None:
    files: dict[str, list[str]] = defaultdict(list)
    for package in ("aegis_ot", "aegis_ot_lab"):
        for path in sorted((ROOT / package).rglob("*.py")):
            for name in re.findall(r"^class ([A-Z]\w*)", path.read_text("utf-8"), re.MULTILINE):
                files[name].append(str(path.relative_to(ROOT)))
    assert {name: places for name, places in files.items() if len(places) > 1} == {}
