"""Data sets whose cameras are registered by the robot's positions."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from aegis_ot.errors import DatasetError, StoreError
from aegis_ot.vision.dataset import load_dataset
from aegis_ot.vision.dataset_writer import DatasetWriter
from aegis_ot.vision.detection.heatmap import HeatmapDetector
from aegis_ot.vision.types import Image
from aegis_ot.vocabulary import KeyframeKind
from aegis_ot.worldmodel.registered_tips import learned_locator
from aegis_ot_lab.found_tips import find_tips
from tests.vision.registration.test_locating import drawn, locate
from tests.vision.samples import sample


def test_without_positions_it_is_said_what_to_use(tmp_path: Path) -> None:
    with DatasetWriter(tmp_path / "set", {}) as writer:
        writer.add(sample("a", plate="p"))
    (tmp_path / "set" / "positions.csv").unlink()
    with pytest.raises(DatasetError, match=r"positions\.csv is missing.*--boxes detector"):
        find_tips(load_dataset(tmp_path / "set"), "registered")


class Damaged(dict[KeyframeKind, Image]):
    def __getitem__(self, kind: KeyframeKind) -> Image:
        raise StoreError(f"{kind.value} is damaged.")


def test_of_a_finished_plate_the_first_tips_are_projected_too() -> None:
    plate = [drawn(number) for number in range(3)]
    damaged = replace(plate[0], frames=Damaged(plate[0].frames))
    locator = learned_locator([damaged, *plate], HeatmapDetector())
    for kind, seen in locate(locator, plate[0]).items():
        assert seen.expected is not None, kind
