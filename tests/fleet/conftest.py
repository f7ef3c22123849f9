from __future__ import annotations

import pytest

from ..cli.commands import Command


@pytest.fixture
def aegis(capfdbinary: pytest.CaptureFixture[bytes]) -> Command:
    return Command(capfdbinary)
