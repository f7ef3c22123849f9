"""A camera is found again from noisy sightings, some of them wrong."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from aegis_ot.vision.registration import CameraModel, Registration, Sighting, fit
from aegis_ot.vision.tips import TIPS

TIP = TIPS["ot2_300"]
SIZE = (640, 480)

cameras = st.builds(
    CameraModel,
    size=st.just(SIZE),
    pivot=st.just((150.0, 60.0, 70.0)),
    azimuth=st.floats(-1.2, 1.2),
    elevation=st.floats(0.03, 0.5),
    log_distance=st.floats(np.log(300), np.log(650)),
    roll=st.floats(-0.04, 0.04),
    x=st.floats(-0.08, 0.08),
    y=st.floats(-0.05, 0.05),
    log_focal=st.floats(np.log(550), np.log(1100)),
    distortion=st.floats(-0.02, 0.02),
)


def ends_on_deck(place: tuple[float, float, float]) -> np.ndarray:
    x, y, z = place
    return np.array([place, (x, y, z + TIP.length_mm)])


def places(rng: np.random.Generator, wells: int) -> list[tuple[tuple[float, float, float], bool]]:
    """Four keyframes a well, as a run has them: in the source, above it and in the well, above it;
    and whether labware may hide the end."""
    found: list[tuple[tuple[float, float, float], bool]] = []
    for _ in range(wells):
        x, y = float(rng.uniform(170, 260)), float(rng.uniform(30, 95))
        found += [((80.0, 60.0, 35.0), True), ((x, y, 62.0), False)]
        found += [((x, y, 22.0), True), ((x, y, 55.0), False)]
    return found


def sightings(
    camera: CameraModel, rng: np.random.Generator, wells: int, noise: float, wrong: float
) -> list[Sighting]:
    seen = []
    for place, hidden in places(rng, wells):
        ends = ends_on_deck(place)
        orifice, collar = camera.project(ends) + rng.normal(0, noise, (2, 2))
        if rng.random() < wrong:
            orifice, collar = (end + rng.normal(0, 60, 2) for end in (orifice, collar))
        seen.append(Sighting(place, TIP.name, tuple(orifice), tuple(collar), hidden))
    return seen


def errors(found: Registration, camera: CameraModel, rng: np.random.Generator) -> np.ndarray:
    """Distance of projected from true ends at places of the same kind, px, and the standard error
    told of each; ``(n, 2)``."""
    rows = []
    for place, _ in places(rng, 6):
        tip = found.project_tip(place, TIP.name)
        assert tip is not None
        ends = ends_on_deck(place)
        off = np.hypot(*(np.array([tip.orifice, tip.collar]) - camera.project(ends)).T)
        rows.append((off.max(), tip.sigma_px))
    return np.array(rows)


@settings(max_examples=6, deadline=None)
@given(camera=cameras, seed=st.integers(0, 10_000))
def test_six_wells_show_where_the_others_will_be(camera: CameraModel, seed: int) -> None:
    rng = np.random.default_rng(seed)
    found = fit(sightings(camera, rng, 6, noise=2.0, wrong=0.1), SIZE)
    assert found is not None
    off = errors(found, camera, rng)
    assert np.median(off[:, 0]) < 4.0
    assert (off[:, 0] < 6.0 * off[:, 1] + 2.0).all(), "the error told is no promise"


@settings(max_examples=4, deadline=None)
@given(camera=cameras, seed=st.integers(0, 10_000))
def test_without_noise_the_camera_is_exact(camera: CameraModel, seed: int) -> None:
    rng = np.random.default_rng(seed)
    found = fit(sightings(camera, rng, 8, noise=0.0, wrong=0.0), SIZE)
    assert found is not None
    assert errors(found, camera, rng)[:, 0].max() < 1.5


def test_an_earlier_registration_is_a_start() -> None:
    rng = np.random.default_rng(3)
    camera = CameraModel(SIZE, (150.0, 60.0, 70.0), 0.3, 0.1, 6.1, 0.0, 0.0, 0.0, 6.7)
    seen = sightings(camera, rng, 6, noise=2.0, wrong=0.1)
    first = fit(seen, SIZE)
    again = fit(seen, SIZE, first)
    assert first is not None
    assert again is not None
    for place, _ in places(rng, 4):
        one, other = (known.project_tip(place, TIP.name) for known in (first, again))
        assert one is not None
        assert other is not None
        assert np.allclose(one.orifice, other.orifice, atol=2.0)


def test_one_place_tells_no_camera() -> None:
    seen = [Sighting((10.0, 10.0, 10.0), TIP.name, (300.0, 300.0), (300.0, 200.0))] * 6
    assert fit(seen, SIZE) is None
    assert fit(seen[:2], SIZE) is None


def test_a_kind_of_tip_that_was_never_seen_is_not_projected() -> None:
    rng = np.random.default_rng(3)
    camera = CameraModel(SIZE, (150.0, 60.0, 70.0), 0.3, 0.1, 6.1, 0.0, 0.0, 0.0, 6.7)
    found = fit(sightings(camera, rng, 3, noise=1.0, wrong=0.0), SIZE)
    assert found is not None
    assert found.project_tip((200.0, 60.0, 60.0), "ot2_1000") is None
