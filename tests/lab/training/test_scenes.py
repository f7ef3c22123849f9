"""Drawn frames and what is cut from them."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot_lab.training.axes import TipLabel
from aegis_ot_lab.training.examples import (
    TrainingExample,
    close_up_example,
    overview_example,
    targets,
)
from aegis_ot_lab.training.scenes import SIZES, draw_frame


def test_the_same_seed_draws_the_same_frame() -> None:
    first, second = (draw_frame(np.random.default_rng(3)) for _ in range(2))
    assert (first[0] == second[0]).all()
    assert first[1:] == second[1:]


def test_other_seeds_draw_other_frames() -> None:
    assert draw_frame(np.random.default_rng(3))[1:] != draw_frame(np.random.default_rng(4))[1:]


def test_drawn_tips_lie_in_the_frame_and_hang() -> None:
    rng, shown = np.random.default_rng(7), 0
    for _ in range(30):
        image, label, decoy = draw_frame(rng, tip=True)
        assert (image.shape[1], image.shape[0]) in SIZES
        assert decoy is None
        if label is None:  # burnt out
            continue
        shown += 1
        assert label.orifice[1] > label.collar[1]
        assert 0 <= label.collar[1] < image.shape[0]
        assert label.radius > 0
    assert shown > 25


def test_a_frame_without_a_tip_has_no_label() -> None:
    rng = np.random.default_rng(7)
    drawn = [draw_frame(rng, tip=False) for _ in range(30)]
    assert all(label is None for _, label, _ in drawn)
    assert any(decoy is not None for _, _, decoy in drawn)


def test_the_tip_is_where_the_label_says() -> None:
    """The same scene with and without the tip differs inside the label's box, mostly."""
    inside, outside = 0.0, 0.0
    for seed in range(12):
        image, label, _ = draw_frame(np.random.default_rng(seed), tip=True)
        assert label is not None
        x0, x1 = (int(v) for v in (label.collar[0] - 9, label.collar[0] + 9))
        y = int(np.clip((label.collar[1] + label.orifice[1]) / 2, 2, image.shape[0] - 3))
        rows = image[max(0, y - 3) : y + 3].astype(float).mean(axis=(0, 2))
        edges = np.abs(np.diff(rows))
        inside += edges[max(0, x0) : x1].mean()
        outside += edges.mean()
    assert inside > 1.5 * outside


@pytest.mark.parametrize("seed", range(6))
def test_close_ups_keep_the_tip_on_the_same_pixels(seed: int) -> None:
    rng = np.random.default_rng(seed)
    image = np.full((480, 640, 3), 30, np.uint8)
    label = TipLabel((300.5, 120.5), (303.5, 280.5), 10.0)
    image[118:123, 298:303] = 255
    example = close_up_example(rng, image, label, None)
    if example.label is None:
        pytest.skip("aimed elsewhere on purpose")
    x, y = example.label.collar
    assert example.image[int(y), int(x)].min() > 200


def test_an_overview_keeps_the_label_on_its_pixels() -> None:
    image = np.full((540, 960, 3), 30, np.uint8)
    image[110:131, 290:311] = 255
    example = overview_example(image, TipLabel((300.5, 120.5), (303.5, 280.5), 10.0))
    assert example.label is not None
    x, y = example.label.collar
    assert example.image[int(y), int(x)].min() > 200
    assert example.label.length == pytest.approx(160 * 0.4, rel=0.02)


def test_a_mirrored_example_mirrors_its_label() -> None:
    image = np.zeros((64, 96, 3), np.uint8)
    image[20, 10] = 255
    mirrored = TrainingExample(image, TipLabel((10.5, 20.5), (12.5, 50.5), 4.0)).mirrored()
    assert mirrored.label is not None
    assert mirrored.image[20, int(mirrored.label.collar[0])].min() == 255
    assert TrainingExample(image, None).mirrored().label is None


def test_targets_are_hot_at_the_two_ends_only() -> None:
    maps, weight = targets(56, 96, TipLabel((100.0, 40.0), (104.0, 130.0), 9.0))
    row, column = np.unravel_index(int(maps[0].argmax()), maps[0].shape)
    assert row in (9, 10)
    assert column in (24, 25)
    assert maps[0].max() == maps[1].max() == 1.0
    assert maps[1][10, 25] < 0.01
    assert 0 < (weight > 0).sum() < 60


@pytest.mark.parametrize("seed", range(8))
def test_a_part_of_an_example_keeps_the_label_on_its_pixels(seed: int) -> None:
    image = np.zeros((224, 384, 3), np.uint8)
    image[60, 200] = 255
    whole = TrainingExample(image, TipLabel((200.5, 60.5), (203.5, 120.5), 4.0))
    part = whole.cropped(np.random.default_rng(seed), 192, 256)
    assert part.image.shape == (192, 256, 3)
    assert part.label is not None
    x, y = part.label.collar
    if 0 <= x < 256 and 0 <= y < 192:
        assert part.image[int(y), int(x)].min() == 255
    assert part.label.length == pytest.approx(whole.label.length if whole.label else 0)


def test_a_small_example_is_not_cut() -> None:
    example = TrainingExample(np.zeros((256, 96, 3), np.uint8), None)
    assert example.cropped(np.random.default_rng(0), 192, 256) is example


def test_every_tip_of_a_multi_channel_pipette_is_wanted() -> None:
    second = TipLabel((140.0, 42.0), (144.0, 132.0), 5.0)
    maps, weight = targets(56, 96, TipLabel((100.0, 40.0), (104.0, 130.0), 9.0, (second,)))
    assert (maps[:2] == 1.0).sum() == 4
    assert np.exp(maps[6, 10, 25]) == pytest.approx(9.0)
    assert np.exp(maps[6, 10, 35]) == pytest.approx(5.0)
    assert weight[0, 10, 35] > 0.2


def test_the_tips_beside_move_with_the_view() -> None:
    image = np.full((540, 960, 3), 30, np.uint8)
    image[110:131, 490:511] = 255
    second = TipLabel((500.5, 120.5), (503.5, 280.5), 10.0)
    example = overview_example(image, TipLabel((300.5, 120.5), (303.5, 280.5), 10.0, (second,)))
    assert example.label is not None
    (x, y) = example.label.beside[0].collar
    assert example.image[int(y), int(x)].min() == 255
    (x, y) = example.mirrored().label.beside[0].collar  # type: ignore[union-attr]
    assert example.mirrored().image[int(y), int(x)].min() == 255
