"""Training the tip detector: the same data sets and seed give the same weights."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Sequence
from dataclasses import asdict
from itertools import islice
from pathlib import Path

import cv2
import numpy as np
import torch

from aegis_ot._version import __version__
from aegis_ot.errors import ConfigurationError, DatasetError
from aegis_ot.vision.detection.heatmap import FORMAT, HeatmapDetector, load_weights

from .figures import choose_threshold, measure, read_images
from .fitting import CONTINUING, DetectorSettings, fit, mixed_frames
from .frame_pool import FramePool
from .network import TipNetwork
from .photometry import shows
from .recorded import RecordedFrame, read_frames
from .simulated import SimulatedFrames
from .sources import sources_digest

__all__ = ["DetectorSettings", "train"]

SHIPPED = "shipped"
"""What ``start`` is for the weights that come with the package."""


def export(network: TipNetwork, path: Path) -> None:
    """Write the network as ONNX; batch, height and width stay free."""
    network.eval()
    network.probabilities = True
    path.parent.mkdir(parents=True, exist_ok=True)
    torch.onnx.export(
        network,
        (torch.zeros(1, 224, 384, 3, dtype=torch.uint8),),
        str(path),
        input_names=["image"],
        output_names=["maps"],
        dynamic_axes={
            "image": {0: "n", 1: "height", 2: "width"},
            "maps": {0: "n", 2: "rows", 3: "columns"},
        },
        opset_version=17,
        dynamo=False,
    )


def train(
    datasets: Sequence[str | Path],
    out: str | Path,
    seed: int = 0,
    settings: DetectorSettings | None = None,
    hold_out: Sequence[str] = (),
    progress: Callable[[str], None] | None = None,
    start: str | Path | None = None,
) -> Path:
    """Train a detector and write its weights and their description.

    Args:
        datasets: Trajectory data sets with ``boxes.csv``; none trains on drawn frames alone.
        out: The ``.onnx`` file to write; its description goes beside it as ``.json``.
        seed: Of every random choice.
        settings: How to train.
        hold_out: Plates (as in ``manifest.csv``) that are left out, for measuring.
        progress: Told one line at a time how far it is.
        start: Weights to train on from, or :data:`SHIPPED`; a new network if not given.

    Returns:
        Path of the ``.onnx`` file.

    Raises:
        ModelError: The weights to start from are missing, damaged or of another version.
        ConfigurationError: They are of another network, ``out`` cannot be written, a plate to
            hold out is in no data set, or no plate is left.
        DatasetError: A data set cannot be read, or two have the same name.
    """
    chosen = settings or (DetectorSettings() if start is None else CONTINUING)
    path, held = _output(out), set(hold_out)
    begun, start_sha256 = None, None
    if start is not None:
        weights, described = load_weights(None if start == SHIPPED else start)
        begun, start_sha256 = TipNetwork.exported(weights), described["sha256"]
    by_set = _read(datasets, held)
    learnt = [f for frames in by_set.values() for f in frames if _plate(f) not in held]
    pool = FramePool(learnt) if learnt else None
    network, digest = fit(pool, seed, chosen, progress, begun)
    export(network, path)
    description = {
        "format": FORMAT,
        "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
        "threshold": 0.5 if chosen.threshold is None else chosen.threshold,
        "parameters": sum(p.numel() for p in network.parameters()),
        "seed": seed,
        "start_sha256": start_sha256,
        "settings": asdict(chosen),
        "data": {
            "sets": list(by_set),
            "recorded_frames": len(learnt),
            "held_out_plates": sorted(held),
            "examples_sha256": digest,
        },
        "made_with": {
            "aegis_ot": __version__,
            "sources_sha256": sources_digest(),
            "torch": torch.__version__,
            "numpy": np.__version__,
            "opencv": cv2.__version__,
            "changed_since": [],
        },
    }
    _write(path, description)
    if chosen.threshold is None:
        description["threshold"] = _threshold(HeatmapDetector(path), chosen, seed, pool)
        _write(path, description)
    if held:
        detector = HeatmapDetector(path)
        description["held_out_figures"] = {
            name: asdict(measure(detector, read_images(f for f in frames if _plate(f) in held)))
            for name, frames in by_set.items()
        }
        _write(path, description)
    return path


def _output(out: str | Path) -> Path:
    """The file to write, known to be writable before an hour is spent on it."""
    path = Path(out)
    if path.suffix != ".onnx":
        raise ConfigurationError(f"The detector's file must end in .onnx, not {path.name!r}.")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.with_suffix(".json.part").write_bytes(b"")
        path.with_suffix(".json.part").unlink()
    except OSError as error:
        raise ConfigurationError(f"The detector cannot be written to {out}: {error}") from error
    return path


def _read(datasets: Sequence[str | Path], held: set[str]) -> dict[str, list[RecordedFrame]]:
    by_set: dict[str, list[RecordedFrame]] = {}
    for folder in map(Path, datasets):
        if folder.name in by_set:
            raise DatasetError(
                f"Two data sets are called {folder.name}: rename one of the folders."
            )
        by_set[folder.name] = read_frames(folder)
    plates = {_plate(frame) for frames in by_set.values() for frame in frames}
    if unknown := held - plates:
        raise ConfigurationError(
            f"No data set has the plate {', '.join(sorted(unknown))} that is to be held out. "
            f"The plates are: {', '.join(sorted(plates)) or 'none, for no data set is named'}."
        )
    if plates and plates == held:
        raise ConfigurationError("All plates are held out: none is left to learn from.")
    return by_set


def _threshold(
    detector: HeatmapDetector, settings: DetectorSettings, seed: int, pool: FramePool | None
) -> float:
    """Chosen on frames like those of training, seen by other cameras; never on held-out plates."""
    rng = np.random.default_rng((seed, 1))
    simulated = SimulatedFrames(seed + 1_000_003)
    tips: list[float] = []
    empties: list[float] = []
    frames = mixed_frames(settings, pool, simulated, rng)
    for image, label, decoy in islice(frames, settings.threshold_frames):
        if shows(image, label or decoy):
            guess = detector.best_guess(image)
            (empties if label is None else tips).append(guess.confidence if guess else 0.0)
    return choose_threshold(tips, empties)


def _plate(frame: RecordedFrame) -> str:
    return frame.plate.rpartition("/")[2]


def _write(path: Path, description: dict[str, object]) -> None:
    text = json.dumps(description, indent=2) + "\n"
    path.with_suffix(".json").write_text(text, encoding="utf-8")
