"""Scores a data set of trajectories: does the network rank its failures above its normal wells?"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import torch

from aegis_ot.vision.dataset import load_dataset
from aegis_ot.vision.detection import HeatmapDetector
from aegis_ot.vision.scorers.looks import looks
from aegis_ot.vision.types import FREE

from .network import PairNetwork
from .strips import of_tip, strip_of
from .training import auroc, score_pairs

_FIRST = 3


def score_dataset(weights: Path, folder: Path) -> None:
    """Print AUROC over all wells, by reagent and by kind of failure."""
    network = PairNetwork()
    network.load_state_dict(torch.load(weights))
    columns: dict[str, list[object]] = {name: [] for name in ("plate", "failure", "reagent")}
    frames, tips = [], []
    for sample in load_dataset(folder).samples(HeatmapDetector()):
        seen = looks(sample)
        if not seen.keys() >= set(FREE):
            continue
        frames.append(
            [
                strip_of(sample.frames[kind], seen[kind].collar, seen[kind].orifice, sample.tip)
                for kind in FREE
            ]
        )
        tips.append(of_tip(sample.tip, sample.volume_ul))
        columns["plate"].append(sample.plate)
        columns["failure"].append(sample.failure_type or "")
        columns["reagent"].append(sample.reagent)
    plates = np.unique(np.array(columns["plate"]), return_inverse=True)[1]
    failure, reagent = np.array(columns["failure"]), np.array(columns["reagent"])
    data = {"frames": np.array(frames), "tip": np.array(tips), "plate": plates}
    normals: dict[int, list[int]] = {}
    for number in np.flatnonzero(failure == ""):
        normals.setdefault(int(plates[number]), []).append(int(number))
    told = score_pairs(network, data, np.arange(len(plates)), normals, _FIRST)
    scored = np.ones(len(plates), bool)
    scored[[number for some in normals.values() for number in some[:_FIRST]]] = False
    print(f"{len(plates)} wells, {scored.sum()} scored: {auroc(told[scored], failure[scored])}")
    for name in sorted(set(reagent)):
        part = scored & (reagent == name)
        print(f"  {name}: {auroc(told[part], failure[part])}")
    for name in sorted(set(failure) - {""}):
        part = scored & np.isin(failure, ("", name))
        print(f"  {name}: {auroc(told[part], failure[part])}")
