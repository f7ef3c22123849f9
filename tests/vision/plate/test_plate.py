"""Plates in rendered pictures: are the wells found, and does a dye show where it was put?"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.simulation.dyes import DYES
from aegis_ot.vision.plate import FORMATS, change_between, find_plate, other_kind, plate_light
from scripts.plates_from_above.rendering import PlateShot, WellContent, render_plate

SHOT = PlateShot(tilt_deg=(3.0, -2.0), turn_deg=6.0, slope=(0.3, -0.2))
OTHER = PlateShot(tilt_deg=(-2.0, 2.0), turn_deg=-3.0, gain=(1.05, 0.95, 0.9), seed=1)
RED = ((DYES["red"], 0.3),)


@pytest.mark.parametrize("wells", [24, 96])
def test_every_well_is_found_within_a_tenth_of_the_pitch(wells: int) -> None:
    image, truth = render_plate(FORMATS[wells], {}, SHOT)
    found = find_plate(image, FORMATS[wells])
    assert found is not None
    off = np.linalg.norm(found.pixels(FORMATS[wells].centres()) - truth, axis=1)
    assert off.max() < 0.1 * found.pitch_px
    turned = found.turned().pixels(FORMATS[wells].centres())
    assert np.abs(turned[::-1] - found.pixels(FORMATS[wells].centres())).max() < 1e-3


def test_a_picture_without_a_plate_has_none() -> None:
    rng = np.random.default_rng(1)
    image = rng.integers(0, 256, (600, 800, 3)).astype(np.uint8)
    assert find_plate(image, FORMATS[96]) is None


def test_another_kind_of_plate_is_named_and_not_taken_for_the_one_looked_for() -> None:
    image, _ = render_plate(FORMATS[24], {}, replace(SHOT, width=640, height=480))
    found = find_plate(image, FORMATS[96])
    assert found is None
    assert other_kind(image, found) is FORMATS[24]


def test_a_dye_darkens_its_wells_by_its_volume_and_no_others() -> None:
    plate = FORMATS[96]
    contents = {"B3": WellContent(100, RED), "C4": WellContent(50, RED)}
    before, _ = render_plate(plate, {}, SHOT)
    after, _ = render_plate(plate, contents, OTHER)
    places = find_plate(before, plate), find_plate(after, plate)
    assert places[0] is not None
    assert places[1] is not None
    light = plate_light(before, places[0])
    change = change_between(light, plate_light(after, places[1]))
    green = dict(zip(plate.names, np.median(change.absorbed, axis=1)[:, 1], strict=True))
    assert green["B3"] / green["C4"] == pytest.approx(2.0, rel=0.35)
    others = [value for name, value in green.items() if name not in contents]
    assert np.abs(others).max() < 0.5 * green["C4"]
    assert not change.blinded.any()
    # A hand over A1 to B2, and nothing else, hides wells.
    x, y = places[1].pixels(plate.centres())[:14:13].mean(axis=0).astype(int)
    after[y - 80 : y + 80, x - 80 : x + 80] = (120, 150, 200)
    hidden = change_between(light, plate_light(after, places[1])).blinded
    names = {name for name, is_hidden in zip(plate.names, hidden, strict=True) if is_hidden}
    assert {"A1", "A2", "B1", "B2"} <= names <= {f"{r}{c}" for r in "ABC" for c in (1, 2, 3)}
