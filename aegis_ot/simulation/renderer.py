"""What draws a frame: :func:`~.render.render_jpeg`, or a slower and truer one in its place."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .scene import SceneState
from .session import SessionParameters
from .truth import FrameTruth

Renderer = Callable[[SceneState, SessionParameters, np.random.Generator], tuple[bytes, FrameTruth]]
"""Draws one frame as JPEG, and says what is in it."""
