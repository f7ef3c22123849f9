"""Training the tip detector: the same data sets and seed give the same weights."""

from __future__ import annotations

import hashlib
import json
import logging
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

from .._version import __version__
from ..vision.detection.heatmap import FORMAT, HeatmapDetector
from .examples import Example, close_up_example, overview_example, targets
from .figures import choose_threshold, measure
from .network import TipNetwork
from .recorded import FramePool, RecordedFrame, read_frames
from .scenes import draw_frame
from .simulated import SimulatedFrames

log = logging.getLogger(__name__)

Image = NDArray[np.uint8]
_PART = (192, 256)  # px of an overview that are trained on at a time


@dataclass(frozen=True)
class DetectorSettings:
    """How the detector is trained.

    Attributes:
        frames: Training frames, each seen ``epochs`` times.
        epochs: Passes over them; on parts of the overviews, in the last pass on whole ones.
        frozen: Last passes, trained with the statistics of batch normalisation held fixed.
        drawn_share: Share of procedurally drawn frames.
        simulated_share: Share of frames of the simulated camera; the rest comes from the data
            sets, or is drawn where there are none.
        close_ups: Close-ups cut from each frame.
        batch: Overviews in a batch (close-ups: twice as many).
        learning_rate: Highest rate of the one-cycle schedule.
        threshold: Least confidence of a detection; chosen on fresh drawn and simulated frames
            if not given.
        threshold_frames: Frames that it is chosen on.
        threads: CPU threads.
    """

    frames: int = 4500
    epochs: int = 8
    frozen: int = 3
    drawn_share: float = 0.35
    simulated_share: float = 0.3
    close_ups: int = 2
    batch: int = 16
    learning_rate: float = 4e-3
    threshold: float | None = None
    threshold_frames: int = 400
    threads: int = 1


def _collect(
    settings: DetectorSettings, pool: FramePool | None, seed: int, rng: np.random.Generator
) -> tuple[list[Example], list[Example]]:
    wide, close = [], []
    simulated = SimulatedFrames(seed)
    for number in range(settings.frames):
        pick = rng.random() - settings.simulated_share
        if pick < 0:
            image, label, decoy = simulated.draw(rng)
        elif pool is None or pick < settings.drawn_share:
            image, label, decoy = draw_frame(rng)
        else:
            image, label, decoy = pool.draw(rng)
        wide.append(overview_example(image, label))
        close += [close_up_example(rng, image, label, decoy) for _ in range(settings.close_ups)]
        if number % 500 == 499:
            log.info("%d of %d frames made", number + 1, settings.frames)
    return wide, close


def _batches(
    examples: Sequence[Example], size: int, rng: np.random.Generator
) -> list[list[Example]]:
    """Shuffled batches of equally large views."""
    by_shape: dict[tuple[int, ...], list[Example]] = {}
    for i in rng.permutation(len(examples)):
        by_shape.setdefault(examples[i].image.shape, []).append(examples[i])
    return [
        group[start : start + size]
        for group in by_shape.values()
        for start in range(0, len(group), size)
        if len(group) - start >= size or len(group) < size
    ]


def _tensors(
    batch: Sequence[Example], rng: np.random.Generator, whole: bool
) -> tuple[Tensor, Tensor, Tensor]:
    images, maps, weights = [], [], []
    for example in batch:
        shown = example if whole else example.cropped(rng, *_PART)
        if rng.random() < 0.5:
            shown = shown.mirrored()
        image = shown.image.astype(np.float32)
        # A new exposure and colour at each pass: cheap, and keeps the pool from being learnt.
        image *= np.exp(rng.normal(0, 0.15, (1, 1, 3)) * 0.4 + rng.normal(0, 0.15))
        image += rng.normal(0, 6)
        if rng.random() < 0.5:
            noise = rng.standard_normal((image.shape[0], image.shape[1], 1), np.float32)
            image += noise * np.float32(rng.uniform(0, 6))
        if rng.random() < 0.15:  # something is in the way
            h, w = (int(rng.uniform(0.03, 0.2) * side) for side in image.shape[:2])
            y, x = (int(rng.integers(0, side)) for side in image.shape[:2])
            image[y : y + h, x : x + w] = rng.uniform(0, 255)
        images.append(np.clip(image, 0, 255).astype(np.uint8))
        rows, columns = image.shape[0] // 4, image.shape[1] // 4
        made, weight = targets(rows, columns, shown.label)
        maps.append(made)
        weights.append(weight)
    return (
        torch.from_numpy(np.stack(images)),
        torch.from_numpy(np.stack(maps)),
        torch.from_numpy(np.stack(weights)),
    )


def _loss(out: Tensor, maps: Tensor, weights: Tensor) -> Tensor:
    """Focal loss of the heat (Zhou et al., "Objects as Points", 2019), L1 of the geometry."""
    heat = torch.sigmoid(out[:, :2]).clamp(1e-5, 1 - 1e-5)
    wanted = maps[:, :2]
    hit = (wanted == 1).float()
    gain = hit * (1 - heat) ** 2 * torch.log(heat)
    gain = gain + (1 - hit) * (1 - wanted) ** 4 * heat**2 * torch.log(1 - heat)
    focal = -gain.sum() / max(1.0, float(hit.sum()) + 0.5 * len(out))
    share = weights / weights.sum().clamp(min=1.0)
    error = (out[:, 2:] - maps[:, 2:]).abs()
    scale = torch.tensor([0.4, 0.4, 1.0, 1.0, 1.0])[None, :, None, None]
    return focal + (error * scale * share).sum()


def fit(
    pool: FramePool | None,
    seed: int,
    settings: DetectorSettings,
    progress: Callable[[str], None] | None = None,
) -> tuple[TipNetwork, str]:
    """Train a network on drawn and simulated frames and, if there is a pool, on recorded ones.

    Returns:
        The network, and the SHA-256 of all that it has learnt from: two trainings whose sums
        differ had other data, whatever their seeds.
    """
    tell = progress or log.info
    torch.manual_seed(seed)
    torch.set_num_threads(settings.threads)
    torch.use_deterministic_algorithms(True)
    rng = np.random.default_rng(seed)
    start = time.monotonic()
    wide, close = _collect(settings, pool, seed, rng)
    tell(
        f"{len(wide)} overviews and {len(close)} close-ups made in {time.monotonic() - start:.0f} s"
    )
    data = hashlib.sha256()
    for example in (*wide, *close):
        data.update(example.image.tobytes())
        data.update(repr(example.label).encode())
    network = TipNetwork()
    optimiser = torch.optim.AdamW(
        network.parameters(), lr=settings.learning_rate, weight_decay=1e-3
    )
    per_epoch = len(_batches(wide, settings.batch, np.random.default_rng(0))) + len(
        _batches(close, 2 * settings.batch, np.random.default_rng(0))
    )
    schedule = torch.optim.lr_scheduler.OneCycleLR(
        optimiser,
        settings.learning_rate,
        total_steps=per_epoch * settings.epochs + 1,
        pct_start=0.15,
    )
    for epoch in range(settings.epochs):
        network.train()
        if epoch >= settings.epochs - settings.frozen:
            network.freeze_statistics()
        whole = epoch == settings.epochs - 1
        batches = _batches(wide, settings.batch, rng) + _batches(close, 2 * settings.batch, rng)
        total = 0.0
        for i in rng.permutation(len(batches)):
            images, maps, weights = _tensors(batches[i], rng, whole)
            loss = _loss(network(images), maps, weights)
            optimiser.zero_grad(set_to_none=True)
            loss.backward()
            nn.utils.clip_grad_norm_(network.parameters(), 5.0)
            optimiser.step()
            schedule.step()
            total += float(loss.detach())
        tell(
            f"pass {epoch + 1} of {settings.epochs}: mean loss {total / len(batches):.3f}, "
            f"{time.monotonic() - start:.0f} s"
        )
    return network, data.hexdigest()


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
) -> Path:
    """Train a detector and write its weights and their description.

    Args:
        datasets: Trajectory data sets with ``boxes.csv``; none trains on drawn frames alone.
        out: The ``.onnx`` file to write; its description goes beside it as ``.json``.
        seed: Of every random choice.
        settings: How to train.
        hold_out: Plates (as in ``manifest.csv``) that are left out, for measuring.
        progress: Told one line at a time how far it is.

    Returns:
        Path of the ``.onnx`` file.

    Raises:
        DatasetError: A data set cannot be read.
    """
    chosen = settings or DetectorSettings()
    path = Path(out)
    by_set = {Path(folder).name: read_frames(Path(folder)) for folder in datasets}
    held = set(hold_out)
    learnt = [f for frames in by_set.values() for f in frames if _plate(f) not in held]
    network, digest = fit(FramePool(learnt) if learnt else None, seed, chosen, progress)
    export(network, path)
    description = {
        "format": FORMAT,
        "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
        "threshold": 0.5 if chosen.threshold is None else chosen.threshold,
        "parameters": sum(p.numel() for p in network.parameters()),
        "seed": seed,
        "settings": asdict(chosen),
        "data": {
            "sets": list(by_set),
            "recorded_frames": len(learnt),
            "held_out_plates": sorted(held),
            "examples_sha256": digest,
        },
        "made_with": {"aegis_ot": __version__, "torch": torch.__version__, "numpy": np.__version__},
    }
    _write(path, description)
    if chosen.threshold is None:
        description["threshold"] = _threshold(HeatmapDetector(path), chosen, seed)
        _write(path, description)
    if held:
        detector = HeatmapDetector(path)
        description["held_out_figures"] = {
            name: asdict(measure(detector, [f for f in frames if _plate(f) in held]))
            for name, frames in by_set.items()
        }
        _write(path, description)
    return path


def _threshold(detector: HeatmapDetector, settings: DetectorSettings, seed: int) -> float:
    """Chosen on frames like those of training, of other seeds; never on held-out plates."""
    rng = np.random.default_rng((seed, 1))
    simulated = SimulatedFrames(seed + 1_000_003)
    tips: list[float] = []
    empties: list[float] = []
    for number in range(settings.threshold_frames):
        image, label, _ = simulated.draw(rng) if number % 2 else draw_frame(rng)
        guess = detector.best_guess(image)
        (empties if label is None else tips).append(guess.confidence if guess else 0.0)
    return choose_threshold(tips, empties)


def _plate(frame: RecordedFrame) -> str:
    return frame.plate.rpartition("/")[2]


def _write(path: Path, description: dict[str, object]) -> None:
    text = json.dumps(description, indent=2) + "\n"
    path.with_suffix(".json").write_text(text, encoding="utf-8")
