"""Trajectory data sets on disk: the format of ``docs/reference/dataset.md``.

A data set is checked whole before anything is computed from it: every fault is reported with
its file, row and column in one :class:`~aegis_ot.errors.DatasetError`. Frames are decoded when
they are asked for, so that a large set does not have to fit in memory.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from ..errors import DatasetError
from ..vocabulary import KeyframeKind
from .dataset_checks import COLUMNS, Record, read_boxes, read_manifest, read_positions
from .tables import Problems
from .types import Detector, Image, Position, TipDetection, TrajectorySample

__all__ = ["COLUMNS", "Dataset", "Record", "TrueBoxes", "load_dataset"]

SOURCES = ("rendered", "synthetic", "real")


class LazyFrames(Mapping[KeyframeKind, Image]):
    """The four frames of one trajectory, decoded on each access and not kept.

    Raises :class:`DatasetError` if a frame has become unreadable since the set was checked.
    """

    def __init__(self, root: Path, paths: Mapping[KeyframeKind, str]) -> None:
        self._root, self._paths = root, paths

    def __getitem__(self, kind: KeyframeKind) -> Image:
        path = self._root / self._paths[kind]
        image = cv2.imread(str(path), cv2.IMREAD_COLOR)
        if image is None:
            raise DatasetError(f"{path}: the frame can no longer be read; check the data set")
        return np.asarray(image, dtype=np.uint8)

    def __iter__(self) -> Iterator[KeyframeKind]:
        return iter(self._paths)

    def __len__(self) -> int:
        return len(self._paths)


class LazyDetections(Mapping[KeyframeKind, TipDetection | None]):
    """The tip in each frame, found on first access and then kept."""

    def __init__(
        self,
        frames: Mapping[KeyframeKind, Image],
        paths: Mapping[KeyframeKind, str],
        detector: Detector | TrueBoxes,
    ) -> None:
        self._frames, self._paths, self._detector = frames, paths, detector
        self._found: dict[KeyframeKind, TipDetection | None] = {}

    def __getitem__(self, kind: KeyframeKind) -> TipDetection | None:
        if kind not in self._found:
            if isinstance(self._detector, TrueBoxes):
                self._found[kind] = self._detector.box(self._paths[kind])
            else:
                self._found[kind] = self._detector.detect(self._frames[kind])
        return self._found[kind]

    def __iter__(self) -> Iterator[KeyframeKind]:
        return iter(self._paths)

    def __len__(self) -> int:
        return len(self._paths)


class TrueBoxes:
    """The boxes of ``boxes.csv`` in a detector's place.

    A box has no axis: the axis is taken through the middle of its lower and upper edges, which
    is off by up to half the box's width for a tip that leans.
    """

    name = "true boxes"

    def __init__(self, boxes: Mapping[str, tuple[float, float, float, float] | None]) -> None:
        self._boxes = boxes

    def box(self, frame: str) -> TipDetection | None:
        """The labelled tip in ``frame`` (path relative to the data set), or ``None``.

        Raises:
            DatasetError: If the frame has no row in ``boxes.csv``.
        """
        try:
            box = self._boxes[frame]
        except KeyError:
            raise DatasetError(
                f"boxes.csv has no row for {frame!r}: true boxes cannot be used for it; "
                "add the row, or evaluate with the detector"
            ) from None
        if box is None:
            return None
        x, y, w, h = box
        middle = x + w / 2
        return TipDetection(x, y, w, h, 1.0, orifice=(middle, y + h), collar=(middle, y))


@dataclass(frozen=True)
class Dataset:
    """A checked data set.

    Attributes:
        root: Its folder.
        records: One per trajectory, in the order in which the wells were pipetted.
        boxes: Labelled boxes by frame (x, y, w, h, px; ``None``: no tip); empty without a file.
        meta: Content of ``meta.json``.
        warnings: What is odd without being wrong (boxes of frames that no row names, ...).
        positions: End of the tip on the deck, mm, by trajectory and keyframe; empty without a file.
    """

    root: Path
    records: tuple[Record, ...]
    boxes: Mapping[str, tuple[float, float, float, float] | None] = field(repr=False)
    meta: Mapping[str, Any] = field(repr=False)
    warnings: tuple[str, ...] = ()
    positions: Mapping[str, Mapping[KeyframeKind, Position]] = field(
        default_factory=dict, repr=False
    )

    @property
    def name(self) -> str:
        return self.root.resolve().name

    @property
    def source(self) -> str:
        """``"rendered"``, ``"synthetic"``, ``"real"``, or ``"of unstated origin"``.

        Every figure printed from this set carries this word.
        """
        return str(self.meta.get("source") or "of unstated origin")

    @property
    def plates(self) -> tuple[str, ...]:
        """Names of the plates in order of appearance."""
        return tuple(dict.fromkeys(record.plate for record in self.records))

    @property
    def cameras(self) -> Mapping[str, str]:
        """Kind of camera by plate, as ``meta.json`` names them; empty where it does not."""
        return dict(self.meta.get("cameras") or {})

    def true_boxes(self) -> TrueBoxes:
        """The labelled boxes as a detector.

        Raises:
            DatasetError: If the set has no ``boxes.csv``.
        """
        if not self.boxes:
            raise DatasetError(f"{self.root / 'boxes.csv'} is missing: there are no true boxes")
        return TrueBoxes(self.boxes)

    def samples(self, detector: Detector | TrueBoxes) -> list[TrajectorySample]:
        """All trajectories, with frames and detections computed when they are asked for."""
        return [self.sample(record, detector) for record in self.records]

    def sample(self, record: Record, detector: Detector | TrueBoxes) -> TrajectorySample:
        """One trajectory of this set as the vision room sees it."""
        frames = LazyFrames(self.root, record.frames)
        return TrajectorySample(
            id=record.id,
            plate=record.plate,
            well=record.well,
            pipette=record.pipette,
            volume_ul=record.volume_ul,
            frames=frames,
            detections=LazyDetections(frames, record.frames, detector),
            expected_ul=expected_volumes(record.volume_ul),
            reagent=record.reagent,
            label=record.label,
            failure_type=record.failure_type,
            retained_fraction=record.retained_fraction,
            capacity_ul=(self.meta.get("tips_ul") or {}).get(record.id),
            tip_used=(self.meta.get("tips_used") or {}).get(record.id, ""),
            positions=self.positions.get(record.id, {}),
        )


def expected_volumes(volume_ul: float) -> dict[KeyframeKind, float]:
    """Liquid in the tip at each keyframe of a plain transfer of ``volume_ul``, µL."""
    return {
        KeyframeKind.ASPIRATE: volume_ul,
        KeyframeKind.TRANSIT: volume_ul,
        KeyframeKind.DISPENSE: 0.0,
        KeyframeKind.POST_DISPENSE: 0.0,
    }


def load_dataset(folder: str | Path) -> Dataset:
    """Read and check the data set in ``folder``.

    Raises:
        DatasetError: With one line for every fault in the manifest, the boxes, the frames and
            ``meta.json``.
    """
    root = Path(folder)
    if not root.is_dir():
        raise DatasetError(f"{root}: there is no such folder; name the folder of a data set")
    problems = Problems()
    records = read_manifest(root, problems)
    boxes, warnings = read_boxes(root, records, problems)
    positions, odd = read_positions(root, records, problems)
    meta = _read_meta(root, problems)
    if problems:
        raise DatasetError(problems.text(root))
    warnings += [*odd, *_strangers(meta, records)]
    return Dataset(root, tuple(records), boxes, meta, tuple(warnings), positions)


def _strangers(meta: Mapping[str, Any], records: Sequence[Record]) -> list[str]:
    """What ``meta.json`` says of plates and trajectories that the manifest does not have."""
    wells = {record.id for record in records}
    known = {"cameras": {r.plate for r in records}, "tips_ul": wells, "tips_used": wells}
    found = {key: [n for n in meta.get(key) or () if n not in known[key]] for key in known}
    return [
        f"meta.json, {key}: {', '.join(map(repr, names[:5]))} is in no row of manifest.csv"
        for key, names in found.items()
        if names
    ]


def _read_meta(root: Path, problems: Problems) -> dict[str, Any]:
    path = root / "meta.json"
    if not path.exists():
        return {}
    try:
        meta = json.loads(path.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError, RecursionError) as error:
        problems.add("meta.json", None, None, f"is not readable JSON ({error})")
        return {}
    if not isinstance(meta, dict):
        problems.add("meta.json", None, None, "must hold one JSON object")
        return {}
    source = meta.get("source")
    if source is not None and source not in SOURCES:
        problems.add(
            "meta.json", None, "source", f"is {source!r}; it must be one of {', '.join(SOURCES)}"
        )
    tips = meta.get("tips_ul") or {}
    if not isinstance(tips, dict) or not all(
        isinstance(volume, (int, float)) and volume > 0 for volume in tips.values()
    ):
        problems.add("meta.json", None, "tips_ul", "must hold a tip's volume, µL, by trajectory_id")
    for key, said in (
        ("cameras", "must name a kind of camera for each plate"),
        ("tips_used", "must name the tip that served it by trajectory_id"),
    ):
        named = meta.get(key)
        if named is not None and not (
            isinstance(named, dict) and all(isinstance(name, str) for name in named.values())
        ):
            problems.add("meta.json", None, key, said)
    return meta


def first_normals(samples: Sequence[TrajectorySample]) -> dict[str, TrajectorySample]:
    """Each plate's first normal trajectory: its calibration well."""
    first: dict[str, TrajectorySample] = {}
    for sample in samples:
        if sample.label == "normal":
            first.setdefault(sample.plate, sample)
    return first
