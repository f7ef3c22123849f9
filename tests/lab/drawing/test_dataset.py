"""Synthetic sets in the data set format, and frames for training."""

from __future__ import annotations

import csv
import itertools
import json
from collections import Counter
from pathlib import Path

import cv2
import numpy as np
import pytest

from aegis_ot.errors import AegisError, ConfigurationError
from aegis_ot.vision.dataset import load_dataset
from aegis_ot.vocabulary import KeyframeKind
from aegis_ot_lab.drawing import random_frames, write_dataset
from aegis_ot_lab.drawing.plans import contents_of, paper_plan


def test_the_paper_shape() -> None:
    plan = paper_plan()
    kinds = Counter(well.failure or "normal" for well in plan)
    assert kinds.pop("normal") == 26
    assert kinds.pop("no_tip") == 2
    assert sum(kinds.values()) == 36
    assert [kinds[f"partial_{p}"] for p in (25, 50, 75)] == [3, 3, 3]
    assert kinds["partial_single"] + kinds["partial_accumulated"] == 15
    assert kinds["no_dispense"] == kinds["air_bubble"] == 6
    failures = [well for well in plan if well.failure not in ("", "no_tip")]
    assert set(Counter(well.reagent for well in failures).values()) == {12}
    firsts = {well.plate: well.failure for well in reversed(plan)}
    assert firsts == dict.fromkeys(range(16), "")
    reagents = {(well.plate, well.reagent) for well in plan}
    assert len(reagents) == 16


@pytest.mark.parametrize("plates", [1, 2, 5, 32])
def test_other_sizes_keep_the_proportions(plates: int) -> None:
    plan = paper_plan(plates)
    assert {well.plate for well in plan} == set(range(plates))
    assert all(
        next(well for well in plan if well.plate == plate).failure == "" for plate in range(plates)
    )
    failures = sum(bool(well.failure) and well.failure != "no_tip" for well in plan)
    assert failures == pytest.approx(36 * plates / 16, abs=4)


def test_no_plates_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match="at least one plate"):
        write_dataset(tmp_path / "set", plates=0)


def test_a_written_set_is_read_back_and_says_synthetic(tmp_path: Path) -> None:
    folder = write_dataset(tmp_path / "set", plates=2, seed=3, pipette="p300")
    meta = json.loads((folder / "meta.json").read_text())
    assert meta["source"] == "synthetic"
    rows = list(csv.DictReader((folder / "manifest.csv").open()))
    boxes = {row["frame"]: row for row in csv.DictReader((folder / "boxes.csv").open())}
    assert len(boxes) == 4 * len(rows)
    for row in rows:
        for kind in KeyframeKind:
            image = cv2.imread(str(folder / row[kind.value]))
            assert image.shape == (480, 640, 3)
            assert (boxes[row[kind.value]]["x"] == "") == (row["failure_type"] == "no_tip")
    data = load_dataset(folder)
    assert data.source == "synthetic"
    assert len(data.records) == len(rows)
    with pytest.raises(AegisError, match="already"):
        write_dataset(folder, plates=1)


def test_a_set_is_the_same_for_the_same_seed(tmp_path: Path) -> None:
    a, b, c = (
        write_dataset(tmp_path / name, plates=1, seed=seed, pipette="p20")
        for name, seed in (("a", 1), ("b", 1), ("c", 2))
    )
    for path in sorted((a / "frames").iterdir()):
        assert path.read_bytes() == (b / "frames" / path.name).read_bytes()
    assert (a / "manifest.csv").read_text() == (b / "manifest.csv").read_text()
    name = "frames/p00_A1_aspirate.jpg"
    assert (a / name).read_bytes() != (c / name).read_bytes()


@pytest.mark.parametrize(
    ("failure", "kept"),
    [("partial_25", 0.75), ("partial_75", 0.25), ("no_dispense", 1.0), ("", None)],
)
def test_contents_match_their_label(failure: str, kept: float | None) -> None:
    states, retained = contents_of(failure, 200.0, np.random.default_rng(0))
    assert retained == kept
    assert states[KeyframeKind.ASPIRATE].liquid_ul == 200.0
    assert states[KeyframeKind.POST_DISPENSE].liquid_ul == 200.0 * (kept or 0.0)


def test_an_accumulated_partial_holds_more_than_was_commanded() -> None:
    states, retained = contents_of("partial_accumulated", 200.0, np.random.default_rng(0))
    assert states[KeyframeKind.ASPIRATE].liquid_ul > 200.0
    assert retained is not None
    assert states[KeyframeKind.DISPENSE].liquid_ul == pytest.approx(retained * 200.0)


def test_random_frames_vary_and_carry_their_truth() -> None:
    pairs = list(itertools.islice(random_frames(5, sizes=((640, 480),)), 48))
    again = list(itertools.islice(random_frames(5, sizes=((640, 480),)), 3))
    assert all(np.array_equal(a[0], b[0]) for a, b in zip(pairs, again, strict=False))
    without = sum(truth.box is None for _, truth in pairs)
    assert 1 <= without <= 16
    centres = [t.box[0] + t.box[2] / 2 for _, t in pairs if t.box is not None]
    assert np.std(centres) > 60
    assert len({truth.dye for _, truth in pairs}) > 4
    levels = [float(image.mean()) for image, _ in pairs]
    assert np.std(levels) > 15
