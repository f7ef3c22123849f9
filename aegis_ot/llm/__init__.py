"""Language and vision models behind one small protocol. Workstation side.

Door: :func:`make_backend` for a model by name, :func:`hybrid` for Layer 1 with it,
:class:`Opinions` for the sidecar. The gate of Layer 2 is in :mod:`.vlm`, which alone needs OpenCV.
"""

from .backend import Backend, Reply, Request, State, TokenUsage
from .backends.naming import (
    make_backend,
    model_from_environment,
    project_model,
    record_from_environment,
)
from .backends.recording import ReplayBackend
from .backends.scripted import ScriptedBackend
from .hybrid import Judgement, hybrid
from .opinions import Opinions
from .prices import PriceTable, load_prices

__all__ = [
    "Backend",
    "Judgement",
    "Opinions",
    "PriceTable",
    "ReplayBackend",
    "Reply",
    "Request",
    "ScriptedBackend",
    "State",
    "TokenUsage",
    "hybrid",
    "load_prices",
    "make_backend",
    "model_from_environment",
    "project_model",
    "record_from_environment",
]
