"""Plates in rendered pictures: are the wells found, and does a dye show where it was put?"""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.simulation.dyes import DYES
from aegis_ot.simulation.plate_above import PlateShot, WellContent, render_plate
from aegis_ot.vision.plate import FORMATS, change_between, find_plate

SHOT = PlateShot(tilt_deg=(3.0, -2.0), turn_deg=6.0, slope=(0.3, -0.2))
OTHER = PlateShot(tilt_deg=(-2.0, 2.0), turn_deg=-3.0, gain=(1.05, 0.95, 0.9), seed=1)


@pytest.mark.parametrize("wells", [6, 12, 24, 48, 96])
def test_every_well_is_found_within_a_tenth_of_the_pitch(wells: int) -> None:
    image, truth = render_plate(FORMATS[wells], {}, SHOT)
    found = find_plate(image, FORMATS[wells])
    assert found is not None
    off = np.linalg.norm(found.pixels(FORMATS[wells].centres()) - truth, axis=1)
    assert off.max() < 0.1 * found.pitch_px


def test_a_picture_without_a_plate_has_none() -> None:
    rng = np.random.default_rng(1)
    image = rng.integers(0, 256, (600, 800, 3)).astype(np.uint8)
    assert find_plate(image, FORMATS[96]) is None


def test_a_dye_darkens_its_wells_by_its_volume_and_no_others() -> None:
    plate = FORMATS[96]
    red = ((DYES["red"], 0.3),)
    contents = {"B3": WellContent(100, red), "C4": WellContent(50, red)}
    before, _ = render_plate(plate, {}, SHOT)
    after, _ = render_plate(plate, contents, OTHER)
    places = find_plate(before, plate), find_plate(after, plate)
    assert places[0] is not None
    assert places[1] is not None
    change = change_between(before, places[0], after, places[1])
    green = dict(zip(plate.names, change.absorbed[:, 1], strict=True))
    assert green["B3"] / green["C4"] == pytest.approx(2.0, rel=0.35)
    others = [value for name, value in green.items() if name not in contents]
    assert np.abs(others).max() < 0.5 * green["C4"]
    assert not change.blinded.any()
