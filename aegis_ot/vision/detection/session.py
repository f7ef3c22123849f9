"""Reading networks and opening them with onnxruntime."""

from __future__ import annotations

import hashlib
import json
from typing import TYPE_CHECKING, Any

import numpy as np
import onnxruntime

from ...errors import ModelError
from ..types import Image

if TYPE_CHECKING:
    from importlib.abc import Traversable


def read_weights(
    model: Traversable, description: Traversable, layout: str, remedy: str = "reinstall aegis_ot"
) -> tuple[bytes, dict[str, Any]]:
    """A network's file and its description, in the layout that this version reads.

    Args:
        model: The ``.onnx`` file.
        description: The ``.json`` file that belongs to it.
        layout: Format of the description.
        remedy: What to do where a file cannot be read.

    Raises:
        ModelError: A file is missing, damaged, or does not belong to the other.
    """
    try:
        weights = model.read_bytes()
        content = json.loads(description.read_text(encoding="utf-8"))
    except OSError as error:
        raise ModelError(
            f"The network cannot be read: {error}. It needs both {model.name} and "
            f"{description.name}; {remedy}."
        ) from error
    except ValueError as error:
        raise ModelError(f"{description.name} is not valid JSON: {error}; {remedy}.") from error
    if not isinstance(content, dict) or content.get("format") != layout:
        other = content.get("format") if isinstance(content, dict) else content
        raise ModelError(f"{description.name} describes {other!r}; this version reads {layout!r}.")
    digest = hashlib.sha256(weights).hexdigest()
    if digest != content.get("sha256"):
        raise ModelError(
            f"{model.name} is damaged or is not the file that {description.name} describes: its "
            f"SHA-256 is {digest[:12]}..., expected {str(content.get('sha256'))[:12]}...; {remedy}."
        )
    return weights, content


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
