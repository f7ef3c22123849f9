"""Trains the network for so long, each pair beside one to three normal ones of its plate."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from sklearn.metrics import roc_auc_score
from torch import Tensor
from torch.nn import functional as F

from .network import PairNetwork

Array = NDArray[Any]

_BATCH, _FASTEST = 48, 3e-3
_WITHOUT = 0.15
"""Share of pairs that are shown without a normal one beside them: a run's first well."""

_ELSEWHERE = 0.15
"""Share of pairs each of whose frames gets another background."""

_HELD_OUT = 12
"""Every so-manieth plate is never learned from."""


def train_network(
    drawn: Sequence[Path], out: Path, seconds: float, start: Path | None = None, hold: float = 0.0
) -> None:
    """Train on drawn pairs, print AUROC on plates held out, and write the weights.

    Args:
        drawn: Files of pairs; one named twice counts twice.
        out: The weights.
        seconds: How long.
        start: Weights to go on from.
        hold: Share of the time before the steps become smaller.
    """
    data = {name: np.concatenate([np.load(path)[name] for path in drawn]) for name in _NAMES}
    plates = np.unique(data["plate"])
    held_out = np.isin(data["plate"], plates[::_HELD_OUT])
    learned, rng = np.flatnonzero(~held_out), np.random.default_rng(0)
    normals = _normals_of(data["plate"], data["failure"])
    network = PairNetwork()
    if start is not None:
        network.load_state_dict(torch.load(start))
    for part in network.rows_and_lanes.modules():
        if isinstance(part, torch.nn.Conv2d):
            part.to(memory_format=torch.channels_last)
    optimiser = torch.optim.AdamW(network.parameters(), _FASTEST, weight_decay=2e-3)
    begun = time.monotonic()
    while (spent := time.monotonic() - begun) < seconds:
        network.train()
        rng.shuffle(learned)
        for batch in np.array_split(learned, max(len(learned) // _BATCH, 1)):
            share = min((time.monotonic() - begun) / seconds, 1.0)
            share = max(share - hold, 0.0) / (1.0 - hold)
            for group in optimiser.param_groups:
                group["lr"] = _FASTEST * (0.5 + 0.5 * math.cos(math.pi * share)) + 1e-5
            loss = _loss(network, data, batch, normals, rng)
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
        shown = np.flatnonzero(held_out)
        with_normals = score_pairs(network, data, shown, normals)
        without = score_pairs(network, data, shown, {})
        water = data["reagent"] == "water"
        for name, part in (("dyes", held_out & ~water), ("water", held_out & water)):
            wrong = data["failure"][part]
            figures = [auroc(odds[part[held_out]], wrong) for odds in (with_normals, without)]
            print(f"{spent:.0f} s: {name} {figures[0]}; without normal pairs {figures[1]}")
        torch.save(network.state_dict(), out)


_NAMES = ("frames", "wet", "tip", "plate", "failure", "kept", "reagent")


def _normals_of(plates: Array, failures: Array) -> dict[int, list[int]]:
    found: dict[int, list[int]] = {}
    for number in np.flatnonzero(failures == ""):
        found.setdefault(int(plates[number]), []).append(int(number))
    return found


def _loss(
    network: PairNetwork,
    data: dict[str, Array],
    batch: Array,
    normals: dict[int, list[int]],
    rng: np.random.Generator,
) -> Tensor:
    others = [[n for n in normals.get(int(data["plate"][i]), ()) if n != i] for i in batch]
    known = [bool(some) and rng.random() >= _WITHOUT for some in others]
    beside = int(rng.integers(1, 4))
    chosen = [rng.choice(some or [i], beside) for some, i in zip(others, batch, strict=True)]
    frames = np.concatenate([batch[:, None], np.array(chosen)], axis=1)
    half_width = torch.from_numpy(data["tip"][batch, 1])
    shown = _varied(torch.from_numpy(data["frames"][frames]).float(), half_width)
    flag = torch.tensor(known, dtype=torch.float32)
    tip = _geometry(data["tip"][batch], data["tip"][np.array(chosen)].mean(1), flag)
    wet, odds = network(shown[:, 0], shown[:, 1:].mean(1), flag, tip)
    wrong = torch.from_numpy((data["failure"][batch] != "").astype(np.float32))
    kept = torch.from_numpy(data["kept"][batch])
    loss: Tensor = (
        F.binary_cross_entropy_with_logits(wet, torch.from_numpy(data["wet"][batch]).clamp(0, 1))
        + 0.7 * F.binary_cross_entropy_with_logits(odds[:, 0], wrong)
        + 0.3 * F.binary_cross_entropy_with_logits(odds[:, 1], kept)
    )
    return loss


def _geometry(tip: Array, others: Array, known: Tensor) -> Tensor:
    usual = torch.from_numpy(others[:, :1]) * known[:, None, None]
    return torch.cat([torch.from_numpy(tip), usual], 1).float()


def _varied(frames: Tensor, half_width: Tensor) -> Tensor:
    """As other cameras, rooms and dyes would show them; a plate's pairs alike. 0 to 1.

    Args:
        frames: ``(n, pairs, 2, rows, columns, 3)``, 0 to 255.
        half_width: ``(n, rows)``: of the tip, of the strip's.
    """
    n, pairs = frames.shape[:2]
    shown = torch.nonzero(torch.rand(n) < _ELSEWHERE)[:, 0]
    frames[shown] = _before_other_edges(frames[shown], half_width[shown])

    def each(sd: float, *shape: int) -> Tensor:
        return torch.randn(*shape, *(1,) * (5 - len(shape)), 3 if len(shape) == 5 else 1) * sd

    middle = frames.mean((1, 2, 3, 4, 5), keepdim=True)
    frames = middle + (frames - middle) * torch.exp(each(0.2, n))
    frames = frames * torch.exp(each(0.3, n) + each(0.02, n, pairs, 2))
    frames = frames * torch.exp(torch.randn(n, 1, 1, 1, 1, 3) * 0.08) + each(6, n)
    grey = frames.mean(-1, keepdim=True)
    frames = grey + (frames - grey) * torch.exp(each(0.25, n))
    noise = torch.randn_like(frames)
    speckle = (torch.rand(n) < 0.4)[:, None, None, None, None, None] * torch.rand(n, 1, 1, 1, 1, 1)
    frames = frames + noise * (torch.rand(n, pairs, 1, 1, 1, 1) * 3 + 0.12 * speckle * frames)
    mirrored = torch.rand(n) < 0.5
    frames[mirrored] = frames[mirrored].flip(4)
    for number in torch.nonzero(torch.rand(n) < 0.4)[:, 0]:
        frames[number] = frames[number][..., torch.randperm(3)]
    return frames.clamp(0, 255) / 255


def _before_other_edges(frames: Tensor, half_width: Tensor) -> Tensor:
    """With something of another brightness behind the lower part of each frame, as labware is."""
    n, pairs, two, rows, columns, _ = frames.shape
    lanes = torch.linspace(-1, 1, columns)
    edge = (torch.rand(n, pairs, two, 1, 1) * 1.3) * rows
    slope = torch.randn(n, 1, 1, 1, 1) * 4
    below = torch.arange(rows)[:, None] + slope * lanes - edge
    inside = lanes.abs()[None, None, :] < half_width[:, :, None]
    through = torch.where(inside, torch.rand(n, 1, 1) * 0.6 + 0.2, torch.ones(1))
    colour = torch.rand(n, pairs, two, 1, 1, 1) * 220 + torch.randn(n, 1, 1, 1, 1, 3) * 8
    share = below.clamp(0, 1) * through[:, None, None] * (0.3 + 0.6 * torch.rand(n, 1, 1, 1, 1))
    return frames + share[..., None] * (colour - frames)


def score_pairs(
    network: PairNetwork,
    data: dict[str, Array],
    numbers: Array,
    normals: dict[int, list[int]],
    first: int = 3,
) -> Array:
    """Logits of "something is wrong", beside the plate's ``first`` normal pairs."""
    network.eval()
    told = []
    with torch.no_grad():
        for i in numbers:
            usual = [n for n in normals.get(int(data["plate"][i]), ()) if n != i][:first]
            frames = torch.from_numpy(data["frames"][[i, *(usual or [i])]]).float() / 255
            known = torch.tensor([float(bool(usual))])
            others = data["tip"][usual or [i]].mean(0, keepdims=True)
            tip = _geometry(data["tip"][[i]], others, known)
            beside = frames[1:].mean(0, keepdim=True)
            told.append(float(network(frames[:1], beside, known, tip)[1][0, 0]))
    return np.array(told)


def auroc(told: Array, failure: Array) -> str:
    """How well failures rank above normal wells, in words."""
    wrong = failure != ""
    if not len(wrong) or wrong.all() or not wrong.any():
        return "AUROC -"
    return f"AUROC {roc_auc_score(wrong, told):.3f} ({wrong.sum()} of {len(wrong)} wrong)"
