"""Opening networks with onnxruntime."""

from __future__ import annotations

from typing import Any

import numpy as np
import onnxruntime

from ...errors import ModelError
from ..types import Image


def open_session(model: bytes, threads: int, what: str) -> Any:
    """An inference session on the CPU.

    Args:
        model: The ONNX file's content.
        threads: Threads of one operation; operations run one after the other.
        what: What the message names, should the file be unusable.

    Raises:
        ModelError: onnxruntime cannot use the file.
    """
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = threads
    options.inter_op_num_threads = 1
    options.log_severity_level = 3
    # Idle threads that spin would take the time that the scorers need.
    options.add_session_config_entry("session.intra_op.allow_spinning", "0")
    try:
        return onnxruntime.InferenceSession(model, options, providers=["CPUExecutionProvider"])
    except Exception as error:  # onnxruntime raises its own, unexported exceptions
        raise ModelError(f"{what} is no network that onnxruntime can run: {error}") from error


def check_image(image: Image) -> None:
    """Raises :class:`ValueError` unless the image is ``uint8`` of shape ``(height, width, 3)``."""
    if image.dtype != np.uint8 or image.ndim != 3 or image.shape[2] != 3 or not image.size:
        raise ValueError(
            f"expected a uint8 image of shape (height, width, 3), got {image.dtype} {image.shape}"
        )
