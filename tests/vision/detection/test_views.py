"""The views that the detector's network sees, and the way back."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from aegis_ot.vision.detection.views import (
    CLOSE_UP,
    CLOSE_UP_TIP,
    CLOSE_UP_TOP,
    close_up,
    overview,
    upright,
)


def spot(width: int, height: int, x: int, y: int) -> np.ndarray:
    image = np.zeros((height, width, 3), np.uint8)
    image[y - 4 : y + 4, x - 4 : x + 4] = 255
    return image


def brightest(image: np.ndarray) -> tuple[float, float]:
    grey = image[..., 0].astype(float)
    ys, xs = np.mgrid[: grey.shape[0], : grey.shape[1]]
    return ((xs + 0.5) * grey).sum() / grey.sum(), ((ys + 0.5) * grey).sum() / grey.sum()


@pytest.mark.parametrize("size", [(640, 480), (960, 540), (480, 640), (1920, 1080), (200, 150)])
def test_a_point_of_the_overview_goes_back_to_the_frame(size: tuple[int, int]) -> None:
    width, height = size
    view = overview(spot(width, height, 120, 90))
    assert view.image.shape[0] % 16 == 0
    assert view.image.shape[1] % 16 == 0
    assert view.to_frame(*brightest(view.image)) == pytest.approx((120.0, 90.0), abs=0.6)


def test_a_point_of_a_close_up_goes_back_to_the_frame() -> None:
    view = close_up(spot(640, 480, 310, 200), (300.0, 100.0), (304.0, 240.0))
    assert view.image.shape == (CLOSE_UP[1], CLOSE_UP[0], 3)
    assert view.to_frame(*brightest(view.image)) == pytest.approx((310.0, 200.0), abs=0.6)
    assert view.from_frame(310.0, 200.0) == pytest.approx(brightest(view.image), abs=0.6)


def test_a_close_up_shows_the_tip_at_its_usual_size() -> None:
    view = close_up(spot(640, 480, 310, 200), (300.0, 100.0), (300.0, 350.0))
    top, bottom = view.from_frame(300.0, 100.0), view.from_frame(300.0, 350.0)
    assert bottom[1] - top[1] == pytest.approx(CLOSE_UP_TIP, rel=0.02)


@pytest.mark.parametrize("place", [(0.0, 0.0), (639.0, 400.0), (-500.0, -500.0), (2000.0, 900.0)])
def test_a_close_up_may_reach_beyond_the_frame(place: tuple[float, float]) -> None:
    view = close_up(spot(640, 480, 310, 200), place, (place[0], place[1] + 150))
    assert view.image.shape == (CLOSE_UP[1], CLOSE_UP[0], 3)


def test_a_degenerate_tip_still_gives_a_view() -> None:
    view = close_up(spot(640, 480, 310, 200), (300.0, 100.0), (300.0, 100.0))
    assert view.image.shape == (CLOSE_UP[1], CLOSE_UP[0], 3)


def test_a_leaning_tip_hangs_straight_in_an_upright_view() -> None:
    image = np.zeros((480, 640, 3), np.uint8)
    collar, orifice = (250.0, 120.0), (330.0, 300.0)
    cv2.line(image, (250, 120), (330, 300), (255, 255, 255), 3, cv2.LINE_AA)
    view = upright(image, collar, orifice)
    width, _ = CLOSE_UP
    ends = ((width / 2, CLOSE_UP_TOP), (width / 2, CLOSE_UP_TOP + CLOSE_UP_TIP))
    for (x, y), end in zip(ends, (collar, orifice), strict=True):
        assert view.to_frame(x, y) == pytest.approx(end, abs=0.01)
        assert view.from_frame(*end) == pytest.approx((x, y), abs=0.01)
    along = view.image[int(CLOSE_UP_TOP) + 10 : int(CLOSE_UP_TOP + CLOSE_UP_TIP) - 10, :, 0]
    middles = (along * np.arange(width)).sum(axis=1) / along.sum(axis=1)
    assert np.abs(middles + 0.5 - width / 2).max() < 1.5


def test_an_upright_view_beyond_the_frame_is_no_fault() -> None:
    image = np.full((48, 64, 3), 90, np.uint8)
    assert (upright(image, (-300.0, -500.0), (-200.0, -300.0)).image == 90).all()
