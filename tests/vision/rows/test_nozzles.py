"""Places of a row's nozzles: which of them have a tip."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
import pytest

from aegis_ot.vision.column.measure import shape_of
from aegis_ot.vision.rows.fit import Row, fitted
from aegis_ot.vision.rows.nozzles import Nozzle, compare, look_at_nozzles, promise, row_of, with_tip
from aegis_ot.vision.tips import TIPS
from aegis_ot.vision.types import Axis, End, Ends, Image, TipDetection

TIP = TIPS["ot2_300"]
STEP, LENGTH, BOTTOM = 40.0, 260.0, 370.0


def ends_of(number: int) -> np.ndarray:
    x = 130.0 + STEP * number
    return np.array([x, BOTTOM - LENGTH, x, BOTTOM])


def a_row(numbers: Sequence[int]) -> Row:
    table = np.array([(*ends_of(number), 0.5) for number in numbers])
    return fitted(table, {number: at for at, number in enumerate(numbers)})


def picture(tips: Sequence[int], nozzles: Sequence[int]) -> Image:
    """Clear tips, and bare nozzles, before a room with a shelf and a bright panel."""
    image = np.full((480, 640, 3), 90, np.uint8)
    image[:, 320:] = 190
    image[250:262] = 60
    for number in nozzles:
        x, y = ends_of(number)[:2]
        cv2.rectangle(image, (round(x) - 9, round(y) - 60), (round(x) + 9, round(y) + 20), 30, -1)
    for number in tips:
        x = ends_of(number)[0]
        outline = np.array([(x - 14, BOTTOM - LENGTH), (x + 14, BOTTOM - LENGTH),
                            (x + 3, BOTTOM), (x - 3, BOTTOM)]).round().astype(int)  # fmt: skip
        cv2.polylines(image, [outline], True, (235, 235, 235), 2, cv2.LINE_AA)
    return image


class Seen:
    """Sees the ends of some tips in close-ups, others faintly."""

    def __init__(self, heats: dict[int, float]) -> None:
        self.heats = heats

    def detect(self, image: Image) -> TipDetection | None:
        return None

    def ends(self, image: Image, tip: TipDetection, reach: float) -> Ends:
        return Ends()

    ends_of_length = ends  # type: ignore[assignment]

    def ends_of_each(self, image: Image, axes: Sequence[Axis]) -> list[Ends]:
        places = [(*ends_of(number), heat) for number, heat in self.heats.items()]
        seen = Ends(
            tuple(End(x, y, heat) for x, y, _, _, heat in places),
            tuple(End(x, y, heat) for _, _, x, y, heat in places),
        )
        return [seen] * len(axes)


def test_each_place_is_looked_at_that_may_have_a_nozzle_and_is_in_the_frame() -> None:
    nozzles = look_at_nozzles(Seen({}), picture([], []), a_row([0, 1, 2, 3, 4]), 8)
    assert sorted(nozzles) == list(range(-3, 8))
    nozzles = look_at_nozzles(Seen({}), picture([], [])[:, :340], a_row([0, 1, 2, 3, 4]), 8)
    assert sorted(nozzles) == list(range(-3, 6))


@pytest.mark.parametrize("bare", [0, 3, 7])
def test_a_bare_nozzle_that_looks_warm_is_unlike_the_tips_beside_it(bare: int) -> None:
    tips = [number for number in range(8) if number != bare]
    image = picture(tips, range(8))
    heats = {**dict.fromkeys(tips, 0.45), bare: 0.25}
    nozzles = compare(look_at_nozzles(Seen(heats), image, a_row(tips), 8), image, shape_of(TIP))
    row = row_of(nozzles, 8)
    assert row is not None
    shift = min(tips)
    assert sorted(number + shift for number in row.heats) == tips
    assert (
        nozzles[bare - shift].likeness < 0.45 < 0.6 < min(nozzles[n - shift].likeness for n in tips)
    )


def test_a_tip_that_the_network_hardly_sees_is_like_those_beside_it() -> None:
    image = picture(range(8), range(8))
    heats = {**dict.fromkeys(range(8), 0.45), 2: 0.12}
    nozzles = look_at_nozzles(Seen(heats), image, a_row(range(8)), 8)
    assert 2 not in with_tip(nozzles)
    assert 2 in with_tip(compare(nozzles, image, shape_of(TIP)))


def test_a_place_far_below_the_sure_tips_of_its_row_is_bare() -> None:
    """Before an even background a bare nozzle is not unlike a tip, but no tip is so cold."""
    sure = {n: Nozzle(ends_of(n), 0.75, 0.97) for n in range(7)}
    assert sorted(with_tip({**sure, 7: Nozzle(ends_of(7), 0.2, 0.7)})) == list(range(7))
    assert sorted(with_tip({**sure, 7: Nozzle(ends_of(7), 0.4, 0.8)})) == list(range(8))


@pytest.mark.parametrize("closely", [False, True])
def test_where_nothing_is_surely_a_tip_likeness_says_nothing(closely: bool) -> None:
    image = picture(range(8), range(8))
    nozzles = look_at_nozzles(Seen(dict.fromkeys(range(8), 0.2)), image, a_row(range(8)), 8)
    compared = compare(nozzles, image, shape_of(TIP), closely=closely)
    assert {one.likeness for one in compared.values()} == {0.0}
    assert row_of(compared, 8) is None


def test_the_only_sure_tip_is_one_of_them() -> None:
    image = picture(range(8), range(8))
    heats = {**dict.fromkeys(range(8), 0.28), 3: 0.45}
    nozzles = compare(look_at_nozzles(Seen(heats), image, a_row(range(8)), 8), image, shape_of(TIP))
    assert sorted(with_tip(nozzles)) == list(range(8))


def test_of_nine_places_in_line_the_eight_that_say_most_are_the_row() -> None:
    nozzles = {n: Nozzle(ends_of(n), 0.5, 0.6) for n in range(8)}
    row = row_of({**nozzles, 8: Nozzle(ends_of(8), 0.5, 0.3)}, 8)
    assert row is not None
    assert row.span == 8
    assert row.ends(0)[2] == pytest.approx(ends_of(0)[2], abs=1)
    assert promise({**nozzles, 8: Nozzle(ends_of(8), 0.4)}, 8) == pytest.approx(4.0)


def test_one_tip_is_no_row() -> None:
    assert row_of({0: Nozzle(ends_of(0), 0.9, 0.9)}, 8) is None
