from __future__ import annotations

from pathlib import Path

import pytest

from .commands import Command


@pytest.fixture
def aegis(
    capfdbinary: pytest.CaptureFixture[bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Command:
    """The command line, called in an empty folder."""
    monkeypatch.chdir(tmp_path)
    return Command(capfdbinary)
