"""Fitting the tip network: frames made anew in rounds, each seen a few times in many guises."""

from __future__ import annotations

import hashlib
import logging
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import cv2
import numpy as np
import torch
from torch import Tensor, nn

from .axes import TipLabel
from .examples import Image, TrainingExample, close_up_example, overview_example, targets
from .frame_pool import FramePool
from .network import TipNetwork
from .photometry import shows
from .scenes import draw_frame
from .simulated import SimulatedFrames

log = logging.getLogger(__name__)

_PART = (192, 256)  # px of an overview that are trained on at a time
_WARM_UP = 0.1  # share of the training in which the learning rate rises


@dataclass(frozen=True)
class DetectorSettings:
    """How the detector is trained; the defaults are those of the shipped weights.

    Attributes:
        rounds: Times that training frames are made; only one round's are in memory at a time.
        frames: Frames made in each round.
        passes: Times that each is seen; on parts of the overviews, in the last round on whole
            ones.
        frozen: Last rounds, trained with the statistics of batch normalisation held fixed.
        drawn_share: Share of procedurally drawn frames.
        simulated_share: Share of frames of the simulated camera; the rest comes from the data
            sets, or is drawn where there are none.
        close_ups: Close-ups cut from each frame.
        batch: Overviews in a batch (close-ups: twice as many).
        learning_rate: Highest rate; it rises for a tenth of the training, then falls as a cosine.
        threshold: Least confidence of a detection; chosen on fresh frames of the same mixture if
            not given.
        threshold_frames: Frames that it is chosen on.
        threads: CPU threads.
    """

    rounds: int = 10
    frames: int = 1400
    passes: int = 3
    frozen: int = 2
    drawn_share: float = 0.12
    simulated_share: float = 0.33
    close_ups: int = 2
    batch: int = 16
    learning_rate: float = 4e-3
    threshold: float | None = None
    threshold_frames: int = 600
    threads: int = 2


CONTINUING = DetectorSettings(rounds=4, frozen=4, learning_rate=1e-3)
"""For a network that has learnt already: shorter, in smaller steps, its statistics held."""


def fit(
    pool: FramePool | None,
    seed: int,
    settings: DetectorSettings,
    progress: Callable[[str], None] | None = None,
    start: TipNetwork | None = None,
) -> tuple[TipNetwork, str]:
    """Train a network on drawn and simulated frames and, if there is a pool, on recorded ones.

    Args:
        pool: Recorded frames.
        seed: Of every random choice.
        settings: How to train.
        progress: Told one line a round.
        start: A network that has learnt already; a new one if not given.

    Returns:
        The network, and the SHA-256 of all that it has learnt from: two trainings whose sums
        differ had other data, whatever their seeds.
    """
    tell = progress or log.info
    torch.manual_seed(seed)
    torch.set_num_threads(settings.threads)
    cv2.setNumThreads(settings.threads)
    torch.use_deterministic_algorithms(True)
    rng = np.random.default_rng(seed)
    simulated = SimulatedFrames(seed)
    network = (start or TipNetwork()).to(memory_format=torch.channels_last)
    optimiser = torch.optim.AdamW(
        network.parameters(), lr=settings.learning_rate, weight_decay=1e-3
    )
    digest = hashlib.sha256()
    began = time.monotonic()
    total_passes = settings.rounds * settings.passes
    for turn in range(settings.rounds):
        wide, close = _collect(settings, pool, simulated, rng)
        for example in (*wide, *close):
            digest.update(example.image.tobytes())
            digest.update(repr(example.label).encode())
        network.train()
        if turn >= settings.rounds - settings.frozen:
            network.freeze_statistics()
        losses: list[float] = []
        for number in range(settings.passes):
            batches = _batches(wide, settings.batch, rng) + _batches(close, 2 * settings.batch, rng)
            for step, i in enumerate(rng.permutation(len(batches))):
                done = (turn * settings.passes + number + step / len(batches)) / total_passes
                _set_rate(optimiser, settings.learning_rate * _schedule(done))
                tensors = _tensors(batches[i], rng, whole=turn == settings.rounds - 1)
                losses.append(_step(network, optimiser, *tensors))
        tell(
            f"round {turn + 1} of {settings.rounds}: mean loss {np.mean(losses):.3f}, "
            f"{time.monotonic() - began:.0f} s"
        )
    return network, digest.hexdigest()


def training_frames(
    settings: DetectorSettings,
    pool: FramePool | None,
    simulated: SimulatedFrames,
    rng: np.random.Generator,
) -> Iterator[tuple[TrainingExample, list[TrainingExample]]]:
    """Overviews and close-ups of frame after frame, without end."""
    for image, label, decoy in mixed_frames(settings, pool, simulated, rng):
        if not shows(image, label or decoy):  # overexposed: nothing is left to see
            label = decoy = None
        close = [close_up_example(rng, image, label, decoy) for _ in range(settings.close_ups)]
        yield overview_example(image, label), close


def mixed_frames(
    settings: DetectorSettings,
    pool: FramePool | None,
    simulated: SimulatedFrames,
    rng: np.random.Generator,
) -> Iterator[tuple[Image, TipLabel | None, TipLabel | None]]:
    """Frames of all sources in their shares, each with its tip and where one is missing."""
    while True:
        pick = rng.random() - settings.simulated_share
        if pick < 0:
            yield simulated.draw(rng)
        elif pool is None or pick < settings.drawn_share:
            yield draw_frame(rng)
        else:
            yield pool.draw(rng)


def _collect(
    settings: DetectorSettings,
    pool: FramePool | None,
    simulated: SimulatedFrames,
    rng: np.random.Generator,
) -> tuple[list[TrainingExample], list[TrainingExample]]:
    wide: list[TrainingExample] = []
    close: list[TrainingExample] = []
    for overview, close_ups in training_frames(settings, pool, simulated, rng):
        wide.append(overview)
        close += close_ups
        if len(wide) == settings.frames:
            break
    return wide, close


def _batches(
    examples: Sequence[TrainingExample], size: int, rng: np.random.Generator
) -> list[list[TrainingExample]]:
    """Shuffled batches of equally large views."""
    by_shape: dict[tuple[int, ...], list[TrainingExample]] = {}
    for i in rng.permutation(len(examples)):
        by_shape.setdefault(examples[i].image.shape, []).append(examples[i])
    return [
        group[start : start + size]
        for group in by_shape.values()
        for start in range(0, len(group), size)
        if len(group) - start >= size or len(group) < size
    ]


def _tensors(
    batch: Sequence[TrainingExample], rng: np.random.Generator, whole: bool
) -> tuple[Tensor, Tensor, Tensor]:
    images, maps, weights = [], [], []
    for example in batch:
        shown = example if whole else example.cropped(rng, *_PART)
        if rng.random() < 0.5:
            shown = shown.mirrored()
        image = shown.image.astype(np.float32)
        # A new exposure and colour at each pass: cheap, and keeps the frames from being learnt.
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


def _schedule(done: float) -> float:
    """Share of the highest learning rate after that share of the training."""
    if done < _WARM_UP:
        return 0.05 + 0.95 * done / _WARM_UP
    return float(0.5 * (1 + np.cos(np.pi * (done - _WARM_UP) / (1 - _WARM_UP))))


def _set_rate(optimiser: torch.optim.Optimizer, rate: float) -> None:
    for group in optimiser.param_groups:
        group["lr"] = rate


def _step(
    network: TipNetwork,
    optimiser: torch.optim.Optimizer,
    images: Tensor,
    maps: Tensor,
    weights: Tensor,
) -> float:
    loss = _loss(network(images), maps, weights)
    optimiser.zero_grad(set_to_none=True)
    loss.backward()
    nn.utils.clip_grad_norm_(network.parameters(), 5.0)
    optimiser.step()
    return float(loss.detach())


def _loss(out: Tensor, maps: Tensor, weights: Tensor) -> Tensor:
    """Focal loss of the heat (Zhou et al., "Objects as Points", 2019), L1 of the geometry."""
    heat = torch.sigmoid(out[:, :2]).clamp(1e-5, 1 - 1e-5)
    wanted = maps[:, :2]
    hit = (wanted == 1).float()
    gain = hit * (1 - heat) ** 2 * torch.log(heat)
    gain = gain + (1 - hit) * (1 - wanted) ** 4 * heat**2 * torch.log(1 - heat)
    # Where the lower end is decides what is read in a tip.
    gain = gain * torch.tensor([1.0, 1.5])[None, :, None, None]
    focal = -gain.sum() / max(1.0, float(hit.sum()) + 0.5 * len(out))
    share = weights / weights.sum().clamp(min=1.0)
    error = (out[:, 2:] - maps[:, 2:]).abs()
    scale = torch.tensor([0.4, 0.4, 1.0, 1.0, 1.0])[None, :, None, None]
    return focal + (error * scale * share).sum()
