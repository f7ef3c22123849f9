"""Reading data sets: everything wrong is named at once; what is written is read back."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from aegis_ot.errors import DatasetError
from aegis_ot.vision.dataset import TrueBoxes, load_dataset
from aegis_ot.vision.dataset_checks import in_data_sets
from aegis_ot.vision.dataset_writer import DatasetWriter
from aegis_ot.vision.tips import tip_for
from aegis_ot.vocabulary import KeyframeKind

from .samples import sample


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    with DatasetWriter(tmp_path / "set", {"source": "synthetic"}) as writer:
        for plate in ("p1", "p2"):
            writer.add(sample(f"{plate}-a", plate=plate))
            writer.add(sample(f"{plate}-b", plate=plate, failure="no_dispense", left=0.5))
        writer.add(sample("p2-c", plate="p2", tip=False, failure="no_tip"))
    return tmp_path / "set"


def edit(path: Path, row: int, column: str, value: str) -> None:
    """Change one cell; ``row`` counts lines of the file, the header is 1."""
    rows = list(csv.reader(path.open(newline="")))
    rows[row - 1][rows[0].index(column)] = value
    with path.open("w", newline="") as file:
        csv.writer(file).writerows(rows)


def test_what_is_written_is_read_back(folder: Path) -> None:
    data = load_dataset(folder)
    assert data.source == "synthetic"
    assert data.plates == ("p1", "p2")
    assert [record.id for record in data.records] == ["p1-a", "p1-b", "p2-a", "p2-b", "p2-c"]
    first, *_, last = data.samples(data.true_boxes())
    assert first.frames[KeyframeKind.TRANSIT].shape == (160, 120, 3)
    found = first.detections[KeyframeKind.TRANSIT]
    assert found is not None
    assert (found.x, found.y, found.w, found.h) == (50, 28, 20, 104)
    assert last.detections[KeyframeKind.TRANSIT] is None
    assert first.expected_ul[KeyframeKind.POST_DISPENSE] == 0


def test_every_fault_is_named_by_row_and_column_in_one_pass(folder: Path) -> None:
    manifest = folder / "manifest.csv"
    edit(manifest, 2, "label", "good")
    edit(manifest, 3, "failure_type", "exploded")
    edit(manifest, 4, "trajectory_id", "p1-a")
    edit(manifest, 4, "volume_ul", "-5")
    edit(manifest, 5, "aspirate", "frames/none.jpg")
    edit(manifest, 6, "transit", "../../secret.jpg")
    (folder / "frames" / "p2-b_transit.jpg").write_bytes(b"no image")
    edit(folder / "boxes.csv", 2, "w", "0")
    with pytest.raises(DatasetError) as caught:
        load_dataset(folder)
    text = str(caught.value)
    for part in (
        "row 2, column label: 'good'",
        "row 3, column failure_type: 'exploded'",
        "row 4, column trajectory_id: 'p1-a' stands in row 2",
        "row 4, column volume_ul",
        "row 5, column aspirate: 'frames/none.jpg' does not exist",
        "row 5, column transit: 'frames/p2-b_transit.jpg' is neither JPEG nor PNG",
        "row 6, column transit: '../../secret.jpg' must be a path inside",
        "row 2, column plate: 'p1' has no normal row",
        "boxes.csv, row 2, column w",
    ):
        assert part in text


@pytest.mark.parametrize(
    ("damage", "told"),
    [
        (lambda f: (f / "manifest.csv").unlink(), "manifest.csv: is missing"),
        (lambda f: (f / "manifest.csv").write_text(""), "manifest.csv: is empty"),
        (lambda f: (f / "manifest.csv").write_bytes(b"\xff\xfe\x00x"), "cannot be read as UTF-8"),
        (lambda f: (f / "meta.json").write_text("{"), "meta.json: is not readable JSON"),
        (lambda f: (f / "meta.json").write_text('{"source": "dreamt"}'), "'dreamt'"),
        (
            lambda f: (f / "meta.json").write_text('{"tips_used": ["A1"]}'),
            "meta.json, column tips_used: must name the tip that served it by trajectory_id",
        ),
    ],
)
def test_broken_files_are_reported(folder: Path, damage, told: str) -> None:
    damage(folder)
    with pytest.raises(DatasetError, match="fault") as caught:
        load_dataset(folder)
    assert told in str(caught.value)


def test_a_truncated_jpeg_does_not_pass_as_an_image(folder: Path) -> None:
    path = folder / "frames" / "p1-a_transit.jpg"
    path.write_bytes(path.read_bytes()[:-200])
    with pytest.raises(DatasetError, match="truncated"):
        load_dataset(folder)


def test_a_header_with_another_order_is_refused(folder: Path) -> None:
    path = folder / "manifest.csv"
    text = path.read_text()
    path.write_text(text.replace("trajectory_id,plate", "plate,trajectory_id", 1))
    with pytest.raises(DatasetError, match="order"):
        load_dataset(folder)


def test_nothing_is_overwritten_and_no_label_is_invented(folder: Path, tmp_path: Path) -> None:
    with pytest.raises(DatasetError, match="already"):
        DatasetWriter(folder, {})
    unlabelled = sample("x")
    object.__setattr__(unlabelled, "label", "")
    with (
        DatasetWriter(tmp_path / "new", {}) as writer,
        pytest.raises(DatasetError, match="no label"),
    ):
        writer.add(unlabelled)


def test_images_round_trip_within_jpeg_noise(folder: Path) -> None:
    data = load_dataset(folder)
    read = data.samples(data.true_boxes())[0].frames[KeyframeKind.TRANSIT]
    written = sample("p1-a").frames[KeyframeKind.TRANSIT]
    assert np.abs(read.astype(int) - written.astype(int)).mean() < 4


def test_data_sets_keep_the_robot_whose_tips_differ() -> None:
    assert in_data_sets("p300_single_gen2") == "p300"
    assert in_data_sets("flex_1channel_1000") == "flex_1channel_1000"
    assert in_data_sets("p1000_single_flex") == "p1000_single_flex"
    for name in ("p10_single", "p50_single", "p50_multi", "p300_multi_gen2", "flex_96channel_1000"):
        assert tip_for(in_data_sets(name)) is tip_for(name)


def test_the_tip_that_served_several_wells_is_read(folder: Path) -> None:
    (folder / "meta.json").write_text('{"tips_used": {"p1-a": "box A1", "p1-z": "box A2"}}')
    data = load_dataset(folder)
    assert [record.tip_used for record in data.samples(TrueBoxes({}))][:2] == ["box A1", ""]
    assert data.warnings == ("meta.json, tips_used: 'p1-z' is in no row of manifest.csv",)


def test_cameras_of_unknown_plates_are_named(folder: Path) -> None:
    (folder / "meta.json").write_text('{"cameras": {"p1": "webcam", "plate7": "phone"}}')
    assert load_dataset(folder).warnings == (
        "meta.json, cameras: 'plate7' is in no row of manifest.csv",
    )


def test_the_axis_of_every_tip_of_a_row_is_written(tmp_path: Path) -> None:
    one = sample("a")
    tips = {kind: (tip,) for kind, tip in one.detections.items() if tip is not None}
    with DatasetWriter(tmp_path / "rows", {}) as writer:
        writer.add(one, beside=tips)
    rows = list(csv.DictReader((tmp_path / "rows" / "axes.csv").open()))
    assert [row["frame"] for row in rows[:3]] == ["frames/a_aspirate.jpg"] * 2 + [
        "frames/a_transit.jpg"
    ]
    assert (rows[0]["collar_x"], rows[0]["orifice_y"]) == ("60.00", "131.00")


def test_positions_are_written_and_read_back(tmp_path: Path) -> None:
    places = {KeyframeKind.TRANSIT: (132.5, 90.25, 61.0), KeyframeKind.ASPIRATE: (0.0, -3.5, 12.0)}
    with DatasetWriter(tmp_path / "set", {}) as writer:
        writer.add(replace(sample("a", plate="p"), positions=places))
        writer.add(sample("b", plate="p"))
    first, second = load_dataset(tmp_path / "set").samples(TrueBoxes({}))
    assert first.positions == places
    assert second.positions == {}


def test_faults_of_positions_are_named(folder: Path) -> None:
    rows = ["trajectory_id,keyframe,x,y,z", "p1-a,transit,1,2,3", "p1-a,transit,1,2,3"]
    rows += ["nobody,transit,1,2,3", "p1-b,landing,1,2,3", "p1-b,transit,1,far,3"]
    (folder / "positions.csv").write_text("\n".join(rows) + "\n")
    with pytest.raises(DatasetError) as error:
        load_dataset(folder)
    for told in (
        "row 3, column keyframe: 'transit' of 'p1-a' stands in an earlier row already",
        "row 5, column keyframe: 'landing' must be one of",
        "row 6, column y: 'far'",
    ):
        assert told in str(error.value)


def test_positions_of_unknown_trajectories_are_counted(folder: Path) -> None:
    rows = ["trajectory_id,keyframe,x,y,z", "p1-a,transit,1,2,3"]
    rows += ["nobody,transit,1,2,3", "p1-A,transit,1,2,3"]
    (folder / "positions.csv").write_text("\n".join(rows) + "\n")
    (told,) = (each for each in load_dataset(folder).warnings if "positions.csv" in each)
    assert "2 rows name trajectories" in told


@pytest.mark.parametrize("place", [9, 13])
def test_a_frame_of_the_empty_tip_may_stand_anywhere(folder: Path, place: int) -> None:
    before = load_dataset(folder)
    manifest, frame = folder / "manifest.csv", folder / "frames" / "a_ready.jpg"
    frame.write_bytes((folder / before.records[0].frames[KeyframeKind.TRANSIT]).read_bytes())
    rows = [line.split(",") for line in manifest.read_text().splitlines()]
    for row, cell in zip(rows, ["ready", "frames/a_ready.jpg", *[""] * len(rows)], strict=False):
        row.insert(place, cell)
    manifest.write_text("\n".join(",".join(row) for row in rows) + "\n")
    with (folder / "boxes.csv").open("a") as boxes:
        boxes.write("frames/a_ready.jpg,1,2,3,4\n")
    found = load_dataset(folder)
    assert [replace(one, ready="") for one in found.records] == list(before.records)
    assert found.records[0].ready == "frames/a_ready.jpg"
    assert found.warnings == before.warnings

    frame.unlink()
    with pytest.raises(DatasetError, match=r"column ready: .*a_ready.jpg. does not exist"):
        load_dataset(folder)
