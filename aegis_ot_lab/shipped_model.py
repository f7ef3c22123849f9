"""The world model that ships with the package, and the command that makes it anew.

``python -m aegis_ot_lab.shipped_model [OUT.npz]`` renders the simulated normal wells,
fits the ensemble on them and writes the model file. It is fitted on simulated frames only: a lab
that has recorded normal runs of its own does better with ``aegis-ot fit``.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from aegis_ot.vision.models import SHIPPED, ModelFile
from aegis_ot.worldmodel.fitting import fit_model

from .drawing import write_dataset

SETS = (
    ("p20", (960, 540), 72001),
    ("p20", (1280, 720), 72002),
    ("p300", (640, 480), 72003),
    ("p300", (960, 540), 72004),
    ("p300", (1280, 720), 72005),
    ("p1000", (640, 480), 72006),
    ("p1000", (960, 540), 72007),
)
"""Pipette, frame size (px) and seed of each set. The seeds serve nothing else."""

PLATES = 16
WELLS = 3
"""Sessions (camera, lamp, deck, volume) of a set, and normal wells of each."""


def make_shipped_model(path: str | Path = SHIPPED) -> ModelFile:
    """Fit the shipped model (about two minutes on one core) and write it.

    Raises:
        ModelError: The file cannot be written.
    """
    with tempfile.TemporaryDirectory() as place:
        folders = [
            write_dataset(
                Path(place) / f"simulated-{pipette}-{width}x{height}",
                PLATES,
                seed,
                pipette,
                size=(width, height),
                normals_per_plate=WELLS,
            )
            for pipette, (width, height), seed in SETS
        ]
        return fit_model(folders, path, "ensemble", measure=False)


if __name__ == "__main__":
    made = make_shipped_model(*sys.argv[1:2])
    sys.stdout.write(f"{made.kind}, SHA-256 {made.checksum}\n")
