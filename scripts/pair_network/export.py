"""The network as ONNX with its description, as ``aegis_ot.vision.scorers.pair`` reads it."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import torch

from aegis_ot.vision.scorers.pair import FORMAT
from aegis_ot.vision.scorers.pair_strips import COLUMNS, ROWS

from .network import PairNetwork


def export(weights: Path, out: Path, learned_from: str) -> None:
    """Write ``out`` (``.onnx``) and the ``.json`` beside it.

    Args:
        weights: What training wrote.
        out: The file to write.
        learned_from: What it learned from, in words.
    """
    network = PairNetwork()
    network.load_state_dict(torch.load(weights))
    network.eval()
    pair = torch.zeros(1, 2, ROWS, COLUMNS, 3)
    torch.onnx.export(
        network,
        (pair, pair, torch.zeros(1), torch.zeros(1, 3, ROWS)),
        str(out),
        input_names=["own", "usual", "known", "tip"],
        output_names=["wet", "odds"],
        opset_version=17,
        dynamo=False,
    )
    digest = hashlib.sha256(out.read_bytes()).hexdigest()
    description = {"format": FORMAT, "learned_from": learned_from, "sha256": digest}
    out.with_suffix(".json").write_text(json.dumps(description, indent=2) + "\n", encoding="utf-8")
