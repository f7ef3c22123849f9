"""Fixtures that the tests of evaluation, inspection and their commands share."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot_lab.drawing import write_dataset
from tests.worldmodel.stores import make_store


@pytest.fixture(scope="module")
def drawn(tmp_path_factory) -> Path:
    """Three plates, 13 wells, synthetic."""
    return write_dataset(tmp_path_factory.mktemp("drawn") / "set", 3, 1, "p300", size=(320, 240))


@pytest.fixture(scope="module")
def store(tmp_path_factory) -> Path:
    """A sidecar's store of one run: seven normal wells, then one without dispense."""
    return make_store(tmp_path_factory.mktemp("store"), ("",) * 7 + ("no_dispense",))
