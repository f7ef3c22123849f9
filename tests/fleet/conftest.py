from __future__ import annotations

import importlib.util

import pytest

from ..cli.commands import Command

# Where the extra [fleet] is not installed there is no fleet to test.
collect_ignore_glob = [] if importlib.util.find_spec("academy") else ["test_*.py"]


@pytest.fixture
def aegis(capfdbinary: pytest.CaptureFixture[bytes]) -> Command:
    return Command(capfdbinary)
