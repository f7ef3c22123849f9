"""The network, in PyTorch: a pair beside the mean of its plate's first normal pairs."""

from __future__ import annotations

import torch
from torch import Tensor, nn

from aegis_ot.vision.scorers.pair_strips import ROWS

_KEPT_ROWS = 28
"""Rows after three convolutions with strides; each tells of four rows of the strip."""


def _looks_of(frames: Tensor) -> Tensor:
    """``(n, 9, rows, columns)`` of ``(n, 2, rows, columns, 3)``, 0 to 1: both frames, and what
    changed."""
    before, after = frames[:, 0], frames[:, 1]
    looks = torch.cat([before - 0.4, after - 0.4, 4 * (before - after)], 3)
    return looks.permute(0, 3, 1, 2)


def _conv(inputs: int, outputs: int, stride: tuple[int, int] = (1, 1)) -> nn.Sequential:
    return nn.Sequential(
        nn.Conv2d(inputs, outputs, 3, stride, 1, bias=False), nn.BatchNorm2d(outputs), nn.ReLU()
    )


def _along(inputs: int, outputs: int) -> nn.Sequential:
    return nn.Sequential(nn.Conv1d(inputs, outputs, 7, 1, 3), nn.BatchNorm1d(outputs), nn.ReLU())


class PairNetwork(nn.Module):  # type: ignore[misc]  # PyTorch may be missing
    """Wet rows of both frames, and two logits: something is wrong; share that stayed."""

    def __init__(self) -> None:
        super().__init__()
        self.rows_and_lanes = nn.Sequential(
            _conv(9 + 9 + 4, 16),
            _conv(16, 32, (2, 2)), _conv(32, 32),
            _conv(32, 48, (2, 2)), _conv(48, 48),
            _conv(48, 64, (1, 2)), _conv(64, 64), _conv(64, 64),
        )  # fmt: skip
        self.along = nn.Sequential(_along(3 * 64, 96), _along(96, 96), _along(96, 64))
        self.rows = nn.Conv1d(64, 2 * ROWS // _KEPT_ROWS, 1)
        self.head = nn.Sequential(nn.Linear(128, 64), nn.ReLU(), nn.Linear(64, 2))

    def forward(
        self, own: Tensor, usual: Tensor, known: Tensor, tip: Tensor
    ) -> tuple[Tensor, Tensor]:
        """``(n, 2, ROWS)`` and ``(n, 2)``, logits.

        Args:
            own, usual: ``(n, 2, ROWS, COLUMNS, 3)``, 0 to 1: both frames of the pair, and the mean
                of the plate's normal ones.
            known: ``(n,)``: 1 where there are any.
            tip: ``(n, 3, ROWS)``: where liquid should stand in TRANSIT, the tip's half width, and
                where liquid should have stood in the normal ones.
        """
        n, _, rows, columns, _ = own.shape
        flag = known[:, None, None, None].expand(-1, 1, rows, columns)
        geometry = tip[:, :, :, None].expand(-1, -1, -1, columns)
        shown = torch.cat([_looks_of(own), _looks_of(usual) * flag, flag, geometry], 1)
        seen = self.rows_and_lanes(shown.contiguous(memory_format=torch.channels_last))
        along = self.along(seen.permute(0, 1, 3, 2).reshape(n, -1, _KEPT_ROWS))
        wet = self.rows(along).reshape(n, 2, -1, _KEPT_ROWS).permute(0, 1, 3, 2)
        both = torch.cat([along.mean(2), along.amax(2)], 1)
        return wet.reshape(n, 2, ROWS), self.head(both)
