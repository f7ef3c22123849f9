"""Data sets as training material."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from aegis_ot.errors import DatasetError
from aegis_ot.training.recorded import FramePool, read_frames


def test_without_a_camera_the_axis_is_the_centre_line(dataset: Path) -> None:
    frames = read_frames(dataset)
    assert len(frames) == 16
    assert frames[0].label is not None
    assert frames[0].label.collar == (60.0, 60.0)
    assert frames[0].label.orifice == (60.0, 140.0)
    assert frames[-1].label is None
    assert frames[-1].box is None
    assert {frame.plate.split("/")[1] for frame in frames} == {"plate0", "plate1"}


def test_a_meta_file_without_cameras_is_no_obstacle(dataset: Path) -> None:
    (dataset / "meta.json").write_text(json.dumps({"source": "real"}))
    assert len(read_frames(dataset)) == 16


def test_every_bad_row_is_listed(dataset: Path) -> None:
    lines = (dataset / "boxes.csv").read_text().splitlines()
    lines[1] = "frames/unknown.png,1,2,3,4"
    lines[2] = lines[2].rsplit(",", 1)[0] + ",tall"
    lines[3] = lines[3].rsplit(",", 1)[0] + ",-5"
    lines[4] = lines[4].rsplit(",", 1)[0] + ",nan"
    (dataset / "frames" / "w1_aspirate.png").unlink()
    (dataset / "boxes.csv").write_text("\n".join(lines))
    with pytest.raises(DatasetError) as caught:
        read_frames(dataset)
    for row in (2, 3, 4, 5, 6):
        assert f"row {row}" in str(caught.value)


def test_a_set_without_boxes_cannot_teach(dataset: Path) -> None:
    (dataset / "boxes.csv").unlink()
    with pytest.raises(DatasetError, match=r"boxes\.csv"):
        read_frames(dataset)


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
