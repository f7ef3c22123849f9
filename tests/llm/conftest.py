"""No test here may see a real key, a proxy, or anything but this machine."""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest

from .wire_server import WireServer

SESSION = {"AEGIS_OT_WARM", "AEGIS_OT_TESTS_RUNTIME_DIR"}
"""Of the whole session, so that its one rehearsing process serves here too."""


@pytest.fixture(autouse=True)
def _clean_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in list(os.environ):
        upper = name.upper()
        if name in SESSION:
            continue
        if upper.endswith(("_PROXY", "_API_KEY", "_AUTH_TOKEN", "_BASE_URL")) or upper.startswith(
            ("ANTHROPIC_", "OPENAI_", "AEGIS_OT_")
        ):
            monkeypatch.delenv(name)


@pytest.fixture
def server() -> Iterator[WireServer]:
    with WireServer() as running:
        yield running
