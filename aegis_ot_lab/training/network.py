"""The tip detector's network, in PyTorch: a small encoder-decoder with one group of maps out."""

from __future__ import annotations

import numpy as np
import onnx
import torch
from torch import Tensor, nn
from torch.nn import functional as F

from aegis_ot.errors import ConfigurationError
from aegis_ot.vision.detection.decode import CHANNELS


def _conv(
    inputs: int, outputs: int, kernel: int, stride: int = 1, groups: int = 1
) -> nn.Sequential:
    return nn.Sequential(
        nn.Conv2d(inputs, outputs, kernel, stride, kernel // 2, groups=groups, bias=False),
        nn.BatchNorm2d(outputs, momentum=0.03),
    )


class _Block(nn.Module):  # type: ignore[misc]  # PyTorch may be missing
    """Depth-wise, then point-wise convolution; with a shortcut where shapes allow."""

    def __init__(self, inputs: int, outputs: int, kernel: int = 3, stride: int = 1) -> None:
        super().__init__()
        self.depth = _conv(inputs, inputs, kernel, stride, groups=inputs)
        self.point = _conv(inputs, outputs, 1)
        self.shortcut = stride == 1 and inputs == outputs

    def forward(self, x: Tensor) -> Tensor:
        out: Tensor = self.point(F.relu(self.depth(x)))
        return F.relu(out + x) if self.shortcut else F.relu(out)


class TipNetwork(nn.Module):  # type: ignore[misc]
    """Maps of :mod:`aegis_ot.vision.detection.decode` for images of any size.

    Input ``uint8`` ``(n, height, width, 3)``, BGR, sides multiples of 16; output ``float32``
    ``(n, 7, height / 4, width / 4)``, heat before (training) or after (export) the sigmoid.
    """

    def __init__(self, widths: tuple[int, int, int, int] = (16, 32, 96, 160)) -> None:
        super().__init__()
        a, b, c, d = widths
        self.stem = _conv(3, a, 3, 2)
        self.at_half = _Block(a, a)
        self.quarter = nn.Sequential(_Block(a, b, 5, 2), _Block(b, b))
        self.eighth = nn.Sequential(_Block(b, c, 5, 2), _Block(c, c), _Block(c, c, 5))
        self.sixteenth = nn.Sequential(
            _Block(c, d, 5, 2), _Block(d, d, 5), _Block(d, d, 5), _Block(d, d, 5)
        )
        self.up_eighth = _conv(d, c, 1)
        self.at_eighth = _Block(c, c, 5)
        self.up_quarter = _conv(c, b, 1)
        self.at_quarter = nn.Sequential(_Block(b, b, 5), _Block(b, 32))
        self.head = nn.Conv2d(32, CHANNELS, 1)
        self.probabilities = False
        with torch.no_grad():
            self.head.bias[:2] = -4.0
            self.head.bias[6] = 2.3

    @classmethod
    def exported(cls, weights: bytes) -> TipNetwork:
        """The network of an ONNX export, to be trained on.

        An export has means and variances multiplied into its convolutions: here each of these
        normalises by a mean of 0 and a variance of 1, which must stay frozen.

        Raises:
            ConfigurationError: It is of another network.
        """
        graph = onnx.load_from_string(weights).graph
        stored = {one.name: onnx.numpy_helper.to_array(one) for one in graph.initializer}
        given = [
            [stored.get(name, np.empty(0)) for name in node.input[1:]]
            for node in graph.node
            if node.op_type == "Conv"
        ]
        network = cls()
        layers = [one for one in network.modules() if isinstance(one, nn.Conv2d)]
        if [layer.weight.shape for layer in layers] != [weight.shape for weight, *_ in given]:
            raise ConfigurationError(
                "The weights to start from are of another network than the tip detector's: they "
                "cannot be trained on. Start from ones that 'aegis-ot train detector' has made."
            )
        remaining = iter(given)
        with torch.no_grad():
            for layer in network.modules():
                if isinstance(layer, nn.Conv2d):
                    weight, bias = (torch.tensor(values) for values in next(remaining))
                    layer.weight.copy_(weight)
                    if layer.bias is not None:
                        layer.bias.copy_(bias)
                elif isinstance(layer, nn.BatchNorm2d):  # comes after its convolution
                    layer.bias.copy_(bias)
                    layer.running_var.fill_(1 - layer.eps)
        return network

    def freeze_statistics(self) -> None:
        """Train on with the running means and variances that the exported network will use.

        Overviews and close-ups have different statistics; normalised batch by batch the network
        never meets the mixture of both that it has to work with in the end.
        """
        for module in self.modules():
            if isinstance(module, nn.BatchNorm2d):
                module.eval()

    def forward(self, image: Tensor) -> Tensor:
        x = image.permute(0, 3, 1, 2).float() * (1 / 64) - 2
        x = self.at_half(F.relu(self.stem(x)))
        quarter = self.quarter(x)
        eighth = self.eighth(quarter)
        deep = self.up_eighth(self.sixteenth(eighth))
        eighth = self.at_eighth(F.relu(eighth + F.interpolate(deep, scale_factor=2.0)))
        up = F.interpolate(self.up_quarter(eighth), scale_factor=2.0)
        out: Tensor = self.head(self.at_quarter(F.relu(quarter + up)))
        if self.probabilities:
            return torch.cat([torch.sigmoid(out[:, :2]), out[:, 2:]], dim=1)
        return out
