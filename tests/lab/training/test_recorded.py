"""Data sets as training material."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aegis_ot.errors import DatasetError
from aegis_ot_lab.training.recorded import read_frames


def test_without_a_camera_the_axis_is_the_centre_line(dataset: Path) -> None:
    frames = read_frames(dataset)
    assert len(frames) == 16
    assert frames[0].label is not None
    assert frames[0].label.collar == (60.0, 60.0)
    assert frames[0].label.orifice == (60.0, 140.0)
    assert frames[-1].label is None
    assert frames[-1].box is None
    assert {frame.plate.split("/")[1] for frame in frames} == {"plate0", "plate1"}


def write_axes(dataset: Path, *rows: str) -> None:
    lines = ("frame,collar_x,collar_y,orifice_x,orifice_y", *rows, "")
    (dataset / "axes.csv").write_text("\n".join(lines))


def test_an_axis_that_the_set_gives_is_the_label(dataset: Path) -> None:
    write_axes(dataset, "frames/w0_aspirate.png,61,60,58.5,140")
    first, second, *_ = read_frames(dataset)
    assert first.label is not None
    assert second.label is not None
    assert (first.label.collar, first.label.orifice) == ((61.0, 60.0), (58.5, 140.0))
    assert first.label.radius == 4.0  # the collar reaches the box's right side, 65
    assert second.label.collar == (100.0, 60.0)


def test_the_tips_beside_it_are_labelled_too(dataset: Path) -> None:
    write_axes(
        dataset, "frames/w0_aspirate.png,60,60,60,140", "frames/w0_aspirate.png,80,61,80,141"
    )
    label = read_frames(dataset)[0].label
    assert label is not None
    assert [(tip.collar, tip.orifice) for tip in label.beside] == [((80.0, 61.0), (80.0, 141.0))]


def test_the_tip_of_the_box_comes_first_whatever_the_order(dataset: Path) -> None:
    write_axes(
        dataset, "frames/w0_aspirate.png,80,61,80,141", "frames/w0_aspirate.png, 60,60,60,140"
    )
    label = read_frames(dataset)[0].label
    assert label is not None
    assert label.collar == (60.0, 60.0)
    assert [tip.collar for tip in label.beside] == [(80.0, 61.0)]


@pytest.mark.parametrize(
    ("row", "said"),
    [
        ("frames/w0_aspirate.png,61,,58.5,140", "'61, , 58.5, 140' are not four numbers"),
        ("frames/w0_aspirate.png,61,nan,58.5,140", "'61, nan, 58.5, 140' are not four numbers"),
        ("frames/w3_transit.png,1,2,3,4", "column frame: 'frames/w3_transit.png' has no box"),
        ("frames/w9.png,61,60,58.5,140", "column frame: 'frames/w9.png' has no box in boxes.csv"),
    ],
)
def test_a_bad_axis_is_named(dataset: Path, row: str, said: str) -> None:
    write_axes(dataset, row)
    with pytest.raises(DatasetError) as caught:
        read_frames(dataset)
    assert f"axes.csv row 2{',' if 'column' in said else ':'} {said}" in str(caught.value)


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
