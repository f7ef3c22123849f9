"""Training frames drawn from recorded ones."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from aegis_ot.errors import DatasetError
from aegis_ot_lab.training.axes import TipLabel
from aegis_ot_lab.training.frame_pool import FramePool
from aegis_ot_lab.training.recorded import RecordedFrame, read_frames


def test_a_small_set_is_not_drowned_by_a_large_one(dataset: Path) -> None:
    frames = read_frames(dataset)
    many = [replace(frame, plate=f"other/{i}") for i in range(4) for frame in frames]
    pool, rng = FramePool(frames + many), np.random.default_rng(3)
    drawn = rng.choice(len(frames + many), 3000, p=pool.chances)
    assert np.mean(drawn < len(frames)) == pytest.approx(1 / (1 + 4**0.25), abs=0.03)


def test_an_unreadable_image_is_named(dataset: Path) -> None:
    (dataset / "frames" / "w0_transit.png").write_bytes(b"no image")
    with pytest.raises(DatasetError, match=r"w0_transit\.png"):
        FramePool(read_frames(dataset))


def test_drawn_frames_keep_the_tip_under_its_label(dataset: Path) -> None:
    frames = [frame for frame in read_frames(dataset) if frame.label is not None]
    pool, rng = FramePool(frames), np.random.default_rng(0)
    brighter = 0
    labelled = 0
    for _ in range(40):
        image, label, decoy = pool.draw(rng)
        assert label is None or decoy is None
        if label is None:
            continue
        labelled += 1
        x = int((label.collar[0] + label.orifice[0]) / 2)
        y = int((label.collar[1] + label.orifice[1]) / 2)
        aside = int(4 * label.radius)
        row = image[y].astype(float).mean(axis=-1)
        beside = row[[max(0, x - aside), min(len(row) - 1, x + aside)]].mean()
        brighter += row[x] > beside + 20
    assert labelled > 15
    assert brighter >= 0.8 * labelled


def test_the_same_state_draws_the_same_frame(dataset: Path) -> None:
    pool = FramePool(read_frames(dataset))
    first, second = (pool.draw(np.random.default_rng(5)) for _ in range(2))
    assert (first[0] == second[0]).all()


def test_a_whole_row_is_taken_out(tmp_path: Path) -> None:
    """Where only the labelled tip went, the others would be taught as none."""
    frames = run_of(tmp_path, [60, 60, 150, 150, 60, 60, 190, 190, 60, 60, 230, 230])
    for number, frame in enumerate(frames):
        image = cv2.imread(str(frame.path))
        assert frame.label is not None
        x = int(frame.label.collar[0]) + 20
        image[60:140, x - 5 : x + 5] = 220
        cv2.imwrite(str(frame.path), image)
        beside = TipLabel((float(x), 60.0), (float(x), 140.0), 5.0)
        frames[number] = replace(frame, label=replace(frame.label, beside=(beside,)))
    pool, rng, stands_out = FramePool(frames), np.random.default_rng(0), []
    for _ in range(60):
        image, label, missing = pool.draw(rng)
        if label is None and missing is not None:
            (tip,) = missing.beside
            x, y = (int((a + b) / 2) for a, b in zip(tip.collar, tip.orifice, strict=True))
            if 0 <= x < image.shape[1] and 0 <= y < image.shape[0]:
                aside = min(image.shape[1] - 1, x + int(2 * tip.radius))
                stands_out.append(abs(float(image[y, x].mean()) - float(image[y, aside].mean())))
    assert len(stands_out) > 5
    assert np.quantile(stands_out, 0.8) < 25


def run_of(folder: Path, places: list[int]) -> list[RecordedFrame]:
    """Frames of one plate, a bright tip at each place before a grey room."""
    frames = []
    for number, x in enumerate(places):
        image = np.full((240, 320, 3), 60, np.uint8)
        image[60:140, x - 5 : x + 5] = 220
        path = folder / f"{number}.png"
        cv2.imwrite(str(path), image)
        label = TipLabel((float(x), 60.0), (float(x), 140.0), 5.0)
        frames.append(RecordedFrame(path, "set/plate", label, (x - 5.0, 60.0, 10.0, 80.0)))
    return frames


def test_a_missing_tip_leaves_an_empty_room(tmp_path: Path) -> None:
    """Every second pair of frames is at the source, as in a run."""
    pool = FramePool(run_of(tmp_path, [60, 60, 150, 150, 60, 60, 190, 190, 60, 60, 230, 230]))
    rng, stands_out = np.random.default_rng(0), []
    for _ in range(60):
        image, label, missing = pool.draw(rng)
        if label is None and missing is not None:
            x, y = (int((a + b) / 2) for a, b in zip(missing.collar, missing.orifice, strict=True))
            wide = int(2 * missing.radius)
            row = image[y].mean(axis=-1)
            beside = row[[max(0, x - wide), min(len(row) - 1, x + wide)]].mean()
            stands_out.append(abs(row[x] - beside))
    assert len(stands_out) > 5
    assert np.quantile(stands_out, 0.8) < 25  # the tip itself stands out by 160


@pytest.mark.parametrize("places", [[60, 60, 70, 70] * 3, [60, 60, 150, 60, 190, 60, 230]])
def test_where_the_pipette_hardly_moves_no_room_is_known(tmp_path: Path, places: list[int]) -> None:
    pool = FramePool(run_of(tmp_path, places))
    rng = np.random.default_rng(0)
    assert all(pool.draw(rng)[1] is not None for _ in range(40))
