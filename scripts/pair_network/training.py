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

from .network import PairNetwork, looks_of

Array = NDArray[Any]

_BATCH, _FASTEST = 48, 3e-3
_WITHOUT = 0.15
"""Share of pairs that are shown without a normal one beside them: a run's first well."""

_HELD_OUT = 12
"""Every so-manieth plate is never learned from."""


def train_network(drawn: Sequence[Path], out: Path, seconds: float) -> None:
    """Train on drawn pairs, print AUROC on plates held out, and write the weights."""
    data = {name: np.concatenate([np.load(path)[name] for path in drawn]) for name in _NAMES}
    plates = np.unique(data["plate"])
    held_out = np.isin(data["plate"], plates[::_HELD_OUT])
    learned, rng = np.flatnonzero(~held_out), np.random.default_rng(0)
    normals = _normals_of(data["plate"], data["failure"])
    network = PairNetwork()
    optimiser = torch.optim.AdamW(network.parameters(), _FASTEST, weight_decay=2e-3)
    begun = time.monotonic()
    while (spent := time.monotonic() - begun) < seconds:
        network.train()
        rng.shuffle(learned)
        for batch in np.array_split(learned, max(len(learned) // _BATCH, 1)):
            share = min((time.monotonic() - begun) / seconds, 1.0)
            for group in optimiser.param_groups:
                group["lr"] = _FASTEST * (0.5 + 0.5 * math.cos(math.pi * share)) + 1e-5
            loss = _loss(network, data, batch, normals, rng)
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
        told = score_pairs(network, data, np.flatnonzero(held_out), normals)
        water = data["reagent"] == "water"
        for name, part in (("dyes", held_out & ~water), ("water", held_out & water)):
            print(f"{spent:.0f} s: {name} {auroc(told[part[held_out]], data['failure'][part])}")
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
    shown = _varied(torch.from_numpy(data["frames"][frames]).float())
    looks = [looks_of(shown[:, n]) for n in range(1 + beside)]
    wet, told = network(
        looks[0],
        torch.stack(looks[1:]).mean(0),
        torch.tensor(known, dtype=torch.float32),
        torch.from_numpy(data["tip"][batch]),
    )
    wrong = torch.from_numpy((data["failure"][batch] != "").astype(np.float32))
    kept = torch.from_numpy(data["kept"][batch])
    loss: Tensor = (
        F.binary_cross_entropy_with_logits(wet, torch.from_numpy(data["wet"][batch]).clamp(0, 1))
        + 0.7 * F.binary_cross_entropy_with_logits(told[:, 0], wrong)
        + 0.3 * F.binary_cross_entropy_with_logits(told[:, 1], kept)
    )
    return loss


def _varied(frames: Tensor) -> Tensor:
    """``(n, pairs, 2, rows, columns, 3)`` 0 to 255, as other cameras and dyes would show them; a
    plate's pairs alike. 0 to 1."""
    n, pairs = frames.shape[:2]
    light = torch.exp(torch.randn(n, 1, 1, 1, 1, 1) * 0.15)
    balance = torch.exp(torch.randn(n, 1, 1, 1, 1, 3) * 0.08)
    exposure = torch.exp(torch.randn(n, pairs, 2, 1, 1, 1) * 0.02)
    frames = frames * light * balance * exposure + torch.randn(n, 1, 1, 1, 1, 1) * 6
    frames = frames + torch.randn_like(frames) * (torch.rand(n, pairs, 1, 1, 1, 1) * 3)
    mirrored = torch.rand(n) < 0.5
    frames[mirrored] = frames[mirrored].flip(4)
    for number in torch.nonzero(torch.rand(n) < 0.4)[:, 0]:
        frames[number] = frames[number][..., torch.randperm(3)]
    return frames.clamp(0, 255) / 255


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
            looks = looks_of(torch.from_numpy(data["frames"][[i, *usual]]).float() / 255)
            own, others = looks[:1], looks[1:] if usual else looks[:1]
            known = torch.tensor([float(bool(usual))])
            tip = torch.from_numpy(data["tip"][[i]])
            told.append(float(network(own, others.mean(0, keepdim=True), known, tip)[1][0, 0]))
    return np.array(told)


def auroc(told: Array, failure: Array) -> str:
    """How well failures rank above normal wells, in words."""
    wrong = failure != ""
    if not len(wrong) or wrong.all() or not wrong.any():
        return "AUROC -"
    return f"AUROC {roc_auc_score(wrong, told):.3f} ({wrong.sum()} of {len(wrong)} wrong)"
