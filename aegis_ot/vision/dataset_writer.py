"""Writing data sets: recorded runs and synthetic trajectories in the same format."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import cv2

from ..errors import DatasetError
from ..vocabulary import KeyframeKind, csv_cell
from .dataset_checks import AXIS_COLUMNS, BOX_COLUMNS, COLUMNS, POSITION_COLUMNS
from .types import TipDetection, TrajectorySample


class DatasetWriter:
    """Writes one data set; use it as a context manager.

    Example::

        with DatasetWriter(folder, {"source": "real", "camera": "c920"}) as writer:
            writer.add(sample, jpegs={kind: data, ...})

    Args:
        folder: New or empty folder.
        meta: Content of ``meta.json``; say the source there.

    Raises:
        DatasetError: If the folder holds a manifest already: nothing is overwritten.
    """

    def __init__(self, folder: str | Path, meta: Mapping[str, Any]) -> None:
        self.root = Path(folder)
        if (self.root / "manifest.csv").exists():
            raise DatasetError(f"{self.root} holds a data set already; name another folder")
        (self.root / "frames").mkdir(parents=True, exist_ok=True)
        text = json.dumps(dict(meta), indent=1, ensure_ascii=False)
        (self.root / "meta.json").write_text(text + "\n", encoding="utf-8")
        self._ids: set[str] = set()
        self._manifest = (self.root / "manifest.csv").open("w", newline="", encoding="utf-8")
        self._boxes = (self.root / "boxes.csv").open("w", newline="", encoding="utf-8")
        self._axes = (self.root / "axes.csv").open("w", newline="", encoding="utf-8")
        self._rows = csv.writer(self._manifest, lineterminator="\n")
        self._box_rows = csv.writer(self._boxes, lineterminator="\n")
        self._axis_rows = csv.writer(self._axes, lineterminator="\n")
        self._rows.writerow(COLUMNS)
        self._box_rows.writerow(BOX_COLUMNS)
        self._axis_rows.writerow(AXIS_COLUMNS)
        self._positions = (self.root / "positions.csv").open("w", newline="", encoding="utf-8")
        self._position_rows = csv.writer(self._positions, lineterminator="\n")
        self._position_rows.writerow(POSITION_COLUMNS)

    def __enter__(self) -> DatasetWriter:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        self._manifest.close()
        self._boxes.close()
        self._axes.close()
        self._positions.close()

    def add(
        self,
        sample: TrajectorySample,
        jpegs: Mapping[KeyframeKind, bytes] | None = None,
        beside: Mapping[KeyframeKind, Sequence[TipDetection]] | None = None,
    ) -> None:
        """Append one trajectory.

        Args:
            sample: A missing label is written as ``normal`` only if the sample says so.
            jpegs: The frames as the camera gave them; without, frames are encoded at quality 95.
            beside: The other tips of a row; their axes are written.

        Raises:
            DatasetError: If the id was written before, the label is missing, or a frame is.
        """
        if sample.id in self._ids:
            raise DatasetError(f"trajectory {sample.id!r} was written already")
        if sample.label not in ("normal", "failure"):
            raise DatasetError(
                f"trajectory {sample.id!r} has no label; say whether it is normal or a failure"
            )
        lacking = [kind.value for kind in KeyframeKind if kind not in sample.frames]
        if lacking:
            raise DatasetError(f"trajectory {sample.id!r} lacks the frames {', '.join(lacking)}")
        self._ids.add(sample.id)
        stem = re.sub(r"[^A-Za-z0-9_-]+", "_", sample.id) or "trajectory"
        paths = {}
        for kind in KeyframeKind:
            path = self._free_path(f"{stem}_{kind.value}")
            data = jpegs.get(kind) if jpegs else None
            if data is None:
                ok, encoded = cv2.imencode(".jpg", sample.frames[kind], [1, 95])
                if not ok:
                    raise DatasetError(f"trajectory {sample.id!r}: {kind.value} cannot be encoded")
                data = encoded.tobytes()
            (self.root / path).write_bytes(data)
            paths[kind] = path
            self._add_tips(
                path, sample.detections.get(kind), beside.get(kind, ()) if beside else ()
            )
        for kind, place in sample.positions.items():
            row = (csv_cell(sample.id), kind.value, *(f"{value:.3f}" for value in place))
            self._position_rows.writerow(row)
        retained = sample.retained_fraction
        self._rows.writerow(
            csv_cell(value)
            for value in (
                sample.id,
                sample.plate,
                sample.well,
                sample.pipette,
                sample.reagent,
                sample.label,
                sample.failure_type,
                "" if retained is None else f"{retained:g}",
                f"{sample.volume_ul:g}",
                *(paths[kind] for kind in KeyframeKind),
            )
        )

    def _add_tips(
        self, frame: str, tip: TipDetection | None, beside: Sequence[TipDetection]
    ) -> None:
        box = [f"{v:.1f}" for v in (tip.x, tip.y, tip.w, tip.h)] if tip else [""] * 4
        self._box_rows.writerow([frame, *box])
        for each in (tip, *beside) if tip else ():
            self._axis_rows.writerow([frame, *(f"{v:.2f}" for v in (*each.collar, *each.orifice))])

    def _free_path(self, stem: str) -> str:
        path, number = f"frames/{stem}.jpg", 1
        while (self.root / path).exists():
            number += 1
            path = f"frames/{stem}-{number}.jpg"
        return path
