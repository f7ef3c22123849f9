"""The documentation builds as a site, and what is generated is up to date."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from scripts.cli_reference import PAGE, page

from .blocks import ROOT


def test_the_reference_of_the_command_line_is_up_to_date():
    assert PAGE.read_text(encoding="utf-8") == page(), "make docs writes it anew"


def test_the_site_builds_without_a_warning(tmp_path: Path):
    pytest.importorskip("material", reason="mkdocs-material is not installed: extra docs")
    call = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(tmp_path)]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    start = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert "tutorial/protocol.html" in start
    assert "https://fonts" not in start, "the site fetches nothing from elsewhere"
