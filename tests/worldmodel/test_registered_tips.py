"""Data sets whose cameras are registered by the robot's positions."""

from __future__ import annotations

from pathlib import Path

import pytest

from aegis_ot.errors import DatasetError
from aegis_ot.vision.dataset import load_dataset
from aegis_ot.vision.dataset_writer import DatasetWriter
from aegis_ot_lab.found_tips import find_tips
from tests.vision.samples import sample


def test_without_positions_it_is_said_what_to_use(tmp_path: Path) -> None:
    with DatasetWriter(tmp_path / "set", {}) as writer:
        writer.add(sample("a", plate="p"))
    (tmp_path / "set" / "positions.csv").unlink()
    with pytest.raises(DatasetError, match=r"positions\.csv is missing.*--boxes detector"):
        find_tips(load_dataset(tmp_path / "set"), "registered")
