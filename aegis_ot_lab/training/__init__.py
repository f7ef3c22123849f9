"""Training of the project's own networks with PyTorch (extra ``train``).

Importing this package does not import PyTorch; calling it does.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from aegis_ot.errors import ConfigurationError

if TYPE_CHECKING:
    from .detector import DetectorSettings

__all__ = ["train_detector"]


def train_detector(
    datasets: Sequence[str | Path],
    out: str | Path,
    seed: int = 0,
    settings: DetectorSettings | None = None,
    hold_out: Sequence[str] = (),
    progress: Callable[[str], None] | None = None,
    start: str | Path | None = None,
) -> Path:
    """Train a tip detector; the same data sets, seed and versions give the same weights.

    Args:
        datasets: Trajectory data sets with ``boxes.csv``; none trains on drawn frames alone.
        out: The ``.onnx`` file to write; its description goes beside it as ``.json``.
        seed: Of every random choice.
        settings: :class:`aegis_ot_lab.training.detector.DetectorSettings`; those of the shipped
            weights if not given.
        hold_out: Plates (as in ``manifest.csv``) that are left out, for measuring.
        progress: Told one line at a time how far it is.
        start: Weights to train on from: an ``.onnx`` file of an earlier training, or ``"shipped"``
            for those of the package. A third of the time. A new network if not given.

    Returns:
        Path of the ``.onnx`` file.

    Raises:
        ModelError: The weights to start from are missing, damaged or of another version.
        ConfigurationError: They are of another network, PyTorch or ONNX is not installed, ``out``
            cannot be written, a plate to hold out is in no data set, or no plate is left.
        DatasetError: A data set cannot be read; every bad row is listed.
    """
    try:
        from .detector import train
    except ImportError as error:
        raise ConfigurationError(
            f"Training needs PyTorch and ONNX, and {error.name or error} is missing. "
            "Install them with: pip install 'aegis-ot[train]'"
        ) from error
    return train(datasets, out, seed, settings, hold_out, progress, start)
