"""An end that the detector always misplaces is told by the tip's true length."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.vision.registration import CameraModel, Sighting, fit
from aegis_ot.vision.registration.ends import Glimpse, seen_again
from aegis_ot.vision.tips import TIPS
from aegis_ot.vision.types import Axis, Image, TipDetection

TIP = TIPS["ot2_20"]
SIZE = (250, 250)
CAMERA = CameraModel(SIZE, (150.0, 60.0, 70.0), 0.3, 0.1, np.log(400.0), 0.0, 0.0, 0.1, 6.2)
Ends = tuple[np.ndarray, np.ndarray]


class Biased:
    """Sees a tip as it is in a close-up of the right place, and with an end amiss elsewhere.

    Frames carry their number and their own coordinates in their channels.
    """

    def __init__(self, collar: float, orifice: float) -> None:
        self.collar, self.orifice = collar, orifice
        self.true: list[Ends] = []

    def frame(self, place: tuple[float, float, float]) -> Image:
        x, y, z = place
        orifice, collar = CAMERA.project(np.array([place, (x, y, z + TIP.length_mm)]))
        self.true.append((collar, orifice))
        rows, columns = np.mgrid[0 : SIZE[1], 0 : SIZE[0]]
        number = np.full_like(rows, len(self.true) - 1)
        return np.stack((number, columns, rows), axis=2).astype(np.uint8)

    def biased(self, number: int) -> Ends:
        collar, orifice = self.true[number]
        along = orifice - collar
        return collar + self.collar * along, orifice + self.orifice * along

    def look_at(self, image: Image, axis: Axis) -> TipDetection | None:
        number, left, top = (int(value) for value in image[0, 0])
        corner = np.array((left, top), float)
        collar, orifice = self.true[number]
        off = max(np.hypot(*(np.array(axis[0]) + corner - collar)), 0.0)
        off = max(off, np.hypot(*(np.array(axis[1]) + corner - orifice)))
        aimed = off < 0.06 * np.hypot(*(orifice - collar))
        ends = (collar, orifice) if aimed else self.biased(number)
        (a, b), (c, d) = ((float(v) for v in end - corner) for end in ends)
        return TipDetection(a, b, 5.0, d - b, 0.8 if aimed else 0.6, (c, d), (a, b))


def glimpses(detector: Biased, wells: int) -> list[Glimpse]:
    rng, found = np.random.default_rng(5), []
    for number in range(4 * wells):
        hidden = number % 2 == 0
        z = (20.0, 60.0)[number % 2] + rng.uniform(-4, 4)
        place = (float(rng.uniform(120, 180)), float(rng.uniform(30, 90)), float(z))
        image = detector.frame(place)
        collar, orifice = detector.biased(number)
        ends = ((float(x), float(y)) for x, y in (orifice, collar))
        found.append(Glimpse.of(image, Sighting(place, TIP.name, *ends, hidden)))
    return found


@pytest.mark.parametrize(("collar", "orifice"), [(0.13, 0.0), (0.0, -0.1)])
def test_the_end_that_is_amiss_is_put_right(collar: float, orifice: float) -> None:
    detector = Biased(collar, orifice)
    before = glimpses(detector, 3)
    known = fit([each.sighting for each in before], SIZE)
    assert known is not None
    assert known.lengths_mm[TIP.name] < 0.95 * TIP.length_mm
    anew = seen_again(known, before, detector)
    assert anew is not None
    for number, glimpse in enumerate(anew):
        true_collar, true_orifice = detector.true[number]
        assert np.hypot(*(glimpse.sighting.collar - true_collar)) < 2.0
        assert np.hypot(*(glimpse.sighting.orifice - true_orifice)) < 2.0


def test_tips_that_are_seen_as_long_as_they_are_stay_as_they_were_seen() -> None:
    detector = Biased(0.0, 0.0)
    before = glimpses(detector, 3)
    known = fit([each.sighting for each in before], SIZE)
    assert known is not None
    assert seen_again(known, before, detector) is None
